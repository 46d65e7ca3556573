// The true geometry of the simulated machine: what the world cuts soil with, casts rays against and judges contacts by.
// No margin and no heap of soil: the kernel's own prisms must cover these. Metres, radians.
//
// Frames. Base: origin on the ground under the swing axis, x forward at swing 0, y left, z up. Upper body: base turned by the swing about z.
// Link frames (boom, stick, bucket): origin in the link's near pin, x along the pin line, z to its left (up when the link points forward
// and level). Angles as in JointState: boom from the horizontal, stick from the boom line, bucket from the stick line.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace berm::plant {

struct OutlinePoint { double x, z; };  // link frame

// A convex prism about the swing plane: y from -half_width to half_width of the upper body's frame.
struct SolidPart {
  int link = 1;                        // 1 boom, 2 stick, 3 bucket
  double half_width = 0.0;
  std::vector<OutlinePoint> outline;   // convex, counter-clockwise (x towards z)
};

struct AxisBox { std::array<double, 3> low{}, high{}; };

struct ScannerMount {
  std::array<double, 3> position{};    // head, upper body's frame
  double pan_low = 0.0, pan_high = 0.0;
  double pan_rate_max = 0.0, pan_acceleration = 0.0;
};

constexpr int lidars_most = 4;

struct LidarMount {                    // VLP-16: sensor's frame in the upper body's, turned by yaw, then pitch (front down), then roll (left up)
  std::array<double, 3> position{};
  double roll = 0.0, pitch = 0.0, yaw = 0.0;
  double sector_deg = 80.0;            // half field of view about azimuth 0, degrees; what looks elsewhere is blanked, as the sensor can be told
  bool dual = false;                   // dual return packets, with dust; else the strongest return alone
  bool outliers = false;               // ranges that are none, with the scanners' probability
};

struct ImplementShape {
  double boom_pin_x = 0.0, boom_pin_z = 0.0;           // upper body's frame
  double boom = 0.0, stick = 0.0, bucket = 0.0;        // pin to pin, pin to tip
  std::vector<SolidPart> parts;
  double bucket_half_width = 0.0;                      // of the cutting edge
  double bucket_heaped_m3 = 0.0;                       // loose soil it holds when heaped
  double bucket_payload_max_kg = 0.0;                  // no pass carries more
  std::vector<AxisBox> upper_body;                     // upper body's frame; turn with the swing
  std::vector<AxisBox> tracks;                         // base frame
  std::array<ScannerMount, 2> scanner;                 // left, right
  std::vector<LidarMount> lidar;                       // lidars_most at most
};

}  // namespace berm::plant
