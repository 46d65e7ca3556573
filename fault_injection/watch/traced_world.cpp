#include "watch/traced_world.hpp"

#include <array>

#include "run/trace_reader.hpp"

namespace berm::watch {

plant::JointState joints_of(const run::TraceReader& trace) {
  constexpr std::array<const char*, 4> joint_names{"swing", "boom", "stick", "bucket"};
  plant::JointState state;
  for (std::size_t j = 0; j < joint_names.size(); ++j) {
    state.angle[j] = trace.value(std::string(joint_names[j]) + "_rad");
    state.velocity[j] = trace.value(std::string(joint_names[j]) + "_rad_s");
  }
  return state;
}

plant::MoverPose pose_of(const run::TraceReader& trace, const std::string& name) {
  return {name, trace.value(name + "_x_m"), trace.value(name + "_y_m"), trace.value(name + "_z_m"), trace.value(name + "_yaw_rad"), false};
}

}  // namespace berm::watch
