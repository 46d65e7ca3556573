// A scenario: the site, what moves on it, what the operator does, how the machine stands at the start. Format: scenarios/FORMAT.md.
#pragma once

#include <string>
#include <vector>

#include "plant/machine/machine_fault.hpp"
#include "plant/machine/state_frames.hpp"
#include "plant/process/base_motion.hpp"
#include "plant/process/operator.hpp"
#include "plant/process/world_config.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

enum class PanelAction { stop, reset, relearn, emergency, pause };  // pause: the run switch is off

struct PanelEvent { PanelAction action; double at_s, for_s; };

struct Scenario {
  std::string name;
  std::string machine_file;             // plant profile
  double max_time_s = 0.0;
  double run_from_s = 0.0;              // the operator's run switch is on from here; in a run, from when the kernel stands by, if that is later
  JointState start;
  std::vector<PanelEvent> panel;
  std::vector<MachineFault> machine_fault;
  std::vector<BaseMotionConfig> base_motions;
  std::optional<OperatorConfig> operator_config;  // none: nobody reacts to the horn
  WorldConfig world;
};

// profiles: folder in which a machine named without a path is looked up. Throws ConfigError ("FILE: field: reason").
Scenario load_scenario(const std::string& file, const std::string& profiles);

// The panel's keys at time t.
PanelInput panel_at(const Scenario& scenario, double t);

}  // namespace berm::plant
