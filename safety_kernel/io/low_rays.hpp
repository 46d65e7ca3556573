// Rays that pass where somebody stood, as low as the ground there: that he has left (SK-WM-72, 73, SK-FS-14). With histograms alone.
#pragma once

#include "io/monitor_watch.hpp"
#include "io/space_watch.hpp"

namespace berm::kernel {

// own: of the lidar whose ray passed from the head to near what it met. space: while it holds the machine, else null.
void pass_low(MonitorWatch& own, const MonitorWatch::Others& others, SpaceWatch* space, const sk_point& head, const sk_point& met, std::int64_t now_us);

}  // namespace berm::kernel
