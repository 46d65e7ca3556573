// People and vehicles that go straight from waypoint to waypoint, with waits, on the ground.
#pragma once

#include <vector>

#include "plant/process/world_config.hpp"
#include "plant/world/terrain.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

class Movers {
 public:
  explicit Movers(const std::vector<MoverConfig>& config);
  // From t - dt to t. swing_angle starts those that wait for it; those beside the machine go along with where it stands, base_x and base_y.
  void step(double t, double dt, double swing_angle, const Terrain& terrain, double base_x = 0.0, double base_y = 0.0);

  // Another takes the place of mover i: it appears at t, and sets out.
  void send(size_t i, const MoverConfig& config, double t);

  [[nodiscard]] size_t count() const { return mover_.size(); }
  [[nodiscard]] const MoverConfig& config(size_t i) const { return mover_[i].config; }
  [[nodiscard]] const MoverPose& pose(size_t i) const { return mover_[i].pose; }
  [[nodiscard]] bool present(size_t i) const { return mover_[i].present; }

 private:
  struct Mover {
    MoverConfig config;
    MoverPose pose;
    double x = 0, y = 0;  // among its waypoints
    bool present = false, started = false;
    size_t at = 0;        // the waypoint it stands at or comes from
    double waited = 0;    // at that waypoint
    double walked = 0;    // from that waypoint towards the next
  };
  static Mover made(const MoverConfig& config);
  static void advance(Mover& m, double dt);

  std::vector<Mover> mover_;
};

}  // namespace berm::plant
