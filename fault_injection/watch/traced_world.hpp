// What a row of a run's trace says in the plant's terms.
#pragma once

#include <string>

#include "plant/world/world.hpp"

namespace berm::run {
class TraceReader;
}

namespace berm::watch {

plant::JointState joints_of(const run::TraceReader& trace);
// Of a person, vehicle or truck.
plant::MoverPose pose_of(const run::TraceReader& trace, const std::string& name);

}  // namespace berm::watch
