// What is taken for the own machine: the layer about the implements, and the cylinder of the own body.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "draw.hpp"
#include "geometry/self_filter.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::uint64_t kSeed = 90813;

// The implements' outlines in the swing plane, by kinematics of the test's own.
class Outlines {
 public:
  Outlines(const berm_parameters& p, const JointAngles& a) : p_(p) {
    double x = p.boom_pin_x_mm * 1e-3, z = p.boom_pin_z_mm * 1e-3, angle = 0.0;
    const double length[3] = {p.boom_length_mm * 1e-3, p.stick_length_mm * 1e-3, p.bucket_length_mm * 1e-3}, turn[3] = {a.boom, a.stick, a.bucket};
    for (int link = 1; link <= 3; ++link) {
      angle += turn[link - 1];
      for (int i = 0; i < p.parts; ++i)
        if (p.part[i].link == link) add(p.part[i], x, z, angle);
      x += length[link - 1] * std::cos(angle);
      z += length[link - 1] * std::sin(angle);
    }
  }
  // Of a point from the part, in the plane; 0 inside.
  double distance(std::size_t part, Spot at) const {
    const auto& corner = outline_[part];
    double nearest = 1e9;
    bool inside = true;
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const Spot a = corner[i], b = corner[(i + 1) % corner.size()];
      const double ex = b.x - a.x, ey = b.y - a.y, t = std::clamp(((at.x - a.x) * ex + (at.y - a.y) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
      nearest = std::min(nearest, std::hypot(at.x - a.x - t * ex, at.y - a.y - t * ey));
      inside = inside && ex * (at.y - a.y) - ey * (at.x - a.x) >= 0.0;
    }
    return inside ? 0.0 : nearest;
  }
  double nearest(Spot at) const {
    double least = 1e9;
    for (std::size_t part = 0; part < outline_.size(); ++part) least = std::min(least, distance(part, at));
    return least;
  }
  std::size_t parts() const { return outline_.size(); }
  const std::vector<Spot>& outline(std::size_t part) const { return outline_[part]; }
  double half_width(std::size_t part) const { return half_width_[part]; }

 private:
  void add(const berm_part& part, double x, double z, double angle) {
    std::vector<Spot> corner;
    for (int v = 0; v < part.vertices; ++v) {
      const double u = part.vertex_mm[v][0] * 1e-3, w = part.vertex_mm[v][1] * 1e-3;
      corner.push_back({x + u * std::cos(angle) - w * std::sin(angle), z + u * std::sin(angle) + w * std::cos(angle)});
    }
    outline_.push_back(corner);
    half_width_.push_back(part.half_width_mm * 1e-3);
  }
  const berm_parameters& p_;
  std::vector<std::vector<Spot>> outline_;
  std::vector<double> half_width_;
};

class OwnMachine : public ::testing::Test {
 protected:
  berm_parameters parameters = berm::test::demo_parameters();

