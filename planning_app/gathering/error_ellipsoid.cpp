#include "gathering/error_ellipsoid.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {
namespace {

// A symmetric matrix in double, as Covariance.
struct Symmetric {
  double xx, xy, xz, yy, yz, zz;
};

Symmetric mix(const Covariance& a, double weight_a, const Covariance& b, double weight_b) {
  const auto m = [=](float p, float q) { return weight_a * static_cast<double>(p) + weight_b * static_cast<double>(q); };
  return {m(a.xx, b.xx), m(a.xy, b.xy), m(a.xz, b.xz), m(a.yy, b.yy), m(a.yz, b.yz), m(a.zz, b.zz)};
}

// Adjugate and determinant: the inverse times the determinant.
Symmetric adjugate(const Symmetric& m, double& determinant) {
  const Symmetric out{m.yy * m.zz - m.yz * m.yz, m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
                      m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy};
  determinant = m.xx * out.xx + m.xy * out.xy + m.xz * out.xz;
  return out;
}

Vector3 times(const Symmetric& m, const Vector3& v) {
  return {m.xx * v[0] + m.xy * v[1] + m.xz * v[2], m.xy * v[0] + m.yy * v[1] + m.yz * v[2], m.xz * v[0] + m.yz * v[1] + m.zz * v[2]};
}

double inverse_form(const Symmetric& m, const Vector3& v) {
  double determinant = 0.0;
  const Vector3 w = times(adjugate(m, determinant), v);
  return (v[0] * w[0] + v[1] * w[1] + v[2] * w[2]) / determinant;
}

}  // namespace

Covariance point_covariance(const ScannerDeviations& deviations, double range_m, const Vector3& beam, const Vector3& normal) {
  const double along = deviations.along_rad * range_m, across = deviations.across_rad * range_m;
  const double a = along * along, r = deviations.range_m * deviations.range_m - a, n = across * across - a;
  const auto entry = [&](std::size_t i, std::size_t j) {
    return static_cast<float>((i == j ? a : 0.0) + r * beam[i] * beam[j] + n * normal[i] * normal[j]);
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

double largest_half_width(const Covariance& c, double quantile) { return quantile * std::sqrt(static_cast<double>(std::max({c.xx, c.yy, c.zz}))); }

double ellipsoid_separation(const Covariance& a, const Covariance& b, const Vector3& between, double quantile) {
  return 0.5 * inverse_form(mix(a, 1.0, b, 1.0), between) / (quantile * quantile);
}

bool ellipsoids_overlap(const Covariance& a, const Covariance& b, const Vector3& between, double quantile) {
  // The contact function s (1 - s) d' [(1 - s) A + s B]^-1 d is concave in s; the ellipsoids are disjoint when it exceeds 1 anywhere.
  const double limit = quantile * quantile;
  const auto contact = [&](double s) { return s * (1.0 - s) * inverse_form(mix(a, 1.0 - s, b, s), between); };
  const auto centre_inside = [&](const Covariance& c) { return inverse_form(mix(c, 1.0, c, 0.0), between) <= limit; };
  if (centre_inside(a) || centre_inside(b)) return true;
  constexpr double kGolden = 0.6180339887498949;
  double low = 0.0, high = 1.0, left = 1.0 - kGolden, right = kGolden, at_left = contact(left), at_right = contact(right);
  for (int i = 0; i < 24; ++i) {
    if (at_left > limit || at_right > limit) return false;
    if (at_left < at_right) {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = contact(right);
    } else {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = contact(left);
    }
  }
  return std::max(at_left, at_right) <= limit;
}

FusedPoint fuse_points(const Covariance& a, const Covariance& b, const Vector3& between, double least_m) {
  double determinant = 0.0;
  const Symmetric inverse = adjugate(mix(a, 1.0, b, 1.0), determinant);
  const Symmetric first = mix(a, 1.0, a, 0.0);
  const Vector3 weighted = times(inverse, {between[0] / determinant, between[1] / determinant, between[2] / determinant});
  FusedPoint out;
  out.shift = times(first, weighted);
  // A - A (A + B)^-1 A, column by column.
  const auto column = [&](const Vector3& of_a) { return times(first, times(inverse, of_a)); };
  const Vector3 cx = column({first.xx, first.xy, first.xz}), cy = column({first.xy, first.yy, first.yz}), cz = column({first.xz, first.yz, first.zz});
  const double least = least_m * least_m;
  const auto diagonal = [&](double value) { return static_cast<float>(std::max(value, least)); };
  out.covariance = {diagonal(first.xx - cx[0] / determinant),           static_cast<float>(first.xy - cx[1] / determinant),
                    static_cast<float>(first.xz - cx[2] / determinant), diagonal(first.yy - cy[1] / determinant),
                    static_cast<float>(first.yz - cy[2] / determinant), diagonal(first.zz - cz[2] / determinant)};
  return out;
}

}  // namespace berm::app
