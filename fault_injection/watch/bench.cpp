#include "watch/bench.hpp"

#include <algorithm>
#include <cmath>

#include "plant/process/scenario.hpp"
#include "run/parameter_file.hpp"

namespace berm::watch {

Bench make_bench(const std::string& machine, bool histogram, const std::string& profiles) {
  Bench b;
  b.machine = config::load_machine_file(run::find_machine(machine));
  b.machine.workspace.watched = true;
  b.machine.workspace.histogram = b.machine.workspace.histogram || histogram;
  b.site = config::load_site_file(run::find_site("bench"));
  b.profile = plant::load_plant_profile(profiles + "/" + b.machine.name + "_plant.toml");
  b.world = plant::load_scenario(run::find_scenario("bench"), profiles).world;
  b.world.trucks.resize(1);
  plant::TruckConfig& truck = b.world.trucks.front();
  truck.place_stddev = truck.yaw_stddev = 0.0;  // the gap to its side is what was drawn
  truck.wait_s = 0.0;                           // it stands there from the start
  b.place = {0.5 * (b.site.dig.swing[0] + b.site.dig.swing[1]), std::atan2(truck.y, truck.x)};
  IntrusionSite& s = b.intrusion_site;
  s.truck = truck;
  s.extent = {std::min(-b.world.terrain.x_low, b.world.terrain.x_high), std::min(-b.world.terrain.y_low, b.world.terrain.y_high)};
  s.crest_x = b.world.terrain.crest_x;
  s.half_face = b.site.dig_zone.front().y_high;
  s.region_radius = b.machine.workspace.radius;
  s.implements_reach = farthest_tip(b.machine);
  s.own_radius = b.machine.own_body_radius;
  s.swing_low = std::min(b.place.dig_bearing, b.place.truck_bearing);
  s.swing_high = std::max(b.place.dig_bearing, b.place.truck_bearing);
  return b;
}

}  // namespace berm::watch
