#include "identify/machine_shape.hpp"

#include <algorithm>
#include <cmath>

namespace berm::identify {

namespace {

struct Place { double r, z; };
struct Frame { Place pin; double angle; };

std::array<Frame, 3> frames(const config::MachineFile& m, const Joints& pose) {
  const std::array<double, 3> length{m.boom, m.stick, m.bucket};
  std::array<Frame, 3> out{};
  Place pin{m.boom_pin_x, m.boom_pin_z};
  double angle = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    angle += pose[i + 1];
    out[i] = {pin, angle};
    pin = {pin.r + length[i] * std::cos(angle), pin.z + length[i] * std::sin(angle)};
  }
  return out;
}

Place corner(const Frame& f, const std::array<double, 2>& p) {
  const double c = std::cos(f.angle), s = std::sin(f.angle);
  return {f.pin.r + p[0] * c - p[1] * s, f.pin.z + p[0] * s + p[1] * c};
}

template <class Visit>
void for_corners(const config::MachineFile& m, const Joints& pose, Visit visit) {
  const auto frame = frames(m, pose);
  for (const auto& part : m.part)
    for (const auto& point : part.outline) visit(part, corner(frame[static_cast<std::size_t>(part.link - 1)], point));
}

}  // namespace

double reach_m(const config::MachineFile& machine, const Joints& pose) {
  double largest = 0.0;
  for_corners(machine, pose, [&](const config::PartFile& part, const Place& at) { largest = std::max(largest, std::hypot(at.r, part.half_width)); });
  return largest;
}

double lowest_m(const config::MachineFile& machine, const Joints& pose) {
  double lowest = 1e9;
  for_corners(machine, pose, [&](const config::PartFile&, const Place& at) { lowest = std::min(lowest, at.z); });
  return lowest;
}

double middle_m(const config::MachineFile& machine, const Joints& pose, int link) {
  double sum = 0.0;
  int count = 0;
  for_corners(machine, pose, [&](const config::PartFile& part, const Place& at) {
    if (part.link != link) return;
    sum += at.r;
    ++count;
  });
  return count > 0 ? std::abs(sum / count) : 0.0;
}

}  // namespace berm::identify
