// Joint models identified from step responses, as a machine file's [response] has them (CONFIG.md), in SI units and radians. For the app alone.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace berm::config {

class StrictTable;

// One joint in one direction.
struct StepResponseFile {
  double dead_time, lag, stop_lag;                     // s
  double gain;
  std::array<std::vector<double>, 2> speeding, slowing;  // rad/s2, [empty, heaviest payload][reach]; one for all reaches but for the swing
};

struct ResponseFile {
  std::string provenance;
  double payload;                                      // the heaviest, kg
  std::vector<double> reach;                           // m, ascending
  std::array<std::array<StepResponseFile, 2>, 4> joint;  // [swing, boom, stick, bucket][up, down]
};

extern const std::array<const char*, 2> kDirectionNames;

// Throws ConfigError.
ResponseFile read_response(StrictTable table, const std::array<const char*, 4>& joint_names);

}  // namespace berm::config
