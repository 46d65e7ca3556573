#include "io/vlp16.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel {

namespace {

constexpr std::size_t kBlockBytes = 100;
constexpr std::size_t kClockOffset = 1200, kModeOffset = 1204;
constexpr std::uint8_t kModeStrongest = 0x37, kModeLast = 0x38, kModeDual = 0x39;
constexpr std::uint8_t kProductVlp16 = 0x22;
constexpr std::int32_t kRangeLsbMm = 2;
constexpr std::uint32_t kTurnCdeg = kVlp16TurnMdeg / 10U;
constexpr std::uint32_t kGapMaxCdeg = 200;  // between blocks; 0.1 to 0.4 degrees at 300 to 1200 rpm. A sector skipped by the sensor is wider
constexpr std::uint32_t kGapDefaultCdeg = 20;
constexpr std::uint32_t kHalfDivergenceMdeg = 86;  // 1.5 mrad: a beam is 3 mrad wide (VLP-16 manual, specifications)
// Firing times in nanoseconds: a sequence fires its 16 lasers one by one; a block holds two sequences.
constexpr std::uint32_t kSequenceNs = kVlp16FiringNs, kLaserNs = 2304;

// Elevation rank of each laser in firing order: -15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15 degrees.
constexpr std::uint8_t kChannelOfLaser[kVlp16Channels] = {0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15};

// Of the channels' elevations, -15 to 15 degrees.
constexpr double kChannelCosine[kVlp16Channels] = {
    0.9659258262890683, 0.9743700647852352, 0.981627183447664, 0.9876883405951378,
    0.992546151641322, 0.9961946980917455, 0.9986295347545738, 0.9998476951563913,
    0.9998476951563913, 0.9986295347545738, 0.9961946980917455, 0.992546151641322,
    0.9876883405951378, 0.981627183447664, 0.9743700647852352, 0.9659258262890683};
constexpr double kChannelSine[kVlp16Channels] = {
    -0.25881904510252074, -0.224951054343865, -0.1908089953765448, -0.15643446504023087,
    -0.12186934340514748, -0.08715574274765817, -0.05233595624294383, -0.01745240643728351,
    0.01745240643728351, 0.05233595624294383, 0.08715574274765817, 0.12186934340514748,
    0.15643446504023087, 0.1908089953765448, 0.224951054343865, 0.25881904510252074};

// To the nearest, for what fits.
std::int32_t rounded(double v) { return static_cast<std::int32_t>(v < 0.0 ? v - 0.5 : v + 0.5); }

std::uint32_t u16(const std::uint8_t* p) { return static_cast<std::uint32_t>(p[0]) | (static_cast<std::uint32_t>(p[1]) << 8); }

Vlp16Result check(const std::uint8_t* bytes, std::size_t size) {
  if (size != kVlp16PacketBytes) return Vlp16Result::kSize;
  const std::uint8_t mode = bytes[kModeOffset];
  if (mode != kModeStrongest && mode != kModeLast && mode != kModeDual) return Vlp16Result::kMode;
  if (bytes[kModeOffset + 1] != kProductVlp16) return Vlp16Result::kProduct;
  for (int block = 0; block < kVlp16Blocks; ++block) {
    const std::uint8_t* p = bytes + kBlockBytes * static_cast<std::size_t>(block);
    if (p[0] != 0xFF || p[1] != 0xEE) return Vlp16Result::kFlag;
    if (u16(p + 2) >= kTurnCdeg) return Vlp16Result::kAzimuth;
    // the two blocks of a dual pair are one firing
    if (mode == kModeDual && block % 2 == 1 && u16(p + 2) != u16(p + 2 - kBlockBytes)) return Vlp16Result::kAzimuth;
  }
  return Vlp16Result::kOk;
}

// Turn between the firing of block and that of the next, in 0.01 degrees; at the packet's end that of the pair before.
std::uint32_t gap_cdeg(const std::uint8_t* bytes, int block, int step) {
  const int from = block + step < kVlp16Blocks ? block : block - step;
  const std::uint32_t here = u16(bytes + kBlockBytes * static_cast<std::size_t>(from) + 2);
  const std::uint32_t next = u16(bytes + kBlockBytes * static_cast<std::size_t>(from + step) + 2);
  const std::uint32_t gap = (next + kTurnCdeg - here) % kTurnCdeg;
  return gap <= kGapMaxCdeg ? gap : kGapDefaultCdeg;
}

}  // namespace

bool vlp16_is_dual(const std::uint8_t* bytes) { return bytes[kModeOffset] == kModeDual; }

int vlp16_firings(const std::uint8_t* bytes) { return vlp16_is_dual(bytes) ? kVlp16Blocks : 2 * kVlp16Blocks; }

