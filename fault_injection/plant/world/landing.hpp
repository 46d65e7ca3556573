// Where loose soil that falls comes to lie, and the book of what was dug and spilled.
#pragma once

#include <vector>

#include "plant/process/world_config.hpp"
#include "plant/world/terrain.hpp"
#include "plant/world/truck.hpp"

namespace berm::plant {

// Loose volumes, m3. dug = in the bucket + in the trucks (gone ones too) + spilled, at any time.
struct SoilBook {
  double dug = 0;      // came into the bucket, less what fell back into a dig zone
  double spilled = 0;  // lies on the ground outside the dig zones (or on a truck's outside, from where it falls to the ground)
};

class Landing {
 public:
  Landing(Terrain& terrain, std::vector<Truck>& trucks, const std::vector<DigZoneConfig>& zones);

  // Soil from the bucket falls straight down at (x, y).
  void drop(double x, double y, double loose_volume, SoilBook& book);
  // Soil that was in a truck's bed runs over its wall.
  void overflow(const Truck& truck, const Overflow& over, SoilBook& book);
  [[nodiscard]] bool in_dig_zone(double x, double y) const;

 private:
  void on_ground(double x, double y, double loose_volume, SoilBook& book);

  Terrain& terrain_;
  std::vector<Truck>& truck_;
  const std::vector<DigZoneConfig>& zone_;
};

}  // namespace berm::plant
