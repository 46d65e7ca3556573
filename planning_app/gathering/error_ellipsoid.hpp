// The error volume of a point (zolynski-2012, 2.5): an ellipsoid from the deviations of range and of the two angles, at a quantile of the Gaussian.
#pragma once

#include <array>

namespace berm::app {

using Vector3 = std::array<double, 3>;

// A covariance, square metres, symmetric.
struct Covariance {
  float xx, xy, xz, yy, yz, zz;
};

// Standard deviations of one scanner's points: range in metres; along the scan plane and across it in radians, pose errors and vibration included.
struct ScannerDeviations {
  double range_m = 0.012;
  double along_rad = 0.0022;
  double across_rad = 0.0044;
};

// Of a point at range_m along the unit vector beam; normal: of the scan plane, unit, at a right angle to beam. The two angles displace the point at a
// right angle to the beam by range times deviation, to first order.
Covariance point_covariance(const ScannerDeviations& deviations, double range_m, const Vector3& beam, const Vector3& normal);

// The largest half-width of the ellipsoid of that quantile along x, y and z.
double largest_half_width(const Covariance& covariance, double quantile);

// Whether the ellipsoids at two centres, between apart, have a point in common: exact (Perram and Wertheim 1985), touching included.
bool ellipsoids_overlap(const Covariance& a, const Covariance& b, const Vector3& between, double quantile);

// How far apart, in the metric of both: half the squared Mahalanobis distance under the sum, over quantile squared. Above 1 they do not overlap.
double ellipsoid_separation(const Covariance& a, const Covariance& b, const Vector3& between, double quantile);

// Both measured the same place: mean weighted by information, and its covariance, no deviation below least_m.
struct FusedPoint {
  Vector3 shift;  // from the first point
  Covariance covariance;
};
FusedPoint fuse_points(const Covariance& a, const Covariance& b, const Vector3& between, double least_m);

}  // namespace berm::app
