// What a person and a script read of many intrusions. WATCH.md lists the keys.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "watch/intrusion_run.hpp"

namespace berm::watch {

struct Campaign {
  std::string machine = "zx200";
  bool histogram = false;
  std::uint64_t seed = 1;
  When when = When::learned;
  int asked = 0;  // trials; fewer are over when it is ended early
  std::vector<IntrusionResult> results;
  double wall_seconds = 0.0;
};

// The command that repeats one.
std::string command_of(const Campaign& campaign, const IntrusionResult& result);
nlohmann::ordered_json flat_json(const Campaign& campaign);
std::string summary_text(const Campaign& campaign);
// One trial in detail.
std::string detail_text(const IntrusionResult& result);

}  // namespace berm::watch
