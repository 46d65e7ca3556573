// trace.csv: one row a cycle of what was true. Columns: scenarios/FORMAT.md. Same run, same bytes.
#pragma once

#include <string>
#include <vector>

#include "can/berm_can.h"
#include "plant/process/output_file.hpp"
#include "plant/world/base_pose.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

class TraceWriter {
 public:
  // trams: with columns for where the base stands. Of the trucks of a long run the first most_trucks have columns.
  TraceWriter(const std::string& path, const std::vector<MoverPose>& movers, bool trams = false);
  void row(double t, const JointState& joints, const berm_heartbeat& heartbeat, const SoilMasses& soil, double clearance_m,
           const std::vector<MoverPose>& movers, const BasePose& base = {});
  void finish() { file_.finish(); }

 private:
  static constexpr std::size_t most_trucks = 16;
  OutputFile file_;
  std::size_t movers_;
  std::vector<bool> traced_;
  bool trams_;
};

}  // namespace berm::plant
