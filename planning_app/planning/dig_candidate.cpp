#include "planning/dig_candidate.hpp"

#include <algorithm>
#include <cmath>

#include "motion/joint_model.hpp"
#include "motion/outline_points.hpp"
#include "motion/reach_preview.hpp"
#include "planning/dig_shape.hpp"
#include "planning/skyline.hpp"

namespace berm::app {

namespace {

constexpr double profile_step = 0.1;               // m along r
constexpr double entry_height = 0.35;              // the drag begins this far above the surface
constexpr double attitude_end = radians(-172.0);   // curled, mouth up

// Boom and stick, as points of their outlines.
class ArmOutline {
public:
  explicit ArmOutline(const MachineModel& machine) : machine_(machine) {
    constexpr double spacing = 0.1;  // m
    for (const Prism& part : machine.parts) {
      if (part.link == bucket) continue;
      for (const auto& at : outline_points(part, spacing)) points_.push_back({part.link, at});
    }
  }

  // How far it is over the ground at the least, m; negative: in it.
  double over(const SurfaceProfile& ground, const Joints& pose) const {
    const ArmPoints arm = forward(machine_, pose);
    const double cb = std::cos(pose[boom]), sb = std::sin(pose[boom]), cs = std::cos(arm.stick_attitude), ss = std::sin(arm.stick_attitude);
    double least = INFINITY;
    for (const Point& p : points_) {
      const PlanePoint& pin = p.link == boom ? arm.boom_pin : arm.stick_pin;
      const double c = p.link == boom ? cb : cs, s = p.link == boom ? sb : ss;
      const double r = pin.r + p.at[0] * c - p.at[1] * s;
      if (r >= SurfaceProfile::first) least = std::min(least, pin.z + p.at[0] * s + p.at[1] * c - ground.at(r));
    }
    return least;
  }

private:
  struct Point { std::size_t link; std::array<double, 2> at; };  // in the link's frame
  const MachineModel& machine_;
  std::vector<Point> points_;
};

double shape(std::size_t i, std::size_t n) {
  const double u = static_cast<double>(i) / static_cast<double>(n - 1);
  return std::sin(std::numbers::pi * std::clamp(u, 0.0, 1.0));
}

}  // namespace

DigForwardModel::DigForwardModel(const MachineModel& machine, const SiteModel& site, const DigFloor& floor, const DigGround& ground, const DigNeeds& needs,
                                 const DigBounds& bounds)
    : machine_(&machine), site_(&site), floor_(&floor), needs_(&needs), bounds_(bounds), surface_(ground, bounds.bearing, needs.bucket_width),
      goal_(machine, site, bounds.bearing, needs.bucket_width) {}

DigForwardModel::Profile DigForwardModel::profile(double start) const {
  Profile raw;
  for (double r = start; r > bounds_.end_radius - 0.5 * profile_step; r -= profile_step) {
    raw.r.push_back(r);
    raw.z.push_back(surface_.at(r));
  }
  Profile smooth = raw;  // a drag need not follow every clod
  for (std::size_t i = 1; i + 1 < raw.z.size(); ++i) smooth.z[i] = (raw.z[i - 1] + raw.z[i] + raw.z[i + 1]) / 3.0;
  return smooth;
}

double DigForwardModel::lowest(double r, double attitude) const { return std::max({bounds_.floor, floor_->at(r, attitude), goal_.least_tip(r, attitude)}); }

std::vector<DigWaypoint> DigForwardModel::drag(const DigParameters& dig) const {
  const Profile p = profile(dig.start);
  std::vector<DigWaypoint> w;
  const std::size_t n = p.r.size();
  w.push_back({p.r[0], std::max(p.z[0] + entry_height, lowest(p.r[0], dig.attack)), dig.attack});
  for (std::size_t i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(n - 1);
    // As it attacks at first; most of the curl comes late, when the bucket fills.
    const double attitude = dig.attack + (attitude_end - dig.attack) * u * u * (3.0 - 2.0 * u) * 0.85;
    w.push_back({p.r[i], std::max(p.z[i] - dig.depth * shape(i, n), lowest(p.r[i], attitude)), attitude});
  }
  w.push_back({p.r[n - 1], std::max(p.z[n - 1], lowest(p.r[n - 1], attitude_end)) + 0.25, attitude_end});
  return w;
}

// The boom's: until the bucket is over what lies between it and the machine.
double DigForwardModel::lift_seconds(const ArmPoints& end) const {
  constexpr double inward = 2.0, clear = 0.5;  // m
  double top = end.tip.z;
  for (double r = std::max(SurfaceProfile::first, end.tip.r - inward); r <= end.tip.r; r += SurfaceProfile::step) top = std::max(top, surface_.at(r) + clear);
  return time_to_reach(responses_of(*machine_, boom, end.tip.r, needs_->payload).up, 0.0, (top - end.tip.z) / (end.tip.r - machine_->boom_pin_x));
}

std::optional<DigOutcome> DigForwardModel::outcome(const DigParameters& dig) const {
  const auto path = DigPath::solve(*machine_, drag(dig));
  if (!path) return std::nullopt;
  CutModel cut(*machine_, surface_, needs_->bucket_width);
  DigOutcome out;
  const int pieces = static_cast<int>(std::ceil(path->length() / cut_pace));
  const double step = path->length() / pieces;
  for (int k = 0; k <= pieces; ++k) {
    const Joints pose = path->at(path->length() * k / pieces);
    const PlanePoint tip = forward(*machine_, pose).tip;
    cut.reach(pose);
    if (k < pieces) out.seconds += step / speed_along(*machine_, path->slope(k * step), tip.z < surface_.at(tip.r) ? drag_soil_speed : drag_air_speed);
  }
  out.volume = cut.volume();
  out.seconds += lift_seconds(forward(*machine_, path->at(path->length())));
  return out;
}

bool DigForwardModel::in_zone(double r) const {
  const double c = std::cos(bounds_.bearing), s = std::sin(bounds_.bearing), half_width = 0.5 * needs_->bucket_width;
  return in_dig_zone(*site_, r * c + half_width * s, r * s - half_width * c) && in_dig_zone(*site_, r * c - half_width * s, r * s + half_width * c);
}

bool DigForwardModel::permitted(const DigParameters& dig) const {
  const auto path = DigPath::solve(*machine_, drag(dig));
  if (!path) return false;
  const BucketShell shell(*machine_);
  const ArmOutline outline(*machine_);
  CutModel cut(*machine_, surface_, needs_->bucket_width);
  double near = INFINITY, far = 0.0;  // of what is in the soil
  const int pieces = static_cast<int>(std::ceil(path->length() / cut_pace));
  for (int k = 0; k <= pieces; ++k) {
    const Joints pose = path->at(path->length() * k / pieces);
    const ArmPoints arm = forward(*machine_, pose);
    const double ca = std::cos(arm.bucket_attitude), sa = std::sin(arm.bucket_attitude);
    for (const auto& [along, across] : shell.points()) {
      const double r = arm.bucket_pin.r + along * ca - across * sa, z = arm.bucket_pin.z + along * sa + across * ca;
      if (z >= surface_.at(r)) continue;
      near = std::min(near, r);
      far = std::max(far, r);
    }
    cut.reach(pose);
    if (outline.over(cut.surface(), pose) < 0.0) return false;
  }
  if (near <= far && !(in_zone(near) && in_zone(far))) return false;
  return clears_own_body(*machine_, lower_edge(*machine_, path->at(path->length())));
}

}  // namespace berm::app
