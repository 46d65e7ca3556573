#include "recognition/truck_ranges.hpp"

#include <algorithm>
#include <iterator>

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
  c.canopy = table.has("canopy_length") || table.has("canopy_rise");
  if (c.canopy) {
    c.canopy_length = table.interval("canopy_length", 0.3, 3.0, 0.0);
    c.canopy_rise = table.interval("canopy_rise", 0.0, 1.0, 0.0);
  }
  table.finish();
  return c;
}

}  // namespace

SizeRange TruckRangeSet::hull(SizeRange TruckRanges::*size) const {
  SizeRange out = classes.front().*size;
  for (const TruckRanges& c : classes) out = {std::min(out[0], (c.*size)[0]), std::max(out[1], (c.*size)[1])};
  return out;
}

std::optional<SizeRange> TruckRangeSet::canopy_hull(SizeRange TruckRanges::*size) const {
  std::optional<SizeRange> out;
  for (const TruckRanges& c : classes)
    if (c.canopy) out = {out ? std::min((*out)[0], (c.*size)[0]) : (c.*size)[0], out ? std::max((*out)[1], (c.*size)[1]) : (c.*size)[1]};
  return out;
}

double outside_by(double size, const SizeRange& range) { return std::max({0.0, range[0] - size, size - range[1]}); }

TruckRangeSet TruckRangeSet::taking_in(const SeenBed& bed) const {
  TruckRangeSet out;
  out.slack = slack;
  std::copy_if(classes.begin(), classes.end(), std::back_inserter(out.classes), [&](const TruckRanges& c) {
    return outside_by(bed.length, c.inside_length) <= slack + bed.length_open && outside_by(bed.width, c.inside_width) <= slack &&
           outside_by(bed.thickness, c.wall_thickness) <= slack && (c.open_rear || !bed.open_rear);
  });
  return out;
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