std::uint32_t vlp16_block_mdeg(const std::uint8_t* bytes, int block) { return u16(bytes + kBlockBytes * static_cast<std::size_t>(block) + 2) * 10U; }

Vlp16Firing vlp16_firing(const std::uint8_t* bytes, int firing) {
  const int step = vlp16_is_dual(bytes) ? 2 : 1, block = firing / 2 * step, half = firing % 2;
  const std::uint8_t* p = bytes + kBlockBytes * static_cast<std::size_t>(block);
  Vlp16Firing f{};
  f.turn_mdeg = gap_cdeg(bytes, block, step) * 10U / 2U;  // two firings in a block
  f.azimuth_mdeg = (u16(p + 2) * 10U + static_cast<std::uint32_t>(half) * f.turn_mdeg) % kVlp16TurnMdeg;
  for (int laser = 0; laser < kVlp16Channels; ++laser) {
    const std::uint8_t* record = p + 4 + 3 * (half * kVlp16Channels + laser);
    const std::uint32_t one = u16(record), pair = step == 2 ? u16(record + kBlockBytes) : one;
    // A pair holds the last return in its even block and the strongest in its odd one, and a lone return may stand in either: the last return is
    // the farther of the two.
    f.last_mm[kChannelOfLaser[laser]] = static_cast<std::int32_t>(std::max(one, pair)) * kRangeLsbMm;
    f.other_mm[kChannelOfLaser[laser]] = static_cast<std::int32_t>(std::min(one, pair)) * kRangeLsbMm;
  }
  return f;
}

Vlp16Result vlp16_decode(const std::uint8_t* bytes, std::size_t size, Vlp16Packet& packet) {
  const Vlp16Result result = check(bytes, size);
  if (result != Vlp16Result::kOk) return result;
  packet.count = 0;
  packet.firings = vlp16_firings(bytes);
  for (int k = 0; k < packet.firings; ++k) {
    const Vlp16Firing firing = vlp16_firing(bytes, k);
    const std::uint32_t spread_mdeg = kHalfDivergenceMdeg + firing.turn_mdeg;
    for (int laser = 0; laser < kVlp16Channels; ++laser) {
      const std::uint8_t channel = kChannelOfLaser[laser];
      if (firing.last_mm[channel] < kVlp16RangeMinMm) continue;
      const std::uint32_t turned_mdeg = firing.turn_mdeg * kLaserNs * static_cast<std::uint32_t>(laser) / kSequenceNs;
      const std::uint32_t at_mdeg = (firing.azimuth_mdeg + turned_mdeg) % kVlp16TurnMdeg;
      packet.point[packet.count++] = {channel, at_mdeg, spread_mdeg, firing.last_mm[channel], static_cast<std::uint8_t>(k)};
    }
  }
  return Vlp16Result::kOk;
}

Vlp16Elevation vlp16_elevation(std::uint8_t channel) { return {kChannelCosine[channel % kVlp16Channels], kChannelSine[channel % kVlp16Channels]}; }

std::uint32_t vlp16_clock_us(const std::uint8_t* bytes) { return u16(bytes + kClockOffset) | (u16(bytes + kClockOffset + 2) << 16); }

Vlp16Edges vlp16_edges(double level, double heading_rad, double aside_rad) {
  const double ahead_x = level * std::cos(heading_rad), ahead_y = level * std::sin(heading_rad);
  // By the small angle's series.
  const double square = aside_rad * aside_rad, cosine = 1.0 - square * (0.5 - square / 24.0), sine = aside_rad * (1.0 - square / 6.0);
  return {ahead_x * cosine, ahead_y * cosine, -ahead_y * sine, ahead_x * sine};
}

sk_point vlp16_head(const Vlp16Mount& mount) { return {rounded(mount.x_m * 1e3), rounded(mount.y_m * 1e3), rounded(mount.z_m * 1e3)}; }

Vlp16Footprint vlp16_project(const Vlp16Mount& mount, const Vlp16Return& point) {
  const std::size_t channel = point.channel % kVlp16Channels;
  const double level = point.range_mm * kChannelCosine[channel];
  const std::int32_t z_mm = static_cast<std::int32_t>(std::ceil(mount.z_m * 1e3 + point.range_mm * kChannelSine[channel]));
  const Vlp16Edges beam = vlp16_edges(level, mount.yaw_rad - point.azimuth_mdeg * kVlp16RadPerMdeg, point.spread_mdeg * kVlp16RadPerMdeg);
  const auto edge = [&](double left) -> sk_point {
    return {rounded(mount.x_m * 1e3 + beam.middle_x + left * beam.beside_x), rounded(mount.y_m * 1e3 + beam.middle_y + left * beam.beside_y), z_mm};
  };
  return {edge(1.0), edge(-1.0)};
}

}  // namespace berm::kernel
