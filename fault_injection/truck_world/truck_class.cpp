#include "truck_world/truck_class.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/strict_table.hpp"

namespace berm::truck_world {
namespace {

using config::StrictTable;

double level_volume(BedShape bed, double length, double width, double height) {
  const double lost = bed == BedShape::half_round ? (2.0 - std::numbers::pi / 2.0) * width * width / 4.0 : 0.0;  // the two lower corners
  return length * (width * height - lost);
}

TailgateShares read_tailgates(StrictTable gates) {
  const TailgateShares shares{gates.number("up", 0.0, 1.0), gates.number("down", 0.0, 1.0), gates.number("none", 0.0, 1.0)};
  gates.finish();
  const double sum = shares.up + shares.down + shares.none;
  if (std::abs(sum - 1.0) > 1e-6) gates.fail("up", fmt::format("up, down and none sum up to {}, not 1", sum));
  return shares;
}

TruckClass read_class(StrictTable& t) {
  TruckClass c;
  c.name = t.text("name");
  c.bed = t.choice("bed", {"box", "half_round"}) == "box" ? BedShape::box : BedShape::half_round;
  c.tracks = t.choice("undercarriage", {"wheels", "tracks"}) == "tracks";
  c.volume_m3 = t.interval("volume_m3", 5.0, 40.0, 0.0);
  c.inside_length = t.interval("inside_length", 3.0, 9.0, 0.0);
  c.inside_width = t.interval("inside_width", 1.8, 3.5, 0.0);
  c.wall_height = t.interval("wall_height", 0.6, 2.5, 0.0);
  c.wall_thickness = t.interval("wall_thickness", 0.03, 0.3, 0.0);
  c.floor_height = t.interval("floor_height", 0.8, 2.0, 0.0);
  c.wall_top = t.interval("wall_top", 1.5, 4.0, 0.0);
  c.tailgate = read_tailgates(t.table("tailgate"));
  c.canopy = t.flag("canopy");
  c.canopy_length = t.interval("canopy_length", 0.2, 2.5, 0.0);
  c.canopy_rise = t.interval("canopy_rise", 0.0, 1.0, 0.0);
  c.cab_gap = t.interval("cab_gap", 0.05, 2.0, 0.0);
  c.cab_length = t.interval("cab_length", 0.8, 3.0, 0.0);
  c.cab_top = t.interval("cab_top", 1.5, 4.0, 0.0);
  c.mud = t.interval("mud", 0.0, 0.1, 0.0);
  t.finish();

  if (c.bed == BedShape::half_round && c.wall_height[0] < c.inside_width[1] / 2)
    t.fail("wall_height", fmt::format("{} is below half the width {}, which a half-round bed needs", c.wall_height[0], c.inside_width[1]));
  const double least = level_volume(c.bed, c.inside_length[0], c.inside_width[0], c.wall_height[0]);
  const double most = level_volume(c.bed, c.inside_length[1], c.inside_width[1], c.wall_height[1]);
  if (least > c.volume_m3[1] || most < c.volume_m3[0])
    t.fail("volume_m3", fmt::format("no bed of these sizes has it: they hold {:.2f} to {:.2f}", least, most));
  if (c.floor_height[0] + c.wall_height[0] > c.wall_top[1] || c.floor_height[1] + c.wall_height[1] < c.wall_top[0])
    t.fail("wall_top", fmt::format("floor_height and wall_height give {:.2f} to {:.2f}", c.floor_height[0] + c.wall_height[0],
                                   c.floor_height[1] + c.wall_height[1]));
  return c;
}

}  // namespace

const char* name_of(Tailgate tailgate) {
  switch (tailgate) {
    case Tailgate::up: return "up";
    case Tailgate::down: return "down";
    case Tailgate::none: break;
  }
  return "none";
}

std::vector<TruckClass> read_truck_classes(const std::string& file) {
  StrictTable root = StrictTable::parse_file(file);
  root.integer("schema", 1, 1);
  std::vector<TruckClass> classes;
  for (StrictTable& table : root.tables("class")) {
    classes.push_back(read_class(table));
    for (std::size_t i = 0; i + 1 < classes.size(); ++i)
      if (classes[i].name == classes.back().name) table.fail("name", fmt::format("'{}' stands twice", classes.back().name));
  }
  if (classes.empty()) root.fail("class", "there must be at least one");
  root.finish();
  return classes;
}

bool outside_every_class(const std::vector<TruckClass>& classes, const OpenBox& box, double margin) {
  const auto outside = [margin](double x, const Range& range) { return x <= range[0] - margin || x >= range[1] + margin; };
  return std::all_of(classes.begin(), classes.end(), [&](const TruckClass& c) {
    return outside(box.length, c.inside_length) || outside(box.width, c.inside_width) || outside(box.height, c.wall_height);
  });
}

}  // namespace berm::truck_world
