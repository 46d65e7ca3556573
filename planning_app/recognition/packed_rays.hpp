// Rays side by side, and the frame of a bed, for lanes.hpp.
#pragma once

#include <vector>

#include "recognition/bed_model.hpp"
#include "recognition/lanes.hpp"

namespace berm::app {

// Rays in single precision, eight side by side; the last eight are filled up with rays that meet nothing.
class PackedRays {
 public:
  static constexpr float kFar = 1e6F;  // m, of the rays that fill up
  struct alignas(32) EightRays {
    Eights<3> head, at;
    Eight range;       // m
    EightInt upright;  // a mask
  };
  PackedRays() = default;
  explicit PackedRays(const std::vector<Ray>& rays);
  void reserve(std::size_t rays) { eights_.reserve(rays / kLanes + 1); }
  void add(const Eigen::Vector3f& head, const Eigen::Vector3f& at, bool upright) {
    add({head.x(), head.y(), head.z(), at.x(), at.y(), at.z(), (at - head).norm()}, upright ? -1 : 0);
  }
  // Adds the k-th of other ones.
  void take(const PackedRays& from, std::size_t k) {
    const EightRays& r = from.eights_[k / kLanes];
    const auto lane = static_cast<int>(k % kLanes);
    add({r.head[0][lane], r.head[1][lane], r.head[2][lane], r.at[0][lane], r.at[1][lane], r.at[2][lane], r.range[lane]}, r.upright[lane]);
  }
  [[nodiscard]] const std::vector<EightRays>& eights() const { return eights_; }
  // Those of the rays that may meet the bed when no corner of it is moved by more than so many metres; the others are no evidence of it.
  [[nodiscard]] PackedRays meeting(const BedPose& pose, double moved) const;

 private:
  void add(const float (&numbers)[7], std::int32_t upright) {
    if (lane_ == 0) eights_.push_back(kNothing);
    EightRays& last = eights_.back();
    for (std::size_t k = 0; k < 3; ++k) last.head[k][lane_] = numbers[k], last.at[k][lane_] = numbers[3 + k];
    last.range[lane_] = numbers[6];
    last.upright[lane_] = upright;
    lane_ = (lane_ + 1) % static_cast<int>(kLanes);
  }
  // A ray of no length, so far off that it meets no bed.
  static constexpr Eight kFarOff{kFar, kFar, kFar, kFar, kFar, kFar, kFar, kFar}, kOne{1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  static constexpr EightRays kNothing{{{kFarOff, kFarOff, kFarOff}}, {{kFarOff, kFarOff, kFarOff}}, kOne, {}};
  std::vector<EightRays> eights_;
  int lane_ = 0;  // of the next ray
};

// Places of eight rays by axis, in a bed's frame.
struct alignas(32) Places {
  Eight u, v, w;
};

class alignas(32) EightPlacing {
 public:
  explicit EightPlacing(const BedPose& pose) {
    const Eigen::Matrix3d turn = pose.rotation().transpose();
    const Eigen::Vector3d shift = -(turn * pose.middle);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) turn_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(k)] = eight(turn(axis, k));
      shift_[static_cast<std::size_t>(axis)] = eight(shift[axis]);
    }
  }
  [[nodiscard, gnu::always_inline]] Places of(const Eights<3>& at) const { return {along(0, at), along(1, at), along(2, at)}; }

 private:
  [[nodiscard, gnu::always_inline]] Eight along(std::size_t axis, const Eights<3>& at) const {
    return turn_[axis][0] * at[0] + turn_[axis][1] * at[1] + turn_[axis][2] * at[2] + shift_[axis];
  }
  Eights<3> turn_[3];
  Eights<3> shift_;
};

constexpr float kAlong = 1e-12F;  // m: a ray whose ends differ by less goes along the faces of an axis
BERM_APP_INLINE Eight one_by8(Eight d) { return 1.0F / choose8(magnitude8(d) < kAlong, eight(static_cast<double>(kAlong)), d); }

// The rays' ways through a rectangle of faces in plan, as in bed_model.cpp.
struct alignas(32) Crossings {
  Eight in_u, out_u, in_v, out_v;
  [[gnu::always_inline]] Crossings(const Places& a, Eight one_by_u, Eight one_by_v, double rear, double front, double side) {
    const Eight r = (eight(rear) - a.u) * one_by_u, f = (eight(front) - a.u) * one_by_u, right = (eight(-side) - a.v) * one_by_v, left = (eight(side) - a.v) * one_by_v;
    in_u = least8(r, f), out_u = most8(r, f), in_v = least8(right, left), out_v = most8(right, left);
  }
  [[nodiscard, gnu::always_inline]] Eight in() const { return most8(in_u, in_v); }
  [[nodiscard, gnu::always_inline]] Eight out() const { return least8(out_u, out_v); }
};

// The numbers of those of the rays that come within so many metres of the bed's outer faces, in plan, and there no lower than so many below what is seen of
// the walls.
std::vector<std::uint32_t> numbers_meeting(const BedPose& pose, const PackedRays& rays, double within, double below);

}  // namespace berm::app
