// What a sweep found: the flat JSON for scripts, the text for people, a picture of obstacles by outcome.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validate/trial_run.hpp"

namespace berm::validate {

struct Sweep {
  std::uint64_t seed = 1;
  std::string machine;  // as it was asked for
  int asked = 0;            // runs; fewer are over when it is interrupted
  std::vector<TrialResult> results;
  double wall_seconds = 0.0;
};

nlohmann::ordered_json flat_json(const Sweep& sweep);
std::string summary_text(const Sweep& sweep);
// The site from above: each obstacle where it stood, by outcome.
void write_picture(const std::string& path, const Sweep& sweep);

}  // namespace berm::validate