  double angle_lag(int joint) const {
    return (parameters.angle_error_urad[joint] + parameters.velocity_max_urad_s[joint] * 1e-6 * parameters.state_latency_us) * 1e-6;
  }
  JointAngles draw(std::mt19937_64& random) const {
    JointAngles a;
    double* joint[4] = {&a.swing, &a.boom, &a.stick, &a.bucket};
    for (int j = 1; j < 4; ++j) *joint[j] = uniform(random, parameters.joint_low_urad[j] * 1e-6, parameters.joint_high_urad[j] * 1e-6);
    return a;
  }
};

// Whatever the joints do, and wherever the report of them lags to.
// verifies: SK-FI-4
TEST_F(OwnMachine, TakesNothingForItsOwnBeyondTheStatedLayer) {
  constexpr int kPoints = 150000;
  const SelfFilter filter(parameters);
  std::mt19937_64 random(kSeed);
  const double side = stated("self filter", 0).width, body = parameters.own_body_radius_mm * 1e-3;
  std::array<double, 2> deepest = {0.0, 0.0};
  int beyond = 0, own = 0;
  for (int i = 0; i < kPoints; ++i) {
    const JointAngles is = draw(random);
    JointAngles reported = is;
    const double lag = i % 2 == 0 ? (random() % 2 == 0 ? 1.0 : -1.0) : 0.0;  // all one way, or drawn
    reported.boom += angle_lag(1) * (lag != 0.0 ? lag : uniform(random, -1, 1));
    reported.stick += angle_lag(2) * (lag != 0.0 ? lag : uniform(random, -1, 1));
    reported.bucket += angle_lag(3) * (lag != 0.0 ? lag : uniform(random, -1, 1));
    const Outlines true_outlines(parameters, is), reported_outlines(parameters, reported);
    // Near a corner of a part as it is reported, about the self margin away, or farther.
    const std::size_t part = random() % true_outlines.parts();
    const Spot corner = reported_outlines.outline(part)[random() % reported_outlines.outline(part).size()];
    const double direction = uniform(random, -3.2, 3.2), away = (i % 4 < 3 ? uniform(random, 0.9, 1.05) : uniform(random, 1.0, 2.4)) * parameters.self_margin_mm * 1e-3;
    const Spot at = {corner.x + away * std::cos(direction), corner.y + away * std::sin(direction)};
    if (at.x < body + 0.5 || at.y < 0.0 || at.y > 3.9) continue;  // what stands on the ground, beyond the own body
    const bool is_own = filter.is_own({at.x, 0.0, at.y}, filter.pose(reported));
    own += is_own ? 1 : 0;
    const double depth = true_outlines.nearest(at), most = own_layer(parameters, at.x);
    if (depth > most) {
      ++beyond;
      ASSERT_FALSE(is_own) << at.x << ", " << at.y << " is " << depth << " from the implements; seed " << kSeed << ", point " << i;
    }
    for (std::size_t d = 0; d < 2 && is_own; ++d)
      if (std::fabs(at.x - (d == 0 ? 5.0 : 9.6)) < 0.4) deepest[d] = std::max(deepest[d], depth);
    ASSERT_FALSE(filter.is_own({at.x, 0.6 + side + 0.001, at.y}, filter.pose(reported)));  // beside the widest part
  }
  std::cout << "seed " << kSeed << ": " << own << " points taken for own, " << beyond << " tried beyond the layer; farthest from the implements at 5 m " << deepest[0]
            << " m (stated " << stated("self filter", 0).height << "), at 9.6 m " << deepest[1] << " m (" << stated("self filter", 1).height << ")\n";
  EXPECT_GT(own, 1000);
  EXPECT_GT(beyond, 300);
  EXPECT_GE(deepest[0], 0.75 * own_layer(parameters, 5.0));
  EXPECT_GE(deepest[1], 0.75 * own_layer(parameters, 10.0));
}

// A board of 0.26 m thickness along the boom, and one along the bucket at the end of the stretched arm.
// verifies: SK-FI-4
TEST_F(OwnMachine, HidesWhatLiesWhollyInTheLayer) {
  const std::array<double, 4> pose = {0.4, degrees(12), degrees(-45), degrees(33)};
  const Outlines outlines(parameters, {pose[0], pose[1], pose[2], pose[3]});
  for (const double x : {5.0, 9.3}) {
    // The part over this place, and its height there.
    std::size_t part = 0;
    double low = 0.0, high = 0.0;
    for (std::size_t i = 0; i < outlines.parts(); ++i) {
      double from = 1e9, to = -1e9;
      for (double z = 0.0; z < 6.0; z += 0.01)
        if (outlines.distance(i, {x, z}) == 0.0) from = std::min(from, z), to = std::max(to, z);
      if (to - from > high - low) part = i, low = from, high = to;
    }
    ASSERT_GT(high - low, 0.3) << x;
    const double flank = outlines.half_width(part), margin = parameters.self_margin_mm * 1e-3;
    const auto board = [&](double inner, double outer) {  // beside the flank on the left, where the left scanner looks from
      const double y = 0.5 * (inner + outer), c = std::cos(pose[0]), s = std::sin(pose[0]);
      return box({x * c - y * s, x * s + y * c}, pose[0], 0.2, outer - inner, low, high);
    };
    const double pan = std::atan2(flank + 0.5 * margin - parameters.scanner[0].y_mm * 1e-3, x - parameters.scanner[0].x_mm * 1e-3);
    for (const bool beyond : {false, true}) {
      Sweep sweep(parameters, pose);
      sweep.scene.thing = {beyond ? board(flank + margin + 0.02, flank + 2 * margin) : board(flank + 0.02, flank + margin - 0.02)};
      for (int pass = 0; pass < 4; ++pass) sweep.pan(0, pan - degrees(9), pan + degrees(9), degrees(20), 77.0 * pass);
      const std::int32_t top = highest_top(sweep.map(), sweep.scene.thing[0].footprint);
      if (beyond) {
        EXPECT_GE(top, (high - row_height(parameters, x, 1)) * 1e3 - kGroundMm) << x << " m";
      } else {
        EXPECT_LE(top, kGroundMm) << x << " m";
      }
    }
  }
}

// What looks out over the boom by two rows is found, though the machine's own returns beneath it support nothing; by one row it can be hidden.
// verifies: SK-FI-3
TEST_F(OwnMachine, TwoRowsOverTheOwnBoomAreFoundAndOneIsNot) {
  constexpr int kTrials = 40;
  const std::array<double, 4> pose = {degrees(60), degrees(-7), degrees(-60), degrees(-40)};
  const SelfFilter filter(parameters);
  const JointAngles angles = {pose[0], pose[1], pose[2], pose[3]};
  std::mt19937_64 random(kSeed + 1);
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    int hidden = 0;
    for (int i = 0; i < kTrials; ++i) {
      const double rows = i % 2 == 0 ? 2.05 : 1.2;  // of the latter one at least is met, and mostly no more
      Sweep sweep(parameters, pose);
      const double c = std::cos(pose[0]), s = std::sin(pose[0]), x = 3.2, top = uniform(random, 2.77, 2.9);
      for (const double corner_x : {x - 0.2, x + 0.2})
        for (const double corner_z : {2.0, top}) ASSERT_TRUE(filter.is_own({corner_x, 0.25, corner_z}, filter.pose(angles)));
      const Prism boom = box({x * c, x * s}, pose[0], 0.4, 0.5, 2.0, top);
      // Behind it, seen from the left head.
      const double head_z = parameters.scanner[0].z_mm * 1e-3, pan = std::atan2(-parameters.scanner[0].y_mm * 1e-3, x - parameters.scanner[0].x_mm * 1e-3);
      const double width = stated("lines of a sweep: app", d).width;
      // The flattest depression under which the boom is met, over the thing's width.
      double rim = 1.0;
      for (const double aside : {-0.5, 0.0, 0.5})
        for (double b = 0.0; b < rim; b += 0.0005) {
          const double bearing = sweep.bearing(pan + aside * width / kDistances[d]);
          const Scene alone{-1e6, {boom}};
          const auto met = alone.range({{sweep.head(0).x, sweep.head(0).y, head_z}, {std::cos(b) * std::cos(bearing), std::cos(b) * std::sin(bearing), -std::sin(b)}});
          if (met && *met < 20.0) rim = b;
        }
      const double over = rim - rows * degrees(360.0 / kSamplesPerTurn), height = head_z - kDistances[d] * std::tan(over);
      ASSERT_GT(height, 0.3);
      sweep.scene.thing = {boom, cylinder_around(sweep.at(0, pan, kDistances[d]), width, height)};
      sweep.pan(0, pan - degrees(7), pan + degrees(7), pan_rates(parameters).app, uniform(random, 0, kSamplesPerTurn));
      const std::int32_t found = highest_top(sweep.map(), sweep.scene.thing[1].footprint);
      if (rows < 2.0) {
        hidden += found < (height - 1.5 * row_height(parameters, kDistances[d], 1)) * 1e3 ? 1 : 0;  // at 5 m its foot is seen beneath the boom
        continue;
      }
      ASSERT_GE(found, (height - row_height(parameters, kDistances[d], 1)) * 1e3 - kGroundMm) << kDistances[d] << " m, seed " << kSeed + 1 << ", thing " << i;
    }
    EXPECT_GT(hidden, 0) << kDistances[d] << " m";
    std::cout << kDistances[d] << " m, seed " << kSeed + 1 << ": of 1.2 rows over the boom, " << hidden << " of " << kTrials / 2 << " hidden\n";
  }
}

