// Keeps account of the time in which the kernel let out less than was asked. What it lets nothing of is a stop or a hold, not a slow-down.
#pragma once

#include "app/observation.hpp"
#include "app/progress_log.hpp"
#include "motion/arm_controller.hpp"

namespace berm::app {

class SlowDown {
public:
  // Once a cycle, after the arm controller has heard what the kernel let out. phase: what the machine is doing, for the log.
  void step(const Observation& o, const ArmController& arm, double cycle_s, const char* phase, const ProgressLog& log);

  double lasts_s() const { return open_ ? last_s_ - from_s_ : 0.0; }  // of the span that goes on; 0 when none does
  double seconds() const { return seconds_; }      // in all spans, from the first cut to the last
  int spans() const { return spans_; }             // a span ends when nothing was cut for a moment
  double least_share() const { return least_share_; }  // of the speed that the joint would have had uncut; 1 when nothing was

private:
  void end(const ProgressLog& log);

  double seconds_ = 0.0;
  int spans_ = 0;
  double least_share_ = 1.0;
  bool open_ = false;
  bool span_dust_ = false, span_learning_ = false;  // in it there was dust, or ground was learned, perhaps beside other causes
  double from_s_ = 0.0, last_s_ = 0.0, span_least_ = 1.0;
};

}  // namespace berm::app
