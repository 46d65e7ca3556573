// Native data packets of the Velodyne VLP-16: 1206 bytes, single (strongest or last) and dual return.
//
// Sensor frame: x forward (azimuth 0), y left, z up; azimuth grows clockwise seen from above. No allocation, total: any bytes may come.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/scanline_raster.h"

namespace berm::kernel {

constexpr std::size_t kVlp16PacketBytes = 1206;
constexpr int kVlp16Channels = 16;
constexpr int kVlp16Blocks = 12;                          // of a packet, two firings each; of dual return in pairs of the same
constexpr int kVlp16MaxPoints = kVlp16Blocks * 2 * kVlp16Channels;  // of one packet, single return
constexpr std::uint32_t kVlp16TurnMdeg = 360000;
constexpr std::uint32_t kVlp16FiringMdeg = 200;           // a firing's share of the turn at 10 Hz
constexpr std::int64_t kVlp16FiringNs = 55296;            // from a firing to the next
constexpr double kVlp16RadPerMdeg = 3.14159265358979323846 / 180000.0;
constexpr std::int32_t kVlp16RangeMinMm = 400;            // nearer returns are the sensor's own housing and mount

enum class Vlp16Result { kOk, kSize, kMode, kProduct, kFlag, kAzimuth };

// One last return.
struct Vlp16Return {
  std::uint8_t channel;        // 0..15 by rising elevation: -15 + 2 * channel degrees
  std::uint32_t azimuth_mdeg;  // 0..359999, interpolated to the channel's firing
  std::uint32_t spread_mdeg;   // the return came from within +- this about azimuth_mdeg: half the beam's divergence and one firing's turn
  std::int32_t range_mm;
  std::uint8_t firing = 0;     // of the packet, from 0: all sixteen lasers once
};

struct Vlp16Packet {
  int count;
  int firings;  // 24, of dual return 12; also those without a return
  Vlp16Return point[kVlp16MaxPoints];
};

// The sensor's pose, rigid to the base frame: place in metres, yaw about z (positive left).
struct Vlp16Mount {
  double x_m = 0.0, y_m = 0.0, z_m = 1.8, yaw_rad = 0.0;
};

// All last returns of at least kVlp16RangeMinMm, in firing order. On any result but kOk packet is unchanged.
Vlp16Result vlp16_decode(const std::uint8_t* bytes, std::size_t size, Vlp16Packet& packet);

// All sixteen lasers once, also those without a return. Millimetres, 0: nothing came back. other: the nearer return of a dual pair, or the same.
struct Vlp16Firing {
  std::uint32_t azimuth_mdeg;  // 0..359999, of the first laser
  std::uint32_t turn_mdeg;     // to the next firing
  std::int32_t last_mm[kVlp16Channels], other_mm[kVlp16Channels];
};
// Of a packet that vlp16_decode takes; firing: 0 to vlp16_firings - 1.
bool vlp16_is_dual(const std::uint8_t* bytes);
int vlp16_firings(const std::uint8_t* bytes);
Vlp16Firing vlp16_firing(const std::uint8_t* bytes, int firing);
// 0..359999: where the head was when a block began, whether anything came back or not. block: 0 to kVlp16Blocks - 1.
std::uint32_t vlp16_block_mdeg(const std::uint8_t* bytes, int block);

// Cosine and sine of a channel's elevation in the sensor's frame.
struct Vlp16Elevation {
  double cosine, sine;
};
Vlp16Elevation vlp16_elevation(std::uint8_t channel);

// Where a return may have come from: from edge to edge of the beam, in base-frame millimetres.
struct Vlp16Footprint {
  sk_point left, right;
};

// When the packet was finished by the sensor's own clock, microseconds since the hour; bytes of a whole packet.
std::uint32_t vlp16_clock_us(const std::uint8_t* bytes);

// The edges of a beam in the sensor's level plane, with its range's level part: middle + beside and middle - beside.
struct Vlp16Edges {
  double middle_x, middle_y, beside_x, beside_y;
};
// heading: of the beam's middle, positive left. aside: from it to either edge, at most 1.5 degrees, for which the edges are exact to 1e-9.
Vlp16Edges vlp16_edges(double level, double heading_rad, double aside_rad);

// The sensor's place, base frame.
sk_point vlp16_head(const Vlp16Mount& mount);

// Heights are rounded up, so that the map's height bounds the return.
Vlp16Footprint vlp16_project(const Vlp16Mount& mount, const Vlp16Return& point);

}  // namespace berm::kernel
