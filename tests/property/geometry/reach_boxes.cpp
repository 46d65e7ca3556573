#include "reach_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "config/compile_parameters.hpp"
#include "geometry/reach.hpp"
#include "machine_profile.hpp"

namespace berm::kernel::test {

std::vector<CompiledMachine> compiled_machines() {
  const std::filesystem::path config = BERM_CONFIG_FILES;
  const auto site = config::load_site_file((config / "sites/bench.toml").string());
  std::vector<CompiledMachine> out;
  for (const Machine& machine : machine_profiles())
    out.push_back({machine.name, config::compile_parameters(config::load_machine_file((config / "machines" / (machine.name + ".toml")).string()), site)});
  return out;
}

BoundedBox box_of(const berm_parameters& p, const int32_t (&angle_urad)[4], const int32_t (&velocity_urad_s)[4], const int32_t (&command_urad_s)[4]) {
  BoundedBox out{-1, {}};
  const auto joints = [&](int first, int32_t row) {
    for (int j = first; j < SK_JOINTS; ++j)
      if (!sk_reach_joint(&p, j, row, angle_urad[j], velocity_urad_s[j], SK_REACH_COMMANDED, std::min(0, command_urad_s[j]), std::max(0, command_urad_s[j]), &out.box)) return false;
    return true;
  };
  if (!joints(1, BERM_BRAKE_REACHES - 1)) return out;
  const int32_t reach_mm = max_reach_mm(p, out.box);
  const int32_t row = reach_mm < 0 ? -1 : sk_brake_row(&p, reach_mm);
  if (row >= 0 && joints(0, row)) out.row = row;
  return out;
}

BoundedBox box_at_speed(const berm_parameters& p, double share, std::mt19937_64& random) {
  for (;;) {
    int32_t angle[4], velocity[4], command[4];
    for (int j = 0; j < 4; ++j) {
      const double most = share * p.velocity_max_urad_s[j];
      angle[j] = static_cast<int32_t>(uniform(random, p.joint_low_urad[j], p.joint_high_urad[j]));
      velocity[j] = static_cast<int32_t>(random() % 4 == 0 ? std::copysign(most, uniform(random, -1, 1)) : uniform(random, -most, most));
      command[j] = static_cast<int32_t>(random() % 4 == 0 ? std::copysign(most, uniform(random, -1, 1)) : uniform(random, -most, most));
    }
    const BoundedBox out = box_of(p, angle, velocity, command);
    if (out.row >= 0) return out;
  }
}

sk_reach_box box_of_any_width(const berm_parameters& p, std::mt19937_64& random) {
  sk_reach_box box{};
  for (int j = 0; j < 4; ++j) {
    const double range = static_cast<double>(p.joint_high_urad[j]) - p.joint_low_urad[j];
    const uint64_t kind = random() % 10;
    const double width = kind == 0 ? 0.0 : kind == 1 ? range : range * std::pow(10.0, uniform(random, -4.0, 0.0));
    const double low = uniform(random, p.joint_low_urad[j], p.joint_high_urad[j] - width);
    box.low_urad[j] = static_cast<int32_t>(low);
    box.high_urad[j] = static_cast<int32_t>(low + width);
  }
  return box;
}

} // namespace berm::kernel::test
