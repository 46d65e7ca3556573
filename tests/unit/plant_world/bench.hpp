// The bench of the default site and a machine of the ZX200's shape, for tests of the world and of the oracle.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "plant/machine/implement_shape.hpp"
#include "plant/process/world_config.hpp"
#include "plant/world/world.hpp"

namespace berm::plant::bench {

constexpr double degree = std::numbers::pi / 180;

inline ImplementShape machine() {
  ImplementShape s;
  s.boom_pin_x = 0.2277;
  s.boom_pin_z = 1.957;
  s.boom = 5.648;
  s.stick = 2.889;
  s.bucket = 1.562;
  s.parts = {{1, 0.25, {{-0.20, -0.25}, {0.40, -0.25}, {2.95, 0.60}, {2.85, 1.20}, {2.20, 1.15}, {-0.20, 0.25}}},
             {1, 0.25, {{2.45, 0.42}, {5.58, -0.24}, {5.85, 0.00}, {5.68, 0.27}, {3.00, 1.19}, {2.45, 1.17}}},
             {2, 0.25, {{-0.65, 0.15}, {-0.28, -0.20}, {2.88, -0.20}, {3.00, 0.00}, {2.88, 0.20}, {0.30, 0.50}, {-0.45, 0.45}}},
             {3, 0.563, {{-0.10, -0.08}, {0.35, -0.10}, {1.562, 0.00}, {1.40, 0.40}, {0.90, 0.78}, {0.28, 0.74}, {-0.10, 0.20}}}};
  s.bucket_half_width = 0.563;
  s.bucket_heaped_m3 = 1.2;
  s.bucket_payload_max_kg = 1800;
  s.upper_body = {{{-2.60, -1.30, 1.00}, {1.20, 1.30, 2.95}}};
  s.tracks = {{{-2.10, 0.80, 0.00}, {2.10, 1.40, 1.00}}, {{-2.10, -1.40, 0.00}, {2.10, -0.80, 1.00}}};
  s.scanner[0] = {{1.30, 1.35, 3.30}, -20 * degree, 130 * degree, 2.1, 20};
  s.scanner[1] = {{1.30, -1.35, 3.30}, -130 * degree, 20 * degree, 2.1, 20};
  return s;
}

inline TruckConfig truck() {
  TruckConfig t;
  t.x = -0.70;
  t.y = 6.75;
  t.yaw = std::numbers::pi;  // the cab away from the dig face
  t.length = 4.88;
  t.width = 2.44;
  t.height = 1.22;
  t.wall_top = 0.30;
  t.wall_thickness = 0.08;
  t.cab_length = 2.0;
  t.cab_gap = 0.3;
  t.cab_top = 0.6;
  t.target_kg = 18000;
  t.approach_m = 14;
  t.speed = 2;
  return t;
}

inline WorldConfig site() {
  WorldConfig c;
  c.terrain.roughness = 0.02;
  c.trucks = {truck()};
  return c;
}

// Joint angles that put the tip at (r, z) of the swing plane with the bucket's elevation as given; elbow up.
inline JointState reach(const ImplementShape& s, double swing, double r, double z, double bucket_elevation) {
  const double pr = r - s.bucket * std::cos(bucket_elevation) - s.boom_pin_x, pz = z - s.bucket * std::sin(bucket_elevation) - s.boom_pin_z;
  const double d2 = pr * pr + pz * pz;
  const double stick = -std::acos((d2 - s.boom * s.boom - s.stick * s.stick) / (2 * s.boom * s.stick));
  const double boom = std::atan2(pz, pr) - std::atan2(s.stick * std::sin(stick), s.boom + s.stick * std::cos(stick));
  return {{swing, boom, stick, bucket_elevation - boom - stick}, {}};
}

// Moves a world along a straight line between two joint states; returns the last state.
inline JointState move(World& w, double& t, const JointState& from, const JointState& to, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds * 100));
  JointState before = from;
  for (int i = 1; i <= steps; ++i) {
    JointState now = from;
    for (size_t k = 0; k < 4; ++k) now.angle[k] += (to.angle[k] - from.angle[k]) * i / steps;
    t += 0.01;
    w.step(t, 0.01, now, before);
    before = now;
  }
  return before;
}

// Nothing of the machine but its sensors' places.
inline ImplementShape heads_only() {
  ImplementShape s = machine();
  s.parts.clear();
  s.upper_body.clear();
  s.tracks.clear();
  return s;
}

// One pass: drags the tip from the toe to the crest, curls, lifts. At the end the bucket is level and high.
inline JointState dig(World& w, const ImplementShape& s, double& t, double swing) {
  JointState at = reach(s, swing, 7.9, -1.2, -105 * degree);
  for (int i = 1; i <= 30; ++i) {
    const double f = i / 30.0;
    at = move(w, t, at, reach(s, swing, 7.8 - 2.0 * f, -1.9 + 1.4 * f * f, (-105 - 25 * f) * degree), 0.1);
  }
  const JointState curled = reach(s, swing, 5.0, 0.6, -180 * degree);
  at = move(w, t, at, curled, 1.5);
  return move(w, t, at, reach(s, swing, 5.0, 1.8, -180 * degree), 1.0);
}

// Swings over the truck at a place along the bed, opens, and waits until the bucket is empty.
inline JointState dump(World& w, const ImplementShape& s, double& t, const JointState& from, double swing) {
  JointState over = from;
  over.angle[0] = swing;
  JointState at = move(w, t, from, over, 4.0);
  // The lip stays over the middle of the bed while the bucket turns about it.
  constexpr int stages = 12;
  for (int i = 0; i <= stages; ++i) at = move(w, t, at, reach(s, swing, 6.6, 1.5, (-180 + 125.0 * i / stages) * degree), i == 0 ? 1.5 : 0.15);
  return move(w, t, at, at, 2.0);
}

}  // namespace berm::plant::bench
