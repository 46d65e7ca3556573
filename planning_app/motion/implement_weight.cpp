#include "motion/implement_weight.hpp"

#include <cmath>

namespace berm::app {

namespace {

constexpr double memory_s = 120.0;       // of time with an empty bucket
constexpr double least_s = 2.0;          // of it, before anything is known
constexpr double most_variance = 4.0;    // of a prediction, per that of one second's mean

std::array<double, 3> elevations(const Joints& q) { return {q[boom], q[boom] + q[stick], q[boom] + q[stick] + q[bucket]}; }

}  // namespace

Moments holding_moments(const MachineModel& machine, const CylinderPressures& pressure) {
  Moments moment{};
  for (std::size_t c = 0; c < moment.size(); ++c) {
    const double extending = pressure[c].bottom_kpa * machine.cylinder[c].bottom - pressure[c].rod_kpa * machine.cylinder[c].rod;
    moment[c] = c == 0 ? extending : -extending;  // the boom's cylinder raises; stick's and bucket's crowd
  }
  return moment;
}

void ImplementWeight::learn(const Joints& angle, const Moments& held, double dt) {
  const auto elevation = elevations(angle);
  const double keep = std::exp(-dt / memory_s);
  for (std::size_t i = 0; i < link_.size(); ++i) {
    Link& l = link_[i];
    const double own = held[i] - (i + 1 < held.size() ? held[i + 1] : 0.0), c = std::cos(elevation[i]), s = std::sin(elevation[i]);
    l = {keep * l.cc + c * c * dt, keep * l.cs + c * s * dt, keep * l.ss + s * s * dt, keep * l.cm + c * own * dt, keep * l.sm + s * own * dt, keep * l.seconds + dt};
  }
}

bool ImplementWeight::known(const Joints& angle) const {
  const auto elevation = elevations(angle);
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const Link& l = link_[i];
    const double c = std::cos(elevation[i]), s = std::sin(elevation[i]), determinant = l.cc * l.ss - l.cs * l.cs;
    if (l.seconds < least_s || determinant <= 0.0 || (c * c * l.ss - 2.0 * c * s * l.cs + s * s * l.cc) > most_variance * determinant) return false;
  }
  return true;
}

Moments ImplementWeight::of(const Joints& angle) const {
  const auto elevation = elevations(angle);
  Moments moment{};
  double outward = 0.0;
  for (std::size_t i = link_.size(); i-- > 0;) {
    const Link& l = link_[i];
    const double determinant = l.cc * l.ss - l.cs * l.cs;
    const double cosine = (l.cm * l.ss - l.sm * l.cs) / determinant, sine = (l.sm * l.cc - l.cm * l.cs) / determinant;
    outward += cosine * std::cos(elevation[i]) + sine * std::sin(elevation[i]);
    moment[i] = outward;
  }
  return moment;
}

}  // namespace berm::app
