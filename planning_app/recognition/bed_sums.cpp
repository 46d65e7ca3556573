#include "recognition/bed_sums.hpp"

#include <cmath>

namespace berm::app {
namespace {

constexpr float kNoLoss = 1e-6F;      // of a squared residual over kRobust^2: its loss is the residual's square

using Vector8 = PackedStatements::Vector;

BERM_APP_INLINE Eight dot8(const Vector8& a, const Vector8& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Slopes by the bed's own axes: it moves along them, turns about them, grows in length, width and thickness.
struct alignas(32) OwnSums {
  static constexpr std::size_t kProducts = kBedValues * (kBedValues + 1) / 2;
  Eight square{};
  Eights<kBedValues> downhill{};
  Eights<kProducts> products{};  // row by row, from the diagonal on
};

// Places of the base frame in the bed's.
class alignas(32) PlacingBed {
 public:
  PlacingBed(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& middle) {
    const Eigen::Vector3d shift = -(rotation.transpose() * middle);
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) rows_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(k)] = eight(rotation(k, axis));
      shift_[static_cast<std::size_t>(k)] = eight(shift[k]);
    }
  }
  [[nodiscard, gnu::always_inline]] Vector8 of(const Vector8& at) const { return {{dot8(rows_[0], at) + shift_[0], dot8(rows_[1], at) + shift_[1], dot8(rows_[2], at) + shift_[2]}}; }

 private:
  Vector8 rows_[3];
  Vector8 shift_;
};

// slopes: the products of slopes and the slopes as well as the loss.
template <bool slopes>
[[gnu::always_inline]] inline OwnSums own_sums(const std::vector<PackedStatements::EightStatements>& statements, const PlacingBed& place, const BedVector& values) {
  const Eight length = eight(0.5 * values[kBedLength]), width = eight(0.5 * values[kBedWidth]), thickness = eight(values[kBedThickness]);
  OwnSums sums;
  for (const PackedStatements::EightStatements& s : statements) {
    const Vector8 head = place.of(s.head), end = place.of(s.at), way{{end[0] - head[0], end[1] - head[1], end[2] - head[2]}};
    const Vector8 bound_size{{magnitude8(s.bound[0]), magnitude8(s.bound[1]), s.bound_thick}}, plane_size{{magnitude8(s.plane[0]), magnitude8(s.plane[1]), s.plane_thick}};
    const Vector8 sizes{{length, width, thickness}};
    const Eight one_by_across = 1.0F / choose8(s.edge, dot8(s.plane, way), eight(1.0));
    const Eight share = choose8(s.edge, (dot8(plane_size, sizes) - dot8(s.plane, head)) * one_by_across, eight(1.0));
    const Vector8 at{{head[0] + share * way[0], head[1] + share * way[1], head[2] + share * way[2]}};
    const Eight x = (dot8(s.bound, at) - dot8(bound_size, sizes) - s.offset) * s.scale;
    // What the loss and the logistic function of an edge make of it: t t, and the factors of the products of slopes and of the slopes.
    const Eight e = exp8(most8(least8(x, eight(kCertain)), eight(-2.0 * kCertain))), half_square = choose8(x > eight(kCertain), x, log1p8(e));
    const Eight over = choose8(s.edge, eight(2.0) * half_square, x * x) * eight(1.0 / (kRobust * kRobust)), loss = log1p8(over);
    const EightInt says = ~(s.edge & (x < eight(-kCertain)));
    sums.square += where8(says, loss);
    if constexpr (!slopes) continue;
    const Eight sigma = e / (1.0F + e), one_by_outer = 1.0F / (1.0F + over);
    const Eight of_return = choose8(over > kNoLoss, over / loss, eight(1.0)), of_edge = sigma * sigma / (eight(kRobust * kRobust) * most8(loss, eight(1e-12)));
    const Eight of_products = where8(says, choose8(s.edge, of_edge, of_return) * one_by_outer * one_by_outer * s.scale * s.scale);
    const Eight of_slope = where8(says, choose8(s.edge, sigma, x) * one_by_outer * s.scale);
    // The crossing moves along the ray as the plane moves against it.
    const Eight along = where8(s.edge, dot8(s.bound, way) * one_by_across);
    const Vector8 normal{{s.bound[0] - along * s.plane[0], s.bound[1] - along * s.plane[1], s.bound[2] - along * s.plane[2]}};
    const Eights<kBedValues> slope{{-normal[0], -normal[1], -normal[2],
                                             normal[1] * at[2] - normal[2] * at[1], normal[2] * at[0] - normal[0] * at[2], normal[0] * at[1] - normal[1] * at[0],
                                             eight(0.5) * (along * plane_size[0] - bound_size[0]), eight(0.5) * (along * plane_size[1] - bound_size[1]), along * plane_size[2] - bound_size[2]}};
    std::size_t k = 0;
#pragma GCC unroll 9
    for (std::size_t i = 0; i < kBedValues; ++i) {
      const Eight factor = of_products * slope[i];
      sums.downhill[i] -= of_slope * slope[i];
#pragma GCC unroll 9
      for (std::size_t j = i; j < kBedValues; ++j) sums.products[k++] += factor * slope[j];
    }
  }
  return sums;
}

