#include "planning/cut_model.hpp"

#include <algorithm>
#include <cmath>

#include "motion/outline_points.hpp"

namespace berm::app {

SurfaceProfile::SurfaceProfile(const DigGround& ground, double bearing, double width) {
  const double c = std::cos(bearing), s = std::sin(bearing);
  const std::size_t count = static_cast<std::size_t>(std::lround((last - first) / step)) + 1;
  z_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double r = first + step * static_cast<double>(i);
    double sum = 0.0;
    for (int k = -2; k <= 2; ++k) {
      const double across = 0.22 * k * width;
      sum += ground.height(r * c - across * s, r * s + across * c);
    }
    z_.push_back(0.2 * sum);
  }
}

double SurfaceProfile::at(double r) const {
  const double place = std::clamp((r - first) / step, 0.0, static_cast<double>(z_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(place), z_.size() - 2);
  const double t = place - static_cast<double>(i);
  return (1.0 - t) * z_[i] + t * z_[i + 1];
}

BucketShell::BucketShell(const MachineModel& machine) {
  constexpr double spacing = 0.06;      // under a step of the profile
  constexpr double shell_side = -0.05;
  for (const Prism& part : machine.parts) {
    if (part.link != bucket) continue;
    for (const auto& point : outline_points(part, spacing))
      if (point[1] >= shell_side) points_.push_back(point);
  }
}

CutModel::CutModel(const MachineModel& machine, const SurfaceProfile& surface, double bucket_width)
    : machine_(&machine), shell_(machine), surface_(surface), width_(bucket_width) {}

double CutModel::reach(const Joints& pose) {
  std::vector<double>& z = surface_.heights();
  const ArmPoints arm = forward(*machine_, pose);
  const double c = std::cos(arm.bucket_attitude), s = std::sin(arm.bucket_attitude);
  double area = 0.0;
  for (const auto& [along, across] : shell_.points()) {
    const double r = arm.bucket_pin.r + along * c - across * s, height = arm.bucket_pin.z + along * s + across * c;
    const double place = (r - SurfaceProfile::first) / SurfaceProfile::step + 0.5;  // of the nearest
    if (!(place >= 0.0 && place < static_cast<double>(z.size()))) continue;
    double& ground = z[static_cast<std::size_t>(place)];
    if (ground > height) {
      area += (ground - height) * SurfaceProfile::step;
      ground = height;
    }
  }
  volume_ += area * width_;
  return area * width_;
}

std::vector<double> fill_along(const MachineModel& machine, const SurfaceProfile& surface, double bucket_width, const DigPath& path) {
  CutModel model(machine, surface, bucket_width);
  const std::size_t pieces = static_cast<std::size_t>(std::ceil(path.length() / cut_pace));
  std::vector<double> fill;
  for (std::size_t i = 0; i <= pieces; ++i) {
    model.reach(path.at(path.length() * static_cast<double>(i) / static_cast<double>(pieces)));
    fill.push_back(model.volume());
  }
  return fill;
}

double cut_volume(const MachineModel& machine, const SurfaceProfile& surface, double bucket_width, const DigPath& path) {
  return fill_along(machine, surface, bucket_width, path).back();
}

}  // namespace berm::app
