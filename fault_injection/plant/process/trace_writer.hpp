// trace.csv: one row a cycle of what was true. Columns: scenarios/FORMAT.md. Same run, same bytes.
#pragma once

#include <string>
#include <vector>

#include "can/berm_can.h"
#include "plant/process/output_file.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

class TraceWriter {
 public:
  TraceWriter(const std::string& path, const std::vector<MoverPose>& movers);
  void row(double t, const JointState& joints, const berm_heartbeat& heartbeat, double payload_kg, double clearance_m, const std::vector<MoverPose>& movers);
  void finish() { file_.finish(); }

 private:
  OutputFile file_;
  std::size_t movers_;
};

}  // namespace berm::plant
