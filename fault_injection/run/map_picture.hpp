// The kernel's height map as cells of a panel.
#pragma once

#include "run/recorder.hpp"
#include "run/svg.hpp"

namespace berm::run {

struct HeightRange { double low_m, high_m; };

// 2nd and 98th percentile of the observed heights, at least 1 m apart; {0, 1} when nothing is observed.
HeightRange height_range(const MapSnapshot& map);
// Observed cells by height, stale ones hatched paler, unknown grey, the machine's own body dark.
void draw_map(SvgPanel& panel, const MapSnapshot& map, HeightRange range);
// A colour bar under a panel: SVG text to append.
std::string colour_bar(double left, double top, double width, HeightRange range);

}  // namespace berm::run
