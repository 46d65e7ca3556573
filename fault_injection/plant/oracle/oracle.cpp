#include "plant/oracle/oracle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "plant/oracle/ground_gap.hpp"

namespace berm::plant::oracle {
namespace {

// Corners of the implements' outlines in the swing plane: sums of turned link vectors along the chain.
std::vector<Profile> profiles(const ImplementShape& shape, const std::array<double, 4>& joints) {
  const std::array<double, 3> length = {shape.boom, shape.stick, shape.bucket};
  std::array<Eigen::Vector2d, 3> pin;
  std::array<Eigen::Matrix2d, 3> turn;
  Eigen::Vector2d at(shape.boom_pin_x, shape.boom_pin_z);
  double angle = 0;
  for (size_t i = 0; i < 3; ++i) {
    angle += joints[i + 1];
    turn[i] << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    pin[i] = at;
    at += turn[i].col(0) * length[i];
  }
  std::vector<Profile> all;
  for (const SolidPart& part : shape.parts) {
    const auto link = static_cast<size_t>(part.link - 1);
    Profile p;
    p.half_width = part.half_width;
    for (const OutlinePoint& q : part.outline) p.corner.push_back(pin[link] + turn[link] * Eigen::Vector2d(q.x, q.z));
    all.push_back(std::move(p));
  }
  return all;
}

Point swung(double r, double across, double z, double c, double s) { return {c * r - s * across, s * r + c * across, z}; }

Eigen::Isometry3d placed(const Stand& stand) {
  return Eigen::Translation3d(stand.x, stand.y, 0) * Eigen::AngleAxisd(stand.yaw, Point::UnitZ()) * Eigen::AngleAxisd(stand.pitch, Point::UnitY()) *
         Eigen::AngleAxisd(stand.roll, Point::UnitX());
}

std::vector<Point> corners_of(const Profile& p, double swing, const Eigen::Isometry3d& place) {
  const double c = std::cos(swing), s = std::sin(swing);
  std::vector<Point> corner;
  for (const Eigen::Vector2d& q : p.corner) {
    corner.push_back(place * swung(q.x(), -p.half_width, q.y(), c, s));
    corner.push_back(place * swung(q.x(), p.half_width, q.y(), c, s));
  }
  return corner;
}

// A part over the world's ground: the least upright prism along the swing plane's bearing that holds it.
Upright upright(const Profile& p, double swing, const Eigen::Isometry3d& place) {
  const Point ahead = place.linear() * Point(std::cos(swing), std::sin(swing), 0);
  Upright out;
  out.bearing = std::atan2(ahead.y(), ahead.x());
  const double c = std::cos(out.bearing), s = std::sin(out.bearing);
  double left = -1e9, right = 1e9;
  for (const Point& q : corners_of(p, swing, place)) {
    const Point from = q - place.translation();
    out.part.corner.emplace_back(c * from.x() + s * from.y(), q.z());
    left = std::max(left, c * from.y() - s * from.x());
    right = std::min(right, c * from.y() - s * from.x());
  }
  out.part.half_width = (left - right) / 2;
  out.x = place.translation().x() - s * (left + right) / 2;
  out.y = place.translation().y() + c * (left + right) / 2;
  return out;
}

}  // namespace

Body body_of(const Block& b) {
  const double c = std::cos(b.yaw), s = std::sin(b.yaw);
  std::vector<Point> corner;
  for (const double x : {b.low[0], b.high[0]}) {
    for (const double y : {b.low[1], b.high[1]}) {
      for (const double z : {b.low[2], b.high[2]}) corner.push_back(Point(b.x, b.y, b.z) + swung(x, y, z, c, s));
    }
  }
  return Body::polytope(std::move(corner));
}

std::vector<Body> Oracle::machine(const std::array<double, 4>& joints, const Stand& stand) const {
  const Eigen::Isometry3d place = placed(stand);
  std::vector<Body> all;
  for (const Profile& p : profiles(shape_, joints)) all.push_back(Body::polytope(corners_of(p, joints[0], place)));
  for (const AxisBox& b : shape_.upper_body) {
    Body body = body_of({"", 0, 0, 0, joints[0], b.low, b.high});
    for (Point& q : body.corner) q = place * q;
    all.push_back(Body::polytope(std::move(body.corner)));
  }
  return all;
}

Judgement Oracle::judge(const std::array<double, 4>& joints, const Site& site, const Stand& stand) const {
  Judgement out;
  const std::vector<Body> own = machine(joints, stand);
  const auto against = [&](const Body& other, const std::string& name) {
    for (size_t i = 0; i < own.size(); ++i) {
      const Body& part = own[i];
      // The spheres that hold the bodies cannot be nearer than this; skip what cannot become the nearest.
      if ((part.middle - other.middle).norm() - part.reach - other.reach >= out.closest) continue;
      const Distance d = distance(part, other);
      const double found = d.meet() ? 0.0 : d.upper;
      if (found < out.closest) {
        out.closest = found;
        out.what = name;
        out.by_upper_body = i >= shape_.parts.size();
      }
    }
  };
  for (const Person& p : site.people) against(Body::cylinder({p.x, p.y, p.z}, p.radius, p.height), p.name);
  for (const Block& b : site.blocks) against(body_of(b), b.name);
  out.contact = out.closest <= 0;

  double floor_gap = 1e9;
  const std::vector<Profile> parts = profiles(shape_, joints);
  for (auto p = parts.rbegin(); p != parts.rend(); ++p) {  // the bucket first: over most columns the others are higher than it is over its own
    const Upright u = upright(*p, joints[0], placed(stand));
    out.ground_gap = gap_outside_zones(u, site.ground, site.zones, out.ground_gap);
    floor_gap = std::min(floor_gap, gap_over_floor(u, site.zones));
  }
  if (!out.contact && out.ground_gap <= 0) {
    out.contact = true;
    out.what = "ground outside the dig zone";
    out.by_upper_body = false;
  } else if (!out.contact && floor_gap <= 0) {
    out.contact = true;
    out.what = "floor of the dig zone";
    out.by_upper_body = false;
  }
  out.ground_gap = std::min(out.ground_gap, floor_gap);
  return out;
}

}  // namespace berm::plant::oracle
