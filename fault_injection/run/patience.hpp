// How long a run waits for its processes, on the wall clock.
#pragma once

namespace berm::run {

inline constexpr double kConnectPatience_s = 20.0;  // until one has started, or has checked its input
inline constexpr double kEndPatience_s = 10.0;      // until one that was asked to end has ended

}  // namespace berm::run
