#include "plant/world/movers.hpp"

#include <algorithm>
#include <cmath>

namespace berm::plant {

Movers::Movers(const std::vector<MoverConfig>& config) {
  for (const MoverConfig& c : config) mover_.push_back(made(c));
}

Movers::Mover Movers::made(const MoverConfig& c) {
  Mover m;
  m.config = c;
  m.pose.name = c.name;
  m.pose.vehicle = c.vehicle;
  if (!c.waypoints.empty()) {
    m.x = m.pose.x = c.waypoints[0].x;
    m.y = m.pose.y = c.waypoints[0].y;
  }
  if (c.waypoints.size() > 1) m.pose.yaw = std::atan2(c.waypoints[1].y - m.pose.y, c.waypoints[1].x - m.pose.x);
  return m;
}

void Movers::send(size_t i, const MoverConfig& config, double t) {
  mover_[i] = made(config);
  mover_[i].config.appears_s = mover_[i].config.start_s = t;
}

void Movers::step(double t, double dt, double swing_angle, const Terrain& terrain, double base_x, double base_y) {
  for (Mover& m : mover_) {
    m.present = t >= m.config.appears_s;
    if (!m.started && t >= m.config.start_s) m.started = !m.config.start_swing_above || swing_angle > *m.config.start_swing_above;
    if (m.started) advance(m, std::min(dt, std::max(0.0, t - m.config.start_s)));
    m.pose.x = m.x + (m.config.beside_machine ? base_x : 0.0);
    m.pose.y = m.y + (m.config.beside_machine ? base_y : 0.0);
    m.pose.z = terrain.grid().surface(m.pose.x, m.pose.y);
  }
}

void Movers::advance(Mover& m, double dt) {
  const std::vector<WaypointConfig>& way = m.config.waypoints;
  // Several short legs may fit in one step; the last waypoint ends the walk.
  while (dt > 0 && m.at + 1 < way.size()) {
    const WaypointConfig& from = way[m.at];
    const WaypointConfig& to = way[m.at + 1];
    // The wait of the first waypoint is what start_s and the trigger say; it comes on top if it is given.
    const double wait = std::min(dt, std::max(0.0, from.wait_s - m.waited));
    m.waited += wait;
    dt -= wait;
    if (dt <= 0 || m.config.speed <= 0) return;
    const double leg = std::hypot(to.x - from.x, to.y - from.y);
    const double walk = std::min(m.config.speed * dt, leg - m.walked);
    m.walked += walk;
    dt -= walk / m.config.speed;
    if (leg > 0) {
      m.pose.yaw = std::atan2(to.y - from.y, to.x - from.x);
      m.x = from.x + (to.x - from.x) * m.walked / leg;
      m.y = from.y + (to.y - from.y) * m.walked / leg;
    }
    if (m.walked >= leg - 1e-12) {
      m.x = to.x;
      m.y = to.y;
      ++m.at;
      m.walked = m.waited = 0;
    }
  }
}

}  // namespace berm::plant
