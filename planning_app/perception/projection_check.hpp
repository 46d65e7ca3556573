// The app's points held against the kernel's: two programs that were written apart place the same return, and one that is wrong is noticed. Metres,
// base frame.
//
// What may be between the two, in each axis: the kernel rounds x and y to the nearest millimetre and z up (1 mm), and its scanner heads to the
// nearest (0.5 mm, by the turn of the swing up to 0.7): 1.5 mm. Both interpolate the same angles, which the state segment tells in whole
// microradians, and the kernel cuts a sample's time to whole microseconds: 0.02 mm at 15 m and one radian a second. A swing slower than
// MachineHistory::least_swing may hide that a cycle brought no new angles: 0.01 rad/s x 10 ms x 15 m = 1.5 mm more. Samples between states that are
// no neighbours are not compared, nor is what lies farther than any map.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace berm::app {

class ProjectionCheck {
public:
  static constexpr double tolerance = 0.003;
  static constexpr double farthest = 15.0;  // of x, y and z

  struct Disagreement {
    std::size_t scanner = 0;
    double time_s = 0.0;
    std::array<double, 3> here{}, kernel{};  // m
    double distance() const;
  };

  // kernel_mm: berm_scan_block.point_mm; at the origin the kernel has placed no return.
  void compare(std::size_t scanner, double time_s, const std::array<double, 3>& here, const std::int32_t (&kernel_mm)[3]);

  std::uint64_t compared() const { return compared_; }
  std::uint64_t disagreeing() const { return disagreeing_; }
  const std::optional<Disagreement>& first() const { return first_; }

private:
  std::uint64_t compared_ = 0, disagreeing_ = 0;
  std::optional<Disagreement> first_;
};

}  // namespace berm::app
