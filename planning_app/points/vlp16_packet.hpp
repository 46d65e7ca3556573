// Native data packets of the Velodyne VLP-16, single (strongest or last) and dual return; written from the sensor's manual.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace berm::app {

constexpr std::size_t kVlp16Bytes = 1206;
constexpr double kVlp16HourS = 3600.0;  // the sensor's clock begins anew every hour

enum class Vlp16Fault { kNone, kSize, kReturnMode, kProduct, kBlockFlag, kAzimuth, kClock };

// All sixteen lasers once. Sensor frame: x at azimuth 0, y left, z up; azimuth grows clockwise seen from above.
struct Vlp16Firing {
  struct Return {
    float x, y, z;  // metres
  };
  double since_packet_s = 0.0;
  int returns = 0;
  std::array<Return, 16> point{};  // by rising elevation
};

struct Vlp16Packet {
  double clock_s = 0.0;  // since the hour, of the first firing
  std::vector<Vlp16Firing> firings;
};

// The last (farther) return of every laser of at least 0.4 m; nearer ones are the sensor's own housing. On a fault packet is unchanged. Total: any
// bytes may come.
Vlp16Fault decode_vlp16(std::string_view bytes, Vlp16Packet& packet);

// What the fault says of which field, for an error line.
const char* vlp16_fault_text(Vlp16Fault fault);

}  // namespace berm::app
