#include "plant/world/truck.hpp"

#include <algorithm>
#include <cmath>

namespace berm::plant {
namespace {
constexpr double acceleration = 0.5;  // m/s2, of a loaded truck with care
}

Truck::Truck(const TruckConfig& config, const SoilConfig& soil, std::string name, double ground_z, double place_x, double place_y, double place_yaw)
    : config_(config), name_(std::move(name)), loose_density_(soil.density_bank / soil.swell), yaw_(config.yaw + place_yaw),
      parked_x_(config.x + place_x), parked_y_(config.y + place_y),
      heap_(config.length, config.width, config.height, config.wall_thickness, soil.repose) {
  const double floor_z = config.wall_top - config.height;
  const double l = config.length / 2, w = config.width / 2, h = config.height, s = config.wall_thickness;
  const double ground = std::min(ground_z - floor_z, -0.05);  // the wheels count as chassis
  const double outside = w + s;
  part_ = {{"front wall", {l, -outside, 0}, {l + s, outside, h}},
           {"rear wall", {-l - s, -outside, 0}, {-l, outside, h}},
           {"left wall", {-l, w, 0}, {l, outside, h}},
           {"right wall", {-l, -outside, 0}, {l, -w, h}},
           {"chassis", {-l - s, -outside, ground}, {l + s, outside, 0}}};
  if (config.cab_length > 0) {
    const double front = l + s + config.cab_gap;
    part_.push_back({"cab", {front, -outside, ground}, {front + config.cab_length, outside, config.cab_top - floor_z}});
  }
  hull_ = {name_, part_[0].low, part_[0].high};
  for (const TruckPart& p : part_) {
    hull_.low = {std::min(hull_.low.x, p.low.x), std::min(hull_.low.y, p.low.y), std::min(hull_.low.z, p.low.z)};
    hull_.high = {std::max(hull_.high.x, p.high.x), std::max(hull_.high.y, p.high.y), std::max(hull_.high.z, p.high.z)};
  }
  place(config.approach_m);
}

double Truck::way(double tau) const {
  const double ramp = config_.speed / acceleration;
  return tau <= 0 ? 0.0 : tau < ramp ? 0.5 * acceleration * tau * tau : 0.5 * config_.speed * ramp + config_.speed * (tau - ramp);
}

double Truck::drive_time() const {
  if (config_.approach_m <= 0 || config_.speed <= 0) return 0;
  const double ramp_way = 0.5 * config_.speed * config_.speed / acceleration;
  return config_.approach_m <= ramp_way ? std::sqrt(2 * config_.approach_m / acceleration)
                                        : config_.speed / acceleration + (config_.approach_m - ramp_way) / config_.speed;
}

void Truck::call(double t) {
  if (called_) return;
  called_ = true;
  // At the very start it may already stand; later it cannot come faster than it drives.
  stand_at_ = t <= 0 ? config_.wait_s : t + std::max(config_.wait_s, drive_time());
}

void Truck::release(double t) {
  if (phase_ != Phase::parked) return;
  phase_ = Phase::leaving;
  leave_at_ = t;
}

void Truck::make_way(double t) {
  if (phase_ == Phase::waiting) called_ = false;
  if (phase_ != Phase::parked) return;
  makes_way_ = true;
  release(t);
}

void Truck::shift(double x, double y) {
  parked_x_ += x;
  parked_y_ += y;
  shifted_x_ += x;
  shifted_y_ += y;
  const double ahead = ahead_;
  ahead_ = -1;
  place(ahead);
}

void Truck::place(double ahead) {
  if (ahead == ahead_) return;
  ahead_ = ahead;
  frame_ = PlanarFrame(parked_x_ + ahead * std::cos(yaw_), parked_y_ + ahead * std::sin(yaw_), config_.wall_top - config_.height, yaw_);
}

void Truck::step(double t, int settle_budget, std::vector<Overflow>& over) {
  if (called_ && (phase_ == Phase::waiting || phase_ == Phase::arriving)) {
    // The arrival is the departure run backwards.
    const double left = stand_at_ - t;
    phase_ = left <= 0 ? Phase::parked : left < drive_time() ? Phase::arriving : Phase::waiting;
    place(left <= 0 ? 0.0 : std::min(config_.approach_m, way(left)));
  } else if (phase_ == Phase::leaving) {
    place(std::min(config_.approach_m, way(t - leave_at_)));
    if (t >= gone_at()) {
      phase_ = makes_way_ ? Phase::waiting : Phase::gone;
      called_ = makes_way_ = false;
    }
  }
  heap_.settle(settle_budget, over);
}

bool Truck::over_bed(const Vec3& p) const { return std::abs(p.x) < config_.length / 2 && std::abs(p.y) < config_.width / 2; }

bool Truck::over_truck(const Vec3& p) const {
  return std::any_of(part_.begin(), part_.end(), [&](const TruckPart& b) { return p.x > b.low.x && p.x < b.high.x && p.y > b.low.y && p.y < b.high.y; });
}

}  // namespace berm::plant
