// A VLP-16 on a machine that stands on level ground, by ray casting: its native packets, and when it first saw somebody. Independent of the kernel's
// and of the plant's code. Base frame, metres, seconds, radians.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "config/parameter_block.h"

namespace berm::kernel::test {

struct Ray3 {
  std::array<double, 3> from, along;
};
struct StandingPerson {  // an upright cylinder on the ground
  double x, y, radius, height;
  double from_s = 0.0;   // is there from then on
};
struct Somebody {
  const char* name;
  double radius, height;
};
inline constexpr Somebody kAdult{"adult", 0.25, 1.8}, kChild{"child", 0.20, 1.1};
struct StandingBox {
  std::array<double, 3> low, high;
};
// The machine's own parts that a beam can meet: tracks stand, the upper body and the arm turn with the swing.
struct OwnMachine {
  std::vector<StandingBox> tracks, upper_body;
  double boom_rad = 0.87, stick_rad = -1.57, bucket_rad = -0.7;
};

class LidarScene {
 public:
  LidarScene();
  std::vector<StandingPerson> people;
  std::vector<StandingBox> boxes;
  OwnMachine own;

  // The nearest hit, or 0: none within 100 m. of_person: a person's.
  double cast(const Ray3& base, double swing, double t, bool& of_person) const;

 private:
  double cast_arm(const Ray3& upper) const;
};

class LidarSource {
 public:
  using Packet = std::array<std::uint8_t, 1206>;
  LidarSource(const berm_lidar_mount& mount, bool dual, double dust = 0.0) : mount_(mount), dual_(dual), dust_(dust) {}

  // The packets finished in (time of the last call, t].
  void until(double t, const LidarScene& scene, const std::function<double(double)>& swing, std::vector<Packet>& out);
  double first_person_s = -1.0;  // when a beam first came back from a person; -1: never. May be set back

 private:
  void fire(std::int64_t firing, const LidarScene& scene, double swing, std::size_t record);
  double drawn();

  berm_lidar_mount mount_;
  bool dual_;
  double dust_;
  std::int64_t next_ = 0;
  std::uint64_t state_ = 0x9E3779B97F4A7C15U;
  Packet packet_{};
};

}  // namespace berm::kernel::test
