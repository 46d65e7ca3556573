// The VLP-16: what stands between its firings and its channels.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>

#include "draw.hpp"
#include "io/cycle.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::uint64_t kSeed = 90816;
constexpr int kElevation[16] = {-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};  // degrees, in the lasers' order

// A lidar over the map's middle, in map-only mode: packets through the kernel's own decoder.
class Lidar {
 public:
  explicit Lidar(const berm_parameters& parameters) : cycle_(std::make_unique<Cycle>(parameters, true)) {}

  Scene scene;

  // A turn of 36000 hundredths of a degree, the first firing at this azimuth (clockwise).
  void turn(double azimuth_deg) {
    const double step = 360.0 * kLidarTurnsPerSecond * kLidarFiring;
    in_->clear();
    for (double turned = 0.0; turned < 360.0; turned += 24 * step) {
      std::uint8_t bytes[kVlp16PacketBytes] = {};
      for (int block = 0; block < 12; ++block) {
        std::uint8_t* p = bytes + 100 * block;
        p[0] = 0xFF;
        p[1] = 0xEE;
        const double azimuth = azimuth_deg + turned + 2 * block * step;
        const auto raw = static_cast<unsigned>(std::lround(std::fmod(azimuth + 360.0, 360.0) * 100.0)) % 36000U;
        p[2] = static_cast<std::uint8_t>(raw & 0xFFU);
        p[3] = static_cast<std::uint8_t>(raw >> 8);
        for (int shot = 0; shot < 32; ++shot) fire(azimuth + step * (shot / 16) + step * (shot % 16) * 2.304e-6 / kLidarFiring, shot % 16, p + 4 + 3 * shot);
      }
      bytes[1204] = 0x38;
      bytes[1205] = 0x22;
      ASSERT_TRUE(in_->take_vlp16(Vlp16Mount{}, bytes, sizeof bytes, *scratch_));
    }
    in_->cycle++;
    in_->now_us += 100000;
    cycle_->step(*in_, *out_);
  }
  const sk_height_map& map() const { return cycle_->map(); }

 private:
  void fire(double azimuth_deg, int laser, std::uint8_t* record) const {
    const double e = degrees(kElevation[laser]), b = -degrees(azimuth_deg);
    const auto range = scene.range({{0.0, 0.0, kLidarHeight}, {std::cos(e) * std::cos(b), std::cos(e) * std::sin(b), std::sin(e)}});
    const unsigned raw = range && *range < 100.0 ? static_cast<unsigned>(std::lround(*range * 500.0)) : 0U;
    record[0] = static_cast<std::uint8_t>(raw & 0xFFU);
    record[1] = static_cast<std::uint8_t>(raw >> 8);
    record[2] = 10;
  }

  std::unique_ptr<Cycle> cycle_;
  std::unique_ptr<CycleInputs> in_ = std::make_unique<CycleInputs>();
  std::unique_ptr<CycleOutputs> out_ = std::make_unique<CycleOutputs>();
  std::unique_ptr<Vlp16Packet> scratch_ = std::make_unique<Vlp16Packet>();
};

const berm_parameters kParameters = berm::test::demo_parameters();

// verifies: SK-FI-9
TEST(LidarHides, NothingOfTheStatedSizeInOneTurn) {
  constexpr int kTrials = 12;
  std::mt19937_64 random(kSeed);
  for (std::size_t d = 0; d < kDistances.size(); ++d)
    for (int i = 0; i < kTrials; ++i) {
      Lidar lidar(kParameters);
      const double gap = stated("VLP-16: channels", d).height, height = uniform(random, gap, 3.0);
      Prism thing;
      do {
        const double bearing = uniform(random, -3.1, 3.1);
        thing = cylinder_around({kDistances[d] * std::cos(bearing), kDistances[d] * std::sin(bearing)}, stated("VLP-16: firings", d).width, height);
      } while (!in_map(thing.footprint));
      lidar.scene.thing = {thing};
      lidar.turn(uniform(random, 0.0, 360.0));
      ASSERT_GE(highest_top(lidar.map(), thing.footprint), (height - gap) * 1e3 - kGroundMm) << kDistances[d] << " m, seed " << kSeed << ", thing " << i;
    }
}

// verifies: SK-FI-9
TEST(LidarHides, AWallUnderABeam) {
  for (const double distance : kDistances) {
    Lidar lidar(kParameters);
    // Just behind a beam's place on the ground, as near to the distance as there is one; the lowest beam passes over what is nearer.
    double foot = distance;
    for (int elevation = -13; elevation < 0 && distance > 7.0; elevation += 2) {
      const double ground = kLidarHeight / std::tan(degrees(-elevation));
      if (std::fabs(ground - distance) < std::fabs(foot - distance) || foot == distance) foot = ground + 0.02;
    }
    const double height = 0.93 * lidar_gap(foot);
    EXPECT_GE(height, 0.8 * lidar_gap(distance));
    const Prism wall = box({foot, 0.0}, 0.0, 0.01, 1.0, 0.0, height);
    lidar.scene.thing = {wall};
    for (int turn = 0; turn < 3; ++turn) lidar.turn(0.07 * turn);
    const std::int32_t top = highest_top(lidar.map(), wall.footprint);
    EXPECT_LE(top, 30) << distance << " m";  // ground near the beam's edge, rounded up
  }
}

// verifies: SK-FI-9
TEST(LidarHides, APostBetweenFirings) {
  constexpr double kHeight = 0.8;
  const double step = 360.0 * kLidarTurnsPerSecond * kLidarFiring;
  for (const double distance : kDistances) {
    Lidar lidar(kParameters);
    // Its lasers fire one after the other: midway for those that meet the post's height.
    double later = 0.0;
    int meet = 0;
    for (int laser = 0; laser < 16; ++laser) {
      const double z = kLidarHeight + distance * std::tan(degrees(kElevation[laser]));
      if (z > 0.0 && z < kHeight) later += laser * 2.304e-6 / kLidarFiring, ++meet;
    }
    ASSERT_GT(meet, 0);
    const double width = 0.85 * lidar_step(distance), bearing = -degrees(30.0 + (100.5 + later / meet) * step);
    const Prism post = box({distance * std::cos(bearing), distance * std::sin(bearing)}, bearing, 0.005, width, 0.0, kHeight);
    lidar.scene.thing = {post};
    lidar.turn(30.0);
    const std::int32_t hidden = highest_top(lidar.map(), post.footprint);
    lidar.turn(30.0 + 0.5 * step);
    EXPECT_LE(hidden, kGroundMm) << distance << " m";
    EXPECT_GT(highest_top(lidar.map(), post.footprint), 200) << "half a firing further it is met; " << distance << " m";
  }
}

}  // namespace
}  // namespace berm::kernel::test
