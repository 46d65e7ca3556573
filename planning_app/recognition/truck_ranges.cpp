#include "recognition/truck_ranges.hpp"

#include <algorithm>

#include "config/strict_table.hpp"

namespace berm::app {
namespace {

TruckRanges read_class(config::StrictTable& table) {
  TruckRanges c;
  c.name = table.text("name");
  c.half_round = table.choice("bed", {"box", "half_round"}) == "half_round";
  c.inside_length = table.interval("inside_length", 3.0, 9.0, 0.0);
  c.inside_width = table.interval("inside_width", 1.8, 3.5, 0.0);
  c.wall_height = table.interval("wall_height", 0.6, 2.5, 0.0);
  c.wall_thickness = table.interval("wall_thickness", 0.03, 0.3, 0.0);
  c.top_over_ground = table.interval("top_over_ground", 1.0, 5.0, 0.0);
  c.open_rear = table.flag("open_rear");
  table.finish();
  return c;
}

}  // namespace

SizeRange TruckRangeSet::hull(SizeRange TruckRanges::*size) const {
  SizeRange out = classes.front().*size;
  for (const TruckRanges& c : classes) out = {std::min(out[0], (c.*size)[0]), std::max(out[1], (c.*size)[1])};
  return out;
}

const TruckRanges* TruckRangeSet::find(double length, double width, bool open_rear) const {
  const auto within = [&](double x, const SizeRange& range) { return x >= range[0] - slack && x <= range[1] + slack; };
  const auto found = std::find_if(classes.begin(), classes.end(), [&](const TruckRanges& c) {
    return within(length, c.inside_length) && within(width, c.inside_width) && (c.open_rear || !open_rear);
  });
  return found == classes.end() ? nullptr : &*found;
}

TruckRangeSet read_truck_ranges(const std::string& file) {
  config::StrictTable root = config::StrictTable::parse_file(file);
  root.integer("schema", 1, 1);
  TruckRangeSet set;
  set.slack = root.number("slack", 0.0, 0.25);
  for (config::StrictTable& table : root.tables("class")) {
    set.classes.push_back(read_class(table));
    for (std::size_t i = 0; i + 1 < set.classes.size(); ++i)
      if (set.classes[i].name == set.classes.back().name) table.fail("name", "'" + set.classes.back().name + "' stands twice");
  }
  if (set.classes.empty()) root.fail("class", "there must be at least one");
  root.finish();
  return set;
}

}  // namespace berm::app
