#include "recognition/bed_sums.hpp"

#include <cmath>

namespace berm::app {
namespace {

constexpr float kNoLoss = 1e-6F;      // of a squared residual over kRobust^2: its loss is the residual's square

using Vector4 = PackedStatements::Vector;

Four dot4(const Vector4& a, const Vector4& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Slopes by the bed's own axes: it moves along them, turns about them, grows in length, width and thickness.
struct OwnSums {
  static constexpr std::size_t kProducts = kBedValues * (kBedValues + 1) / 2;
  Four square{};
  std::array<Four, kBedValues> downhill{};
  std::array<Four, kProducts> products{};  // row by row, from the diagonal on
};

// Places of the base frame in the bed's.
class PlacingBed {
 public:
  PlacingBed(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& middle) {
    const Eigen::Vector3d shift = -(rotation.transpose() * middle);
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) rows_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(k)] = four(rotation(k, axis));
      shift_[static_cast<std::size_t>(k)] = four(shift[k]);
    }
  }
  [[nodiscard]] Vector4 of(const Vector4& at) const { return {dot4(rows_[0], at) + shift_[0], dot4(rows_[1], at) + shift_[1], dot4(rows_[2], at) + shift_[2]}; }

 private:
  std::array<Vector4, 3> rows_;
  Vector4 shift_;
};

[[gnu::always_inline]] inline OwnSums own_sums(const std::vector<PackedStatements::FourStatements>& statements, const PlacingBed& place, const BedVector& values) {
  const Four length = four(0.5 * values[kBedLength]), width = four(0.5 * values[kBedWidth]), thickness = four(values[kBedThickness]);
  OwnSums sums;
  for (const PackedStatements::FourStatements& s : statements) {
    const Vector4 head = place.of(s.head), end = place.of(s.at), way{end[0] - head[0], end[1] - head[1], end[2] - head[2]};
    const Vector4 bound_size{magnitude4(s.bound[0]), magnitude4(s.bound[1]), s.bound_thick}, plane_size{magnitude4(s.plane[0]), magnitude4(s.plane[1]), s.plane_thick};
    const Vector4 sizes{length, width, thickness};
    const Four one_by_across = 1.0F / choose4(s.edge, dot4(s.plane, way), four(1.0));
    const Four share = choose4(s.edge, (dot4(plane_size, sizes) - dot4(s.plane, head)) * one_by_across, four(1.0));
    const Vector4 at{head[0] + share * way[0], head[1] + share * way[1], head[2] + share * way[2]};
    const Four x = (dot4(s.bound, at) - dot4(bound_size, sizes) - s.offset) * s.scale;
    // The crossing moves along the ray as the plane moves against it.
    const Four along = where4(s.edge, dot4(s.bound, way) * one_by_across);
    const Vector4 normal{s.bound[0] - along * s.plane[0], s.bound[1] - along * s.plane[1], s.bound[2] - along * s.plane[2]};

    // What the loss and the logistic function of an edge make of it: t t, and the factors of the products of slopes and of the slopes.
    const Four e = exp4(most4(least4(x, four(kCertain)), four(-2.0 * kCertain))), half_square = choose4(x > four(kCertain), x, log1p4(e)), sigma = e / (1.0F + e);
    const Four over = choose4(s.edge, four(2.0) * half_square, x * x) * four(1.0 / (kRobust * kRobust)), loss = log1p4(over), one_by_outer = 1.0F / (1.0F + over);
    const FourInt says = ~(s.edge & (x < four(-kCertain)));
    const Four of_return = choose4(over > kNoLoss, over / loss, four(1.0)), of_edge = sigma * sigma / (four(kRobust * kRobust) * most4(loss, four(1e-12)));
    const Four of_products = where4(says, choose4(s.edge, of_edge, of_return) * one_by_outer * one_by_outer * s.scale * s.scale);
    const Four of_slope = where4(says, choose4(s.edge, sigma, x) * one_by_outer * s.scale);
    sums.square += where4(says, loss);

    const std::array<Four, kBedValues> slope{-normal[0], -normal[1], -normal[2],
                                             normal[1] * at[2] - normal[2] * at[1], normal[2] * at[0] - normal[0] * at[2], normal[0] * at[1] - normal[1] * at[0],
                                             four(0.5) * (along * plane_size[0] - bound_size[0]), four(0.5) * (along * plane_size[1] - bound_size[1]), along * plane_size[2] - bound_size[2]};
    std::size_t k = 0;
#pragma GCC unroll 9
    for (std::size_t i = 0; i < kBedValues; ++i) {
      const Four factor = of_products * slope[i];
      sums.downhill[i] -= of_slope * slope[i];
#pragma GCC unroll 9
      for (std::size_t j = i; j < kBedValues; ++j) sums.products[k++] += factor * slope[j];
    }
  }
  return sums;
}