// verifies: SK-FI-5
TEST_F(OwnMachine, TheOwnBodysCylinderHidesEverythingAndEndsThere) {
  const double body = parameters.own_body_radius_mm * 1e-3;
  for (const bool beyond : {false, true}) {
    Sweep sweep(parameters, 0.4);
    const double pan = degrees(100);
    // A person beside the machine.
    double distance = 0.5;
    const auto from_axis = [&] { const Spot at = sweep.at(0, pan, distance); return std::hypot(at.x, at.y); };
    while (from_axis() < (beyond ? body + 0.35 : body - 0.35)) distance += 0.01;
    sweep.scene.thing = {box(sweep.at(0, pan, distance), sweep.bearing(pan), 0.3, 0.5, 0.0, 1.8)};
    sweep.pan(0, degrees(70), degrees(129), degrees(30), 0.0);
    const std::int32_t top = highest_top(sweep.map(), sweep.scene.thing[0].footprint);
    if (beyond) {
      EXPECT_GE(top, 1650);
    } else {
      EXPECT_LE(top, kGroundMm);
    }
  }
  for (std::size_t d = 0; d < kDistances.size(); ++d) EXPECT_GT(kDistances[d], body + kCell * 1.415) << "so the page says none";
}

}  // namespace
}  // namespace berm::kernel::test
