// Stands in for the app in a trial: swings to and fro between dig and truck as a loading machine does, lowers, curls and raises the bucket at the
// ends, and pans the scanners by the app's own schedule. Knows the machine file and what the kernel publishes, nothing of anybody on the site.
#pragma once

#include <array>
#include <cstdint>

#include "config/machine_file.hpp"
#include "contract/berm_contract.h"
#include "in_process/joint_driver.hpp"
#include "perception/scan_scheduler.hpp"

namespace berm::watch {

struct LoadingPlace { double dig_bearing = 0.0, truck_bearing = 0.0; };  // rad, base frame

// The machine as it stands before its first request, rad.
std::array<double, 4> first_pose(const LoadingPlace& place);
// The farthest that the implements come from the swing axis at any of the motion's poses, m, by the pins and the bucket's tip.
double farthest_tip(const config::MachineFile& machine);

class LoadingMotion {
 public:
  LoadingMotion(const config::MachineFile& machine, const LoadingPlace& place);

  // The request that answers a published state.
  berm_request answer(const berm_state& state);
  // Both scanners have swept their whole range at the dig and at the truck, and a whole cycle of loading followed.
  bool learned() const { return cycles_ >= learning_cycles; }
  int cycles() const { return cycles_; }

 private:
  static constexpr int learning_cycles = 2;
  struct Leg;
  static const std::array<Leg, 6> legs;
  std::array<double, 4> goal() const;
  void go_on(const berm_state& state);

  const config::MachineFile& machine_;
  LoadingPlace place_;
  in_process::JointDriver driver_;
  app::ScanScheduler scheduler_;
  bool looking_ = true;         // before the first leg, and once at the truck: stands until both scanners have swept their whole range
  std::size_t leg_ = 0;
  double stood_s_ = 0.0;        // at the leg's end
  int cycles_ = 0;
  std::uint32_t sequence_ = 0;
};

}  // namespace berm::watch
