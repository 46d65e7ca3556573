#include "plant/world/landing.hpp"

#include <algorithm>
#include <cmath>

namespace berm::plant {
namespace {
constexpr double aside = 0.1;  // how far from a truck's side soil lands that slid off it, m
}

Landing::Landing(Terrain& terrain, std::vector<Truck>& trucks, const std::vector<DigZoneConfig>& zones) : terrain_(terrain), truck_(trucks), zone_(zones) {}

bool Landing::in_dig_zone(double x, double y) const {
  return std::any_of(zone_.begin(), zone_.end(),
                     [&](const DigZoneConfig& z) { return x >= z.x_low && x <= z.x_high && y >= z.y_low && y <= z.y_high; });
}

void Landing::on_ground(double x, double y, double loose_volume, SoilBook& book) {
  terrain_.deposit(terrain_.grid().index_x(x), terrain_.grid().index_y(y), loose_volume);
  if (in_dig_zone(x, y)) book.dug -= loose_volume;
  else book.spilled += loose_volume;
}

void Landing::drop(double x, double y, double loose_volume, SoilBook& book) {
  if (loose_volume <= 0) return;
  for (Truck& truck : truck_) {
    if (!truck.present()) continue;
    Vec3 p = truck.frame().in(Vec3{x, y, 0});
    if (!truck.over_truck(p)) continue;
    if (truck.over_bed(p)) return truck.heap().deposit(p.x, p.y, loose_volume);
    // On a wall's inner half it slides in, from everywhere else on the truck it slides off the nearer long side.
    const TruckPart& front = truck.parts()[0];
    const double wall = front.high.x - front.low.x;
    const Vec3 inward{std::clamp(p.x, -front.low.x, front.low.x), std::clamp(p.y, front.low.y + wall, front.high.y - wall), 0};
    if (std::hypot(p.x - inward.x, p.y - inward.y) < wall / 2) return truck.heap().deposit(inward.x, inward.y, loose_volume);
    p.y = p.y >= 0 ? truck.hull().high.y + aside : truck.hull().low.y - aside;
    const Vec3 off = truck.frame().out(p);
    return on_ground(off.x, off.y, loose_volume, book);
  }
  on_ground(x, y, loose_volume, book);
}

void Landing::overflow(const Truck& truck, const Overflow& over, SoilBook& book) {
  const Vec3 p = truck.frame().out({over.x, over.y, 0});
  on_ground(p.x, p.y, over.loose_volume, book);
}

}  // namespace berm::plant
