// Holds the joints against their models while the machine works: how well it is foretold, and which joint overruns and is limited for it.
#pragma once

#include <vector>

#include "app/observation.hpp"
#include "app/progress_log.hpp"
#include "motion/arm_controller.hpp"
#include "motion/overrun_limits.hpp"
#include "motion/prediction_error.hpp"

namespace berm::app {

class JointWatch {
public:
  // machine must outlive it.
  explicit JointWatch(const MachineModel& machine);

  struct Task {
    double payload_kg = 0.0;
    bool loaded = false;
    bool free = true;                 // no soil holds the joints up
    std::optional<Joints> goals;      // of a motion that lands
  };
  // Once a cycle.
  void step(const Observation& o, const Task& task, const ProgressLog& log);

  const LearnedPaces& paces(bool loaded) const { return limits_.paces(loaded); }
  int overruns() const { return overruns_; }
  Joints prediction_rms() const;      // rad, of half a second
  Joints prediction_largest() const;

private:
  const MachineModel* machine_;
  std::vector<PredictionError> error_;
  std::vector<BrakingWatch> braking_;
  std::array<bool, joints> loaded_{};  // when it began to slow down: the bucket may be emptied meanwhile
  OverrunLimits limits_;
  int overruns_ = 0;
};

}  // namespace berm::app
