// Runs one trial twice, with the kernel and with nothing between commander and machine (the nominal motion), and judges both by the oracle.
#pragma once

#include <string>

#include "config/machine_file.hpp"
#include "config/parameter_block.h"
#include "plant/machine/plant_profile.hpp"
#include "validate/trial.hpp"

namespace berm::validate {

struct Bench {
  config::MachineFile machine;
  berm_parameters parameters;   // without a dig zone: nothing may be touched
  plant::PlantProfile profile;
};

// Of one motion, from the start of the swing.
struct Motion {
  bool began = false, arrived = false, contact = false;
  bool stopped = false;               // the kernel left RUN
  int stop_reason = 0;                // BERM_STOP_*, the first
  bool governed = false;              // a command went out smaller than it was asked for
  double seconds = 0.0;               // to the arrival, or to the end
  double closest_m = 0.0;             // to the obstacle, by the oracle
  double ground_gap_m = 0.0;
  std::string touched;
};

enum class Outcome { right, miss, needless_stop };

struct TrialResult {
  Trial trial;
  Motion kernel, nominal;
  Outcome outcome = Outcome::right;
  std::string why;                    // for all but right
  // A needless stop, by the definition, of a motion that keeps no more than the margin and 0.25 m from space that the obstacle hid from
  // the scanners until shortly before: one that the paper wants.
  bool past_hidden = false;
  double time_lost_s = 0.0;           // both arrived: kernel's less nominal seconds
};

// trace: path of a CSV with the kernel's motion; empty for none.
TrialResult run_trial(const Bench& bench, const Trial& trial, const std::string& trace);

}  // namespace berm::validate