BERM_APP_LANES OwnSums sum_statements(const std::vector<PackedStatements::FourStatements>& statements, const PlacingBed& place, const BedVector& values) {
  return own_sums(statements, place, values);
}

}  // namespace

PackedStatements::PackedStatements(const std::vector<BedConstraint>& statements, int open_end) {
  // A place of no weight, that lies nowhere near an edge.
  static constexpr Four kNone{}, kOne{1.0F, 1.0F, 1.0F, 1.0F};
  static constexpr FourStatements kNothing{{kNone, kNone, kNone}, {kNone, kNone, kOne}, {kNone, kNone, kNone}, {kNone, kNone, kNone}, kNone, kNone, kNone, kNone, {}};
  fours_.reserve(statements.size() / 4 + 1);
  const auto thick = [open_end](const BedPlane& plane) { return plane.axis < 2 && plane.outer && !(plane.axis == 0 && plane.side == open_end) ? 1.0F : 0.0F; };
  const auto side = [](const BedPlane& plane) { return plane.axis == 2 ? 1.0F : static_cast<float>(plane.side); };
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const BedConstraint& c = statements[i];
    const auto lane = static_cast<int>(i % 4);
    if (lane == 0) fours_.push_back(kNothing);
    FourStatements& out = fours_.back();
    for (int k = 0; k < 3; ++k) out.head[static_cast<std::size_t>(k)][lane] = static_cast<float>(c.head[k]), out.at[static_cast<std::size_t>(k)][lane] = static_cast<float>(c.at[k]);
    const BedPlane& bound = c.edge ? c.bound : c.plane;
    out.bound[static_cast<std::size_t>(bound.axis)][lane] = side(bound), out.bound_thick[lane] = thick(bound);
    if (c.edge) out.plane[static_cast<std::size_t>(c.plane.axis)][lane] = side(c.plane), out.plane_thick[lane] = thick(c.plane);
    out.scale[lane] = static_cast<float>((c.edge ? c.sense : 1) / c.deviation);
    out.offset[lane] = static_cast<float>(c.edge ? 0.0 : c.offset);
    out.edge[lane] = c.edge ? -1 : 0;
  }
}

BedSums sums_of(const PackedStatements& statements, const BedVector& values) {
  BedPose pose;
  set_values(pose, values);
  const Eigen::Matrix3d rotation = pose.rotation();
  const OwnSums own = sum_statements(statements.fours(), {rotation, pose.middle}, values);
  BedSums::Products products;
  BedVector downhill;
  std::size_t k = 0;
  for (int i = 0; i < kBedValues; ++i) {
    downhill[i] = static_cast<double>(sum4(own.downhill[static_cast<std::size_t>(i)]));
    for (int j = i; j < kBedValues; ++j) products(i, j) = products(j, i) = static_cast<double>(sum4(own.products[k++]));
  }
  // From the bed's own axes to the values: the base frame's axes, and the axes of yaw, pitch and roll.
  Eigen::Matrix3d about;
  about << 0.0, -std::sin(pose.yaw), rotation(0, 0), 0.0, std::cos(pose.yaw), rotation(1, 0), 1.0, 0.0, rotation(2, 0);
  BedSums::Products turn = BedSums::Products::Identity();
  turn.block<3, 3>(0, 0) = rotation;
  turn.block<3, 3>(3, 3) = about.transpose() * rotation;
  BedSums out;
  out.square = kRobust * kRobust * static_cast<double>(sum4(own.square));
  out.products = turn * products * turn.transpose();
  out.downhill = turn * downhill;
  return out;
}

}  // namespace berm::app
