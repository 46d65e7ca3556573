// A point or direction in metres.
#pragma once

#include <cmath>

namespace berm::plant {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vec3&) const = default;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline Vec3 unit(const Vec3& a) { return (1.0 / std::sqrt(dot(a, a))) * a; }

// A half line; direction is a unit vector, so that the parameter is the range in metres.
struct Ray {
  Vec3 origin, direction;
  [[nodiscard]] Vec3 at(double range) const { return origin + range * direction; }
};

// A yaw turn about z followed by a shift.
struct PlanarFrame {
  double x = 0, y = 0, z = 0, cos_yaw = 1, sin_yaw = 0;

  PlanarFrame() = default;
  bool operator==(const PlanarFrame&) const = default;
  PlanarFrame(double px, double py, double pz, double yaw) : x(px), y(py), z(pz), cos_yaw(std::cos(yaw)), sin_yaw(std::sin(yaw)) {}

  [[nodiscard]] Vec3 out(const Vec3& p) const { return {x + cos_yaw * p.x - sin_yaw * p.y, y + sin_yaw * p.x + cos_yaw * p.y, z + p.z}; }
  [[nodiscard]] Vec3 in(const Vec3& p) const {
    const double dx = p.x - x, dy = p.y - y;
    return {cos_yaw * dx + sin_yaw * dy, -sin_yaw * dx + cos_yaw * dy, p.z - z};
  }
  [[nodiscard]] Ray in(const Ray& r) const {
    const Vec3& d = r.direction;
    return {in(r.origin), {cos_yaw * d.x + sin_yaw * d.y, -sin_yaw * d.x + cos_yaw * d.y, d.z}};
  }
};

}  // namespace berm::plant
