// Classes of trucks that may be recognised: the ranges of their sizes (stentz-1999, section 4.1: parameter ranges instead of single values).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace berm::app {

using SizeRange = std::array<double, 2>;  // low, high; metres

struct TruckRanges {
  std::string name;
  SizeRange inside_length{}, inside_width{}, wall_height{}, wall_thickness{};
  SizeRange top_over_ground{};  // of the walls' tops over the ground that the truck stands on
  bool half_round = false;      // the bed is a half pipe below straight sides
  bool open_rear = false;       // the tailgate may be missing or hang down
  bool canopy = false;          // a sheet from the front wall's top over the cab
  SizeRange canopy_length{}, canopy_rise{};  // where it has one: over the cab, and how much its front is higher than the walls
};

// What a bed's width and the thickness of its walls may be, over all classes.
struct BedSizes {
  SizeRange width{}, thickness{};
};

// What a sweep shows of a bed before its height: the sizes that tell which classes it may be of. Metres.
struct SeenBed {
  double length = 0.0, width = 0.0, thickness = 0.0;
  bool open_rear = false;
  double length_open = 0.0;  // so much shorter or longer it may be
};

struct TruckRangeSet {
  std::vector<TruckRanges> classes;
  double slack = 0.0;  // m, for the errors of one sweep

  // From the least low end to the greatest high end of all classes.
  [[nodiscard]] SizeRange hull(SizeRange TruckRanges::*size) const;
  // The same of those that have a canopy; nothing where none has.
  [[nodiscard]] std::optional<SizeRange> canopy_hull(SizeRange TruckRanges::*size) const;
  [[nodiscard]] BedSizes bed_sizes() const { return {hull(&TruckRanges::inside_width), hull(&TruckRanges::wall_thickness)}; }
  // Those that take in every size and the kind of rear, within slack, in the file's order.
  [[nodiscard]] TruckRangeSet taking_in(const SeenBed& bed) const;
};

// How far outside of a range a size is; 0 within.
double outside_by(double size, const SizeRange& range);

// Reads interface_spec/config/truck_classes.toml or a file like it. Throws config::ConfigError, one line with file, field and limit.
TruckRangeSet read_truck_ranges(const std::string& file);

}  // namespace berm::app
