// The plant's world and scanners, the kernel's intake and publisher, and a segment that the app reads: what a run publishes of scans, without its
// processes.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "config/machine_file.hpp"
#include "config/parameter_block.h"
#include "geometry/joint_history.hpp"
#include "io/publisher.hpp"
#include "io/scan_intake.hpp"
#include "motion/machine_model.hpp"
#include "plant/process/scenario.hpp"
#include "plant/world/base_pose.hpp"
#include "plant/world/world.hpp"

namespace berm::test {

// Angles at a time: joints, pans.
struct Stance {
  std::array<double, 4> joint{};
  std::array<double, 2> pan{};
};
using Motion = std::function<Stance(double time_s)>;

class ScanRig {
 public:
  ScanRig(const std::string& scenario, std::uint64_t seed, Motion motion, const plant::BasePose& base = {});

  // One cycle of 10 ms; the segment is as the kernel leaves it.
  void advance();

  const app::MachineModel& machine() const { return machine_; }
  const berm_state_segment& segment() const { return *segment_; }
  berm_state_segment& mutable_segment() { return *segment_; }
  const kernel::ScanBlocks& blocks() const { return *blocks_; }  // of the newest cycle
  double time_s() const { return static_cast<double>(cycle_) * 0.01; }

 private:
  config::MachineFile file_;
  berm_parameters parameters_;
  app::MachineModel machine_;
  Motion motion_;
  plant::Scenario scenario_;
  std::unique_ptr<plant::World> world_;
  kernel::ScanIntake intake_;
  kernel::JointHistory joints_;
  std::unique_ptr<sk_height_map> map_;
  std::unique_ptr<kernel::ScanBlocks> blocks_;
  std::unique_ptr<berm_state_segment> segment_;
  kernel::Publisher publisher_;
  std::uint64_t cycle_ = 0;
};

// Swings to and fro at up to its largest speed, implements raised, both pans sweeping; drawn from the seed.
Motion drawn_motion(std::uint64_t seed, const config::MachineFile& machine);

config::MachineFile zx200_file();

}  // namespace berm::test
