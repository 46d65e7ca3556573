// Stands in for the app: swings from pose to pose as the simplified planner of leger-1998 section 2.5 did. Knows the machine file and what the
// kernel publishes, nothing of the obstacle. Looks round with both scanners first; then the leading scanner stays ahead of the swing.
#pragma once

#include <array>

#include "config/machine_file.hpp"
#include "contract/berm_contract.h"
#include "in_process/joint_driver.hpp"
#include "validate/trial.hpp"

namespace berm::validate {

class Commander {
 public:
  // looks_first: a survey before the swing.
  Commander(const config::MachineFile& machine, const Trial& trial, double reach_m, bool looks_first);

  // The request that answers a published state.
  berm_request answer(const berm_state& state);

  bool swinging() const { return swinging_; }                 // the survey is over
  bool arrived(const berm_state& state) const;                 // at the target and at rest

 private:
  void pans(const berm_state& state, berm_request& request);

  const config::MachineFile& machine_;
  Trial trial_;
  in_process::JointDriver driver_;
  std::array<bool, 2> low_seen_{}, high_seen_{}, up_{{true, true}};
  bool swinging_ = false;
  std::uint32_t sequence_ = 0;
};

}  // namespace berm::validate
