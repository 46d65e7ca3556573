#include "plant/process/trace_writer.hpp"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

namespace berm::plant {

namespace {

// No minus sign before zero: a value that rounds to it has no side.
void put(std::string& out, double x) {
  const std::size_t begin = out.size();
  fmt::format_to(std::back_inserter(out), "{:.6f}", x);
  if (out[begin] == '-' && out.find_first_not_of("-0.", begin) == std::string::npos) out.erase(begin, 1);
}

}  // namespace

TraceWriter::TraceWriter(const std::string& path, const std::vector<MoverPose>& movers, bool trams) : file_(path), movers_(movers.size()), trams_(trams) {
  std::size_t trucks = 0;
  for (const MoverPose& m : movers) traced_.push_back(!m.name.starts_with("truck") || ++trucks <= most_trucks);
  std::string header =
      "time_s,swing_rad,boom_rad,stick_rad,bucket_rad,swing_rad_s,boom_rad_s,stick_rad_s,bucket_rad_s,"
      "stop_state,stop_reason,payload_kg,in_trucks_kg,spilled_kg,clearance_m";
  if (trams_) header += ",base_x,base_y";
  for (std::size_t i = 0; i < movers.size(); ++i)
    if (const MoverPose& m = movers[i]; traced_[i]) header += fmt::format(",{0}_x_m,{0}_y_m,{0}_z_m,{0}_yaw_rad", m.name);
  file_.write(header + "\n");
}

void TraceWriter::row(double t, const JointState& joints, const berm_heartbeat& heartbeat, const SoilMasses& soil, double clearance_m,
                      const std::vector<MoverPose>& movers, const BasePose& base) {
  if (movers.size() != movers_) throw std::runtime_error("trace: the number of movers changed");
  std::string line;
  put(line, t);
  for (const double x : joints.angle) put(line += ',', x);
  for (const double x : joints.velocity) put(line += ',', x);
  line += fmt::format(",{},{}", heartbeat.kernel_state, heartbeat.stop_reason);
  for (const double kg : {soil.bucket, soil.in_trucks, soil.spilled}) put(line += ',', kg);
  put(line += ',', clearance_m);
  if (trams_)
    for (const double x : {base.x, base.y}) put(line += ',', x);
  for (std::size_t i = 0; i < movers.size(); ++i) {
    if (!traced_[i]) continue;
    const MoverPose& m = movers[i];
    for (const double x : {m.x, m.y, m.z, m.yaw}) put(line += ',', x);
  }
  file_.write(line += '\n');
}

}  // namespace berm::plant
