// The recorded revolutions of a real VLP-16 as those of a lidar on the machine, through the whole cycle with the workspace watched: no fault and no
// alarm; and somebody drawn into them stops the machine.
//
// The recording is 0.4 s, four turns of a sensor that stands. It is repeated, each time with a later clock: noise and edges are the sensor's, what
// moves in hours is not in it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include "config/compile_parameters.hpp"
#include "cycle_rig.hpp"
#include "recording.hpp"

namespace berm::kernel::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint64_t kPacketNs = 12 * 55296;  // twelve firings, each twice: last and strongest return

class RecordingWatch : public ::testing::Test {
 protected:
  void SetUp() override {
    recorded = payloads(bytes_of(vlp16_recording("vlp16_dual_return.pcap")));
    if (recorded.empty()) GTEST_SKIP() << "SKIPPED: no recording at " << vlp16_recording("vlp16_dual_return.pcap");
    berm_parameters p = config::compile_parameters(config::load_machine_file(BERM_CONFIG_FILES "/machines/zx200_ring.toml"),
                                                   config::load_site_file(BERM_CONFIG_FILES "/sites/bench.toml"));
    p.lidars = 1;  // one was recorded
    p.truck_zones = p.lanes = 0;
    rig = std::make_unique<CycleRig>(p);
  }
  // One cycle with the packets that are finished by then.
  void step() {
    rig->gather();
    for (; clock_us() < static_cast<std::uint64_t>(rig->machine.time_us()); ++sent) {
      Bytes bytes = recorded[sent % recorded.size()];
      if (person) person(bytes);
      for (std::size_t k = 0; k < 4; ++k) bytes[1200 + k] = static_cast<std::uint8_t>(clock_us() >> (8 * k));
      ASSERT_TRUE(rig->in->take_lidar(0, bytes.data(), bytes.size()));
    }
    rig->cycle->step(*rig->in, *rig->out);
    rig->obey();
  }
  std::uint64_t clock_us() const { return sent * kPacketNs / 1000; }
  const berm_state& state() const { return rig->state(); }
  const WorkspaceWatch& workspace() const { return rig->cycle->workspace(); }

  std::vector<Bytes> recorded;
  std::unique_ptr<CycleRig> rig;
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
  constexpr std::int64_t kParkedS = 60;
  while (rig->machine.time_us() < kParkedS * 1000000) {
    step();
    ASSERT_NE(state().kernel_state, BERM_STATE_FAULT) << "reason " << int{state().stop_reason} << " at " << rig->machine.time_us() << " us";
    ASSERT_NE(state().stop_reason, BERM_STOP_INTRUDER)
        << "at " << rig->machine.time_us() << " us, " << state().blocked_x_mm << " " << state().blocked_y_mm << ", " << state().blocked_height_mm << " mm";
  }
  EXPECT_EQ(rig->cycle->lidars_rejected(), 0U);
  EXPECT_EQ(workspace().newest_us(1), rig->machine.time_us());
  std::printf("%d s, %zu packets, %zu turns of the recording: no fault, no alarm\n", static_cast<int>(kParkedS), sent, sent / recorded.size());

  Standing standing{0.0};
  // Where there is nothing near him: of 72 bearings the first in which the most returns are farther.
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
  int cycles = 0;
  while (state().stop_reason != BERM_STOP_INTRUDER && ++cycles < 100) step();
  std::printf("somebody at %.1f m, azimuth %.0f degrees: stopped after %d ms\n", standing.range_m, standing.azimuth_deg, cycles * 10);
  EXPECT_LE(cycles, 35) << "a turn may pass before he is met, and 250 ms until the stop";
}

}  // namespace
}  // namespace berm::kernel::test