BERM_APP_LANES OwnSums sum_statements(const std::vector<PackedStatements::EightStatements>& statements, const PlacingBed& place, const BedVector& values) {
  return own_sums<true>(statements, place, values);
}
BERM_APP_LANES double sum_losses(const std::vector<PackedStatements::EightStatements>& statements, const PlacingBed& place, const BedVector& values) {
  return static_cast<double>(sum8(own_sums<false>(statements, place, values).square));
}

}  // namespace

PackedStatements::PackedStatements(const std::vector<BedConstraint>& statements, int open_end) {
  // A place of no weight, that lies nowhere near an edge.
  static constexpr Eight kNone{}, kOne{1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  static constexpr EightStatements kNothing{{{kNone, kNone, kNone}}, {{kNone, kNone, kOne}}, {{kNone, kNone, kNone}}, {{kNone, kNone, kNone}}, kNone, kNone, kNone, kNone, {}};
  eights_.reserve(statements.size() / kLanes + 1);
  const auto thick = [open_end](const BedPlane& plane) { return plane.axis < 2 && plane.outer && !(plane.axis == 0 && plane.side == open_end) ? 1.0F : 0.0F; };
  const auto side = [](const BedPlane& plane) { return plane.axis == 2 ? 1.0F : static_cast<float>(plane.side); };
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const BedConstraint& c = statements[i];
    const auto lane = static_cast<int>(i % kLanes);
    if (lane == 0) eights_.push_back(kNothing);
    EightStatements& out = eights_.back();
    for (int k = 0; k < 3; ++k) out.head[static_cast<std::size_t>(k)][lane] = c.head[k], out.at[static_cast<std::size_t>(k)][lane] = c.at[k];
    const BedPlane& bound = c.edge ? c.bound : c.plane;
    out.bound[static_cast<std::size_t>(bound.axis)][lane] = side(bound), out.bound_thick[lane] = thick(bound);
    if (c.edge) out.plane[static_cast<std::size_t>(c.plane.axis)][lane] = side(c.plane), out.plane_thick[lane] = thick(c.plane);
    out.scale[lane] = static_cast<float>((c.edge ? c.sense : 1) / c.deviation);
    out.offset[lane] = static_cast<float>(c.edge ? 0.0 : c.offset);
    out.edge[lane] = c.edge ? -1 : 0;
  }
}

double square_of(const PackedStatements& statements, const BedVector& values) {
  BedPose pose;
  set_values(pose, values);
  return kRobust * kRobust * sum_losses(statements.eights(), {pose.rotation(), pose.middle}, values);
}

BedSums sums_of(const PackedStatements& statements, const BedVector& values) {
  BedPose pose;
  set_values(pose, values);
  const Eigen::Matrix3d rotation = pose.rotation();
  const OwnSums own = sum_statements(statements.eights(), {rotation, pose.middle}, values);
  BedSums::Products products;
  BedVector downhill;
  std::size_t k = 0;
  for (int i = 0; i < kBedValues; ++i) {
    downhill[i] = static_cast<double>(sum8(own.downhill[static_cast<std::size_t>(i)]));
    for (int j = i; j < kBedValues; ++j) products(i, j) = products(j, i) = static_cast<double>(sum8(own.products[k++]));
  }
  // From the bed's own axes to the values: the base frame's axes, and the axes of yaw, pitch and roll.
  Eigen::Matrix3d about;
  about << 0.0, -std::sin(pose.yaw), rotation(0, 0), 0.0, std::cos(pose.yaw), rotation(1, 0), 1.0, 0.0, rotation(2, 0);
  BedSums::Products turn = BedSums::Products::Identity();
  turn.block<3, 3>(0, 0) = rotation;
  turn.block<3, 3>(3, 3) = about.transpose() * rotation;
  BedSums out;
  out.square = kRobust * kRobust * static_cast<double>(sum8(own.square));
  out.products = turn * products * turn.transpose();
  out.downhill = turn * downhill;
  return out;
}

}  // namespace berm::app
