// A panning scanner over sloping ground, by ray casting, with noise, spurious returns, the body of a truck and somebody walking: what the two
// versions of the Workspace Monitor are compared on. Independent of the kernel's and of the plant's code. Base frame, metres, seconds, radians.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace berm::kernel::test {

struct Walker {  // an upright cylinder on the ground
  double radius = 0.25, height = 1.8;
  double bearing = 0.0, from_m = 17.0, speed_m_s = 1.4, to_m = 4.0;  // straight towards the swing axis
  double starts_s = 0.0;
};

struct Wall {  // upright, along the axes
  std::array<double, 3> low, high;
};

struct Seen {
  double x, y, z;
  int line, sample;
  bool of_walker, spurious;
};

class WalkedGround {
 public:
  // The paper's scanners (section 4.1): 26 scanlines a second, panned at 30 degrees a second, half a degree from sample to sample.
  static constexpr double kLinesPerS = 26.0, kSampleRad = 0.00873, kLowestRad = -1.05, kHighestRad = 0.09;
  static constexpr double kPanRadPerS = 0.5236, kPanRad = 1.6, kHeadZ = 3.2, kNoiseM = 0.03, kPanNoiseRad = 0.002;
  static constexpr double kSpurious = 0.001;

  WalkedGround(std::uint64_t seed, double slope) : random_(seed), slope_(slope) {}

  std::vector<Wall> walls;
  bool walks = false;
  Walker walker;

  // The returns of the next scanline, from below upwards, and when it is finished.
  double line(std::vector<Seen>& out);
  double ground(double x, double y) const;
  double time_s() const { return lines_ / kLinesPerS; }
  double walked_m(double t) const;  // from the swing axis

 private:
  double pan(double t) const;
  double cast(const std::array<double, 3>& along, double t, bool& of_walker) const;

  std::mt19937_64 random_;
  double slope_;
  int lines_ = 0;
};

}  // namespace berm::kernel::test
