// The kernel's machine file, read with toml11 directly: the tests hold the plant's true values against it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <toml.hpp>
#include <vector>

#include "plant/machine/kinematics.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/machine/strict_table.hpp"

namespace berm::plant::testing {

inline constexpr std::array<const char*, 4> kJoints{"swing", "boom", "stick", "bucket"};

inline double as_number(const toml::value& v) { return v.is_integer() ? static_cast<double>(v.as_integer()) : v.as_floating(); }

struct MachineFile {
  toml::value root = toml::parse(std::string(BERM_MACHINE_FILE));
  std::vector<double> reach_m;
  std::array<std::vector<std::vector<double>>, 4> angle_rad, time_s;  // [joint][row][column]
  std::array<double, 4> velocity_max{}, acceleration{}, low{}, high{}, angle_error{}, velocity_error{};
  std::vector<SolidPart> parts;

  MachineFile() {
    for (const auto& v : root.at("braking").at("reach_m").as_array()) reach_m.push_back(as_number(v));
    for (std::size_t j = 0; j < 4; ++j) {
      read_table(root.at("braking").at(kJoints[j]).at("angle_deg"), radians(1.0), angle_rad[j]);
      read_table(root.at("braking").at(kJoints[j]).at("time_s"), 1.0, time_s[j]);
      const auto& joint = root.at("joint").at(kJoints[j]);
      velocity_max[j] = radians(as_number(joint.at("velocity_max_deg_s")));
      acceleration[j] = as_number(joint.at("acceleration_max_rad_s2"));
      low[j] = radians(as_number(joint.at("range_deg").as_array()[0]));
      high[j] = radians(as_number(joint.at("range_deg").as_array()[1]));
      angle_error[j] = radians(as_number(joint.at("angle_error_deg")));
      velocity_error[j] = radians(as_number(joint.at("velocity_error_deg_s")));
    }
    for (const auto& p : root.at("part").as_array()) {
      SolidPart part;
      const std::string link = p.at("link").as_string().str;
      part.link = link == "boom" ? 1 : link == "stick" ? 2 : 3;
      part.half_width = as_number(p.at("half_width"));
      for (const auto& v : p.at("outline").as_array()) part.outline.push_back({as_number(v.as_array()[0]), as_number(v.as_array()[1])});
      parts.push_back(part);
    }
  }

  // The row the kernel takes: the first that covers the reach of its own prisms; the table's size when none does.
  std::size_t row(const ImplementShape& shape, const JointState& joints) const {
    ImplementShape own = shape;
    own.parts = parts;
    const double r = reach(own, joints);
    return static_cast<std::size_t>(std::lower_bound(reach_m.begin(), reach_m.end(), r) - reach_m.begin());
  }

 private:
  static void read_table(const toml::value& rows, double unit, std::vector<std::vector<double>>& out) {
    for (const auto& row : rows.as_array()) {
      out.emplace_back();
      for (const auto& v : row.as_array()) out.back().push_back(as_number(v) * unit);
    }
  }
};

inline PlantProfile profile() { return load_plant_profile(BERM_PLANT_PROFILE); }

inline JointState pose(double swing_deg, double boom_deg, double stick_deg, double bucket_deg) {
  JointState s;
  s.angle = {radians(swing_deg), radians(boom_deg), radians(stick_deg), radians(bucket_deg)};
  return s;
}

}  // namespace berm::plant::testing
