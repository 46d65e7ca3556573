// Runs one intrusion: the kernel's cycle and the plant in one process, a machine that swings between dig and truck, a quiet time in which the kernel
// learns the ground, then somebody who comes. The plant's truth judges. WATCH.md has the definitions.
#pragma once

#include <optional>
#include <string>

#include "config/machine_file.hpp"
#include "config/site_file.hpp"
#include "plant/machine/plant_profile.hpp"
#include "plant/process/world_config.hpp"
#include "watch/intruder_watch.hpp"
#include "watch/intrusion.hpp"
#include "watch/loading_motion.hpp"

namespace berm::watch {

struct Bench {
  config::MachineFile machine;           // its workspace watched
  config::SiteFile site;
  plant::PlantProfile profile;
  plant::WorldConfig world;              // of the bench scenario: terrain, soil, a parked truck, the scanners with their noise
  LoadingPlace place;
  IntrusionSite intrusion_site;
};

// machine: name or file. histogram: the kernel compares with histograms, whatever the machine says. profiles: folder of the plant's profiles, where NAME_plant.toml goes with the machine NAME.
Bench make_bench(const std::string& machine, bool histogram, const std::string& profiles);

enum class Outcome {
  detected,        // the kernel stopped for it
  stopped,         // the kernel stopped after it had entered, for something else
  brief,           // less than a second in the region, and no stop
  undetected,
  false_alarm,     // an intruder stop before anybody had appeared: the trial ends
  not_judged       // the machine was not at work when it entered, or the learning time was not over
};
const char* name_of(Outcome outcome);

struct IntrusionResult {
  Intrusion intrusion;
  Outcome outcome = Outcome::not_judged;
  IntruderRecord record;
  std::vector<Alarm> alarms;
  int false_alarms = 0;                  // before it came and after
  std::optional<double> appeared_s;
  std::optional<double> seen_s;          // the first return that it sent back from a watched cell
  std::optional<double> contact_s;       // an implement touched it while the machine moved
  std::optional<double> unsafe_s;        // it stood in what the implements could still sweep, while the machine moved
  std::optional<double> truck_distance_m;  // from its surface to the truck at detection
  double closest_m = 1e9;                // of the moving implements
  double ended_s = 0.0;
  bool failed() const { return contact_s || unsafe_s || outcome == Outcome::undetected; }
};

// trace: a CSV of the trial; empty for none.
IntrusionResult run_intrusion(const Bench& bench, const Intrusion& intrusion, const std::string& trace);

}  // namespace berm::watch
