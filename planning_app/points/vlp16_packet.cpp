#include "points/vlp16_packet.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

constexpr std::size_t kBlocks = 12, kBlockBytes = 100, kLasers = 16;
constexpr double kFiringS = 55.296e-6, kLaserS = 2.304e-6, kRangeM = 0.002, kRangeMinM = 0.4;
constexpr int kTurn = 36000, kGapMax = 200, kGapUsual = 20;  // 0.01 degrees; 0.1 to 0.4 degrees from block to block at 300 to 1200 rpm
constexpr double kDegree = 3.14159265358979323846 / 180.0;

int word(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]) | static_cast<unsigned char>(bytes[at + 1]) << 8;
}
int azimuth(std::string_view bytes, std::size_t block) { return word(bytes, block * kBlockBytes + 2); }

// Lasers fire in the order -15, 1, -13, 3, ... -1, 15 degrees.
int elevation_deg(std::size_t laser) { return laser % 2 == 0 ? -15 + static_cast<int>(laser) : static_cast<int>(laser); }

Vlp16Fault fault_of(std::string_view bytes) {
  if (bytes.size() != kVlp16Bytes) return Vlp16Fault::kSize;
  const int mode = word(bytes, 1204) & 0xFF;
  if (mode < 0x37 || mode > 0x39) return Vlp16Fault::kReturnMode;
  if (word(bytes, 1204) >> 8 != 0x22) return Vlp16Fault::kProduct;
  if (word(bytes, 1200) + 65536.0 * word(bytes, 1202) >= kVlp16HourS * 1e6) return Vlp16Fault::kClock;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if (word(bytes, block * kBlockBytes) != 0xEEFF) return Vlp16Fault::kBlockFlag;
    if (azimuth(bytes, block) >= kTurn) return Vlp16Fault::kAzimuth;
    if (mode == 0x39 && block % 2 == 1 && azimuth(bytes, block) != azimuth(bytes, block - 1)) return Vlp16Fault::kAzimuth;
  }
  return Vlp16Fault::kNone;
}

}  // namespace

Vlp16Fault decode_vlp16(std::string_view bytes, Vlp16Packet& packet) {
  const Vlp16Fault fault = fault_of(bytes);
  if (fault != Vlp16Fault::kNone) return fault;
  const bool dual = (word(bytes, 1204) & 0xFF) == 0x39;
  const std::size_t step = dual ? 2 : 1;
  packet.clock_s = 1e-6 * (word(bytes, 1200) + 65536.0 * word(bytes, 1202));
  packet.firings.clear();
  for (std::size_t block = 0; block < kBlocks; block += step) {
    const std::size_t from = block + step < kBlocks ? block : block - step;
    int gap = (azimuth(bytes, from + step) + kTurn - azimuth(bytes, from)) % kTurn;
    if (gap > kGapMax) gap = kGapUsual;  // a sector that the sensor skips
    for (std::size_t sequence = 0; sequence < 2; ++sequence) {
      Vlp16Firing firing;
      firing.since_packet_s = kFiringS * static_cast<double>(2 * (block / step) + sequence);
      for (std::size_t rank = 0; rank < kLasers; ++rank) {
        const std::size_t laser = rank < 8 ? 2 * rank : 2 * (rank - 8) + 1;
        const std::size_t record = block * kBlockBytes + 4 + 3 * (sequence * kLasers + laser);
        // Of a pair the last return is the farther one, whichever block it stands in.
        const int steps = dual ? std::max(word(bytes, record), word(bytes, record + kBlockBytes)) : word(bytes, record);
        const double range = steps * kRangeM;
        if (range < kRangeMinM) continue;
        const double turned = 0.01 * gap * (static_cast<double>(sequence) * kFiringS + static_cast<double>(laser) * kLaserS) / (2.0 * kFiringS);
        const double heading = -(0.01 * azimuth(bytes, block) + turned) * kDegree, up = elevation_deg(laser) * kDegree;
        const double level = range * std::cos(up);
        firing.point[static_cast<std::size_t>(firing.returns++)] = {static_cast<float>(level * std::cos(heading)),
                                                                   static_cast<float>(level * std::sin(heading)), static_cast<float>(range * std::sin(up))};
      }
      packet.firings.push_back(firing);
    }
  }
  return Vlp16Fault::kNone;
}

const char* vlp16_fault_text(Vlp16Fault fault) {
  switch (fault) {
    case Vlp16Fault::kSize: return "size: is not 1206 bytes";
    case Vlp16Fault::kReturnMode: return "return mode: is none of 37, 38, 39 (hexadecimal)";
    case Vlp16Fault::kProduct: return "product: is not 22 (hexadecimal, VLP-16)";
    case Vlp16Fault::kBlockFlag: return "block flag: is not FF EE";
    case Vlp16Fault::kAzimuth: return "azimuth: beyond 359.99 degrees, or different in the two blocks of a pair";
    case Vlp16Fault::kClock: return "clock: beyond an hour";
    case Vlp16Fault::kNone: break;
  }
  return "no fault";
}

}  // namespace berm::app
