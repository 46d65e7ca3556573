// The recorded revolutions of a real VLP-16 as those of a lidar on the machine, through intake and Workspace Monitor: nothing refused, no alarm; and
// somebody drawn into them stops the machine.
//
// The recording is 0.4 s, four turns of a sensor that stands. It is repeated, each time with a later clock: noise and edges are the sensor's, what
// moves in hours is not in it. The recorded sensor stands on its vehicle so that its lowest lasers see nothing: on this machine that is a fault.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include "config/compile_parameters.hpp"
#include "io/lidar_intake.hpp"
#include "io/sight_watch.hpp"
#include "io/workspace_watch.hpp"
#include "recording.hpp"

namespace berm::kernel::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint64_t kPacketNs = 12 * 55296;  // twelve firings, each twice: last and strongest return

berm_parameters machine_with_a_lidar() {
  berm_parameters p = config::compile_parameters(config::load_machine_file(BERM_CONFIG_FILES "/machines/zx200_ring.toml"),
                                                 config::load_site_file(BERM_CONFIG_FILES "/sites/bench.toml"));
  p.lidars = 1;  // one was recorded
  p.truck_zones = p.lanes = 0;
  return p;
}

class RecordingWatch : public ::testing::Test {
 protected:
  void SetUp() override {
    recorded = payloads(bytes_of(vlp16_recording("vlp16_dual_return.pcap")));
    if (recorded.empty()) GTEST_SKIP() << "SKIPPED: no recording at " << vlp16_recording("vlp16_dual_return.pcap");
    sk_map_clear(map.get());
  }
  // One cycle with the packets that are finished by then; whether the machine must stand.
  bool step() {
    now_us += 10000;
    const std::int32_t pose[4] = {0, 870000, -1570000, -700000};
    joints->push(now_us, pose);
    for (; clock_us() < static_cast<std::uint64_t>(now_us); ++sent) {
      Bytes bytes = recorded[sent % recorded.size()];
      if (person) person(bytes);
      for (std::size_t k = 0; k < 4; ++k) bytes[1200 + k] = static_cast<std::uint8_t>(clock_us() >> (8 * k));
      EXPECT_TRUE(intake->take(0, bytes.data(), bytes.size(), *joints, now_us, *map, *shadow)) << "packet " << sent;
      watch->take(0, intake->packet(), joints->at(intake->middle_us(0)).angles, now_us);
      sight->take(0, bytes.data(), 0.0, now_us);
    }
    sight->step(now_us);
    return watch->step(now_us);
  }
  std::uint64_t clock_us() const { return sent * kPacketNs / 1000; }
  std::string where() const {
    std::int32_t x = 0, y = 0, height = 0;
    return watch->place(x, y, height) ? std::to_string(x) + " " + std::to_string(y) + ", " + std::to_string(height) + " mm" : "nowhere";
  }

  const berm_parameters parameters = machine_with_a_lidar();
  std::vector<Bytes> recorded;
  std::unique_ptr<JointHistory> joints = std::make_unique<JointHistory>();
  std::unique_ptr<LidarIntake> intake = std::make_unique<LidarIntake>(parameters);
  std::unique_ptr<WorkspaceWatch> watch = std::make_unique<WorkspaceWatch>(parameters);
  std::unique_ptr<SightWatch> sight = std::make_unique<SightWatch>(parameters);
  std::unique_ptr<sk_height_map> map = std::make_unique<sk_height_map>();
  std::unique_ptr<OwnShadow> shadow = std::make_unique<OwnShadow>(1000000);
  std::int64_t now_us = 0;
  std::size_t sent = 0;
  std::function<void(Bytes&)> person;
};

// Whoever stands upright before everything recorded in these bearings, 3.5 m from the sensor: 0.5 m wide.
struct Standing {
  double azimuth_deg, range_m = 3.5, half_width_m = 0.25;

  int met = 0;
  void operator()(Bytes& bytes) {
    for (std::size_t block = 0; block < 12; ++block) {
      std::uint8_t* at = &bytes[100 * block];
      const double away_deg = std::remainder(read_at<std::uint16_t>(at + 2) * 0.01 - azimuth_deg, 360.0);
      if (std::fabs(away_deg) * kPi / 180.0 * range_m > half_width_m) continue;
      for (int laser = 0; laser < 32; ++laser) {
        const int k = laser % 16, elevation_deg = k % 2 == 0 ? k - 15 : k;  // VLP-16 manual, table 9-1
        std::uint8_t* range = at + 4 + 3 * laser;
        const double recorded_m = read_at<std::uint16_t>(range) * 0.002, met_m = range_m / std::cos(elevation_deg * kPi / 180.0);
        if (recorded_m < met_m && recorded_m > 0.0) continue;
        const auto units = static_cast<std::uint16_t>(std::lround(met_m * 500.0));
        std::memcpy(range, &units, sizeof units);
        ++met;
      }
    }
  }
};

// verifies: SK-WM-56, SK-LI-5
TEST_F(RecordingWatch, AParkedSceneIsNoIntruderAndWhoStandsInItIs) {
  constexpr std::int64_t kParkedS = 60;  // three times as long as the ground is learned
  while (now_us < kParkedS * 1000000) ASSERT_FALSE(step()) << "at " << now_us << " us, " << where();
  EXPECT_EQ(watch->newest_us(1), now_us);
  std::printf("%d s, %zu packets, %zu times the recording: nothing refused, no alarm\n", static_cast<int>(kParkedS), sent, sent / recorded.size());

  Standing standing{0.0};
  // Where the most of what is recorded is farther than he is, of 72 bearings.
  int most = 0;
  for (int k = 0; k < 72; ++k) {
    Standing tried{5.0 * k};
    for (Bytes bytes : recorded) tried(bytes);
    if (tried.met <= most) continue;
    most = tried.met;
    standing.azimuth_deg = tried.azimuth_deg;
  }
  ASSERT_GT(most, 0);
  person = [&standing](Bytes& bytes) { standing(bytes); };
  int cycles = 1;
  while (!step() && cycles < 100) ++cycles;
  std::printf("somebody at %.1f m, azimuth %.0f degrees: stopped after %d ms\n", standing.range_m, standing.azimuth_deg, cycles * 10);
  EXPECT_LE(cycles, 35) << "a turn may pass before he is met, and 250 ms until the stop";
}

// It is a fault because the recorded sensor's view down is covered by what carries it, not because of its noise: of the three lowest lasers' shots 95 %
// come back from nothing farther than 0.5 m.
// verifies: SK-SI-3
TEST_F(RecordingWatch, TheRecordedSensorsPlaceWouldBeRefused) {
  while (now_us < 1000000) step();
  EXPECT_TRUE(sight->blocked());
  int strips = 0;
  for (const sk_strip& strip : sight->eye(SightWatch::kScanners).strip) strips += strip.blocked;
  EXPECT_GE(strips, 10) << "of 24, those towards the upper body not judged";
  EXPECT_EQ(sight->dust(), SK_DUST_NONE) << sight->dust_permille();
}

}  // namespace
}  // namespace berm::kernel::test
