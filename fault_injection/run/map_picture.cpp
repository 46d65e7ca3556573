#include "run/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "contract/berm_contract.h"

namespace berm::run {

namespace {

std::string cell_style(const MapSnapshot& map, std::size_t i, HeightRange range) {
  switch (map.status[i]) {
    case BERM_CELL_OBSERVED: return fmt::format("fill:{}", height_colour(map.height_mm[i] * 1e-3, range.low_m, range.high_m));
    case BERM_CELL_STALE: return fmt::format("fill:{};fill-opacity:0.45", height_colour(map.height_mm[i] * 1e-3, range.low_m, range.high_m));
    case BERM_CELL_OWN_BODY: return "fill:#333333";
    default: return "fill:#d4d4d8";
  }
}

}  // namespace

HeightRange height_range(const MapSnapshot& map) {
  std::vector<std::int32_t> heights;
  for (std::size_t i = 0; i < map.status.size(); ++i)
    if (map.status[i] == BERM_CELL_OBSERVED || map.status[i] == BERM_CELL_STALE) heights.push_back(map.height_mm[i]);
  if (heights.empty()) return {0.0, 1.0};
  std::sort(heights.begin(), heights.end());
  const double low = heights[heights.size() / 50] * 1e-3;
  const double high = heights[heights.size() - 1 - heights.size() / 50] * 1e-3;
  return {low, std::max(high, low + 1.0)};
}

void draw_map(SvgPanel& panel, const MapSnapshot& map, HeightRange range) {
  // Runs of cells of one style in a row become one rectangle.
  for (int iy = 0; iy < BERM_MAP_CELLS; ++iy) {
    for (int ix = 0; ix < BERM_MAP_CELLS;) {
      const std::string style = cell_style(map, static_cast<std::size_t>(iy * BERM_MAP_CELLS + ix), range);
      int end = ix + 1;
      while (end < BERM_MAP_CELLS && cell_style(map, static_cast<std::size_t>(iy * BERM_MAP_CELLS + end), range) == style) ++end;
      panel.rectangle(map.origin_m + ix * map.cell_m, map.origin_m + iy * map.cell_m, (end - ix) * map.cell_m, map.cell_m, style + ";shape-rendering:crispEdges");
      ix = end;
    }
  }
}

std::string colour_bar(double left, double top, double width, HeightRange range) {
  std::string text;
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    const double height = range.low_m + (range.high_m - range.low_m) * (i + 0.5) / kSteps;
    text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\" fill=\"{}\"/>\n", left + width * i / kSteps, top, width / kSteps + 0.5,
                        height_colour(height, range.low_m, range.high_m));
  }
  text += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font:11px sans-serif\">{:.1f} m</text><text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font:11px sans-serif;text-anchor:end\">{:.1f} m</text>\n"
      "<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font:11px sans-serif;text-anchor:middle\">height (grey: never observed, pale: stale, dark: own body)</text>\n",
      left, top + 22, range.low_m, left + width, top + 22, range.high_m, left + width / 2, top + 22);
  return text;
}

}  // namespace berm::run
