// A whole scenario as `berm load` runs it, with its workspace watched, and then judged from its trace, its journal and the replayed kernel.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "watch/intruder_watch.hpp"

namespace berm::watch {

struct ScenarioOptions {
  std::string scenario, machine, out, picture, profiles;
  bool histogram = false;
  std::uint64_t seed = 1;
  int trucks = 1;
  std::optional<double> max_time_s;
};

struct ScenarioResult {
  std::string scenario;
  std::uint64_t seed = 1;
  int contacts = 0;
  double simulated_seconds = 0.0;
  std::vector<IntruderRecord> intruders;
  std::vector<Alarm> alarms;
  int false_alarms = 0;
  // Nobody was touched, no alarm was false, and nobody was in the region for a second or more without a stop.
  bool held() const;
};

// Prints what the launcher prints; out and picture may be empty.
ScenarioResult watch_scenario(const ScenarioOptions& options);

nlohmann::ordered_json flat_json(const ScenarioResult& result);
std::string summary_text(const ScenarioResult& result);

}  // namespace berm::watch
