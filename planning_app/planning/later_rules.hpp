// What of a pass may still be made to wait longer: the left-hand sides of rules that have not fired, for a motion that was foreseen to be blocked.
#pragma once

#include <vector>

#include "planning/pass_simulation.hpp"

namespace berm::app {

struct LaterRules {
  const char* what = "";                       // as the log has it
  double PassThresholds::*threshold = nullptr; // that differs; others with it, which must not come before
  PassThresholds thresholds{};
};

// Where in a pass something is.
enum class PassPart { to_truck, over_bed, to_dig, over_dig };
const char* name_of(PassPart part);
// over_dig: where the arm may have reached out over the dig. swing_angle: where the swing is with this script.
PassPart part_of(const Script& script, const PassTask& task, const PassThresholds& thresholds, double swing_angle);

// Candidates, those that cost the least time first, into out. running, angle: as they are now; blocked: where the block was foreseen; carry_boom: that the boom
// rises to before the swing must begin.
void later_rules(const Script& running, const PassTask& task, const PassThresholds& now, const Joints& angle, PassPart blocked, double carry_boom, std::vector<LaterRules>& out);

}  // namespace berm::app
