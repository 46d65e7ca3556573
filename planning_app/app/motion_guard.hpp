// Slows a request until the app's own preview of the reach box is clear of what the app has seen, so that the kernel need not stop it.
#pragma once

#include <optional>

#include "planning/skyline.hpp"

namespace berm::app {

// angle: when the request begins to act. Slows the swing first, then the arm. Where no slower motion is clear by the app's own, wider margins,
// everything creeps and the kernel decides; but beside what is too high to be passed over it stands, unless the request leads away, and whoever asks looks again.
Joints guarded(const MachineModel& machine, const Skyline& skyline, const Joints& angle, const Joints& command);

// Every joint at most at its creep speed.
Joints crept(const MachineModel& machine, const Joints& command);

// Whether what is allowed does not get where wanted leads. Within a degree of its goal, where there is one, a joint is there: a swing trembles at its goal
// while a bucket is weighed or poured.
bool cut_short(const Joints& angle, const Joints& wanted, const Joints& allowed, const std::optional<Joints>& goals);

}  // namespace berm::app
