// Runs one intrusion: the kernel's cycle and the plant in one process, a machine that swings between dig and truck, a quiet time in which the kernel
// learns the ground, then somebody who comes. The plant's truth judges. WATCH.md has the definitions.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "watch/bench.hpp"
#include "watch/intruder_watch.hpp"
#include "watch/intrusion.hpp"

namespace berm::watch {

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

// Trials whose numbers divided by this are the same share a preparation, if their monitors run the same version of MergeCell.
constexpr int trials_of_a_preparation = 40;
constexpr int preparation_of(int run) { return run / trials_of_a_preparation; }

// The machine at work with nobody there, until the kernel has learned the ground, and some time after it.
class Preparation {
 public:
  // trace: takes a line of CSV a cycle, or null.
  Preparation(const Bench& bench, std::uint64_t seed, int number, bool follows, std::string* trace);
  ~Preparation();

  // Goes on until it is to appear. False: the ground is not learned when it should be, or there was an alarm; nothing is to be had of this.
  bool wait(const Intrusion& intrusion);
  // Waits for who comes, and sends it on its way; once, and nothing after it.
  IntrusionResult play(const Intrusion& intrusion);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

// The preparation and the trial alone. trace: a CSV of it; empty for none.
IntrusionResult run_intrusion(const Bench& bench, const Intrusion& intrusion, const std::string& trace);

}  // namespace berm::watch
