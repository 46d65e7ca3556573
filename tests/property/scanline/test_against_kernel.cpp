// Two programs that were written apart place and judge the same returns.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "perception/scan_intake.hpp"
#include "rig.hpp"

namespace berm::test {
namespace {

using namespace berm::app;

struct Reader {
  explicit Reader(const MachineModel& machine) : intake(machine) {}
  void take(const berm_state_segment& segment) { intake.take(segment, terrain, nullptr, sweep); }
  ScanIntake intake;
  TerrainMap terrain;
  TruckSweep sweep;
};

TEST(ScanlineAgainstKernel, EveryPointLiesWhereTheKernelPutsIt) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const char* scenario : {"short", "dust"}) {
      ScanRig rig(scenario, seed, drawn_motion(seed, zx200_file()));
      Reader reader(rig.machine());
      while (rig.time_s() < 2.0) {
        rig.advance();
        reader.take(rig.segment());
      }
      EXPECT_GT(reader.intake.check().compared(), 10000u) << scenario << " " << seed;
      EXPECT_EQ(reader.intake.check().disagreeing(), 0u) << scenario << " " << seed;
      EXPECT_EQ(reader.intake.counts().blocks_refused, 0u);
      EXPECT_EQ(reader.intake.counts().blocks_missed, 0u);
    }
}

// An app that sleeps through cycles reads what it missed in the rings, and still has a state on both sides of each sample.
TEST(ScanlineAgainstKernel, AlsoWhereTheAppSleepsThroughCycles) {
  ScanRig rig("short", 3, drawn_motion(3, zx200_file()));
  Reader reader(rig.machine());
  for (int k = 1; k <= 200; ++k) {
    rig.advance();
    if (k % 13 == 0) reader.take(rig.segment());
  }
  EXPECT_GT(reader.intake.check().compared(), 10000u);
  EXPECT_EQ(reader.intake.check().disagreeing(), 0u);
  EXPECT_EQ(reader.intake.counts().blocks_missed, 0u);
}

// A projection that is wrong on either side shows at once: by a hundredth of a radian of the swing, by a cycle in time.
TEST(ScanlineAgainstKernel, AWrongPoseIsNoticed) {
  ScanRig rig("short", 4, [](double t) {
    Stance s;
    s.joint = {0.2 + 0.5 * t, 0.8, -1.6, -1.6};
    s.pan = {0.3, -0.3};
    return s;
  });
  MachineModel elsewhere = rig.machine();
  elsewhere.scanner[0].x += 0.02;
  Reader right(rig.machine()), wrong(elsewhere), late(rig.machine());
  auto shifted = std::make_unique<berm_state_segment>();
  while (rig.time_s() < 0.6) {
    rig.advance();
    right.take(rig.segment());
    wrong.take(rig.segment());
    *shifted = rig.segment();
    for (berm_decision& d : shifted->decision) d.time_us += 10000;  // the states of the cycle before
    late.take(*shifted);
  }
  EXPECT_EQ(right.intake.check().disagreeing(), 0u);
  const auto share = [](const Reader& r) {
    return static_cast<double>(r.intake.check().disagreeing()) / static_cast<double>(r.intake.check().compared());
  };
  EXPECT_GT(share(late), 0.9);
  EXPECT_GT(share(wrong), 0.4) << "all of the left scanner's";
  EXPECT_LT(share(wrong), 0.6);
  ASSERT_TRUE(wrong.intake.check().first());
  EXPECT_EQ(wrong.intake.check().first()->scanner, 0u);
  EXPECT_NEAR(wrong.intake.check().first()->distance(), 0.02, 0.003);
}

// What the app takes for ground and truck is what the kernel takes for them, but for returns at the margin of the implements.
TEST(ScanlineAgainstKernel, TheSameReturnsAreTheMachinesOwnOrAlone) {
  std::size_t compared = 0, differ = 0, own = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    // The implements hang before the scanners, over the bench.
    const auto lowered = [motion = drawn_motion(seed, zx200_file())](double t) {
      Stance s = motion(t);
      s.joint = {s.joint[0], 0.45 + 0.1 * std::sin(3.0 * t), -1.2, -1.3};
      s.pan = {0.6 * std::sin(2.0 * t), 0.6 * std::cos(2.0 * t)};
      return s;
    };
    ScanRig rig("short", seed, lowered);
    ScanlineProcessor processor(rig.machine());
    MachineHistory history;
    std::map<std::tuple<int, std::uint32_t, int>, bool> used;
    while (rig.time_s() < 1.5) {
      rig.advance();
      history.take(rig.segment());
      for (int b = 0; b < rig.blocks().count; ++b) {
        const berm_scan_block& block = rig.blocks().block[b];
        for (int i = 0; i < block.count; ++i) used[{block.scanner, block.scanline, block.first_index + i}] = block.used[i] == 1;
        for (const ScanlinePart& part : processor.take(block, history))
          for (int i = 0; i < part.count; ++i) {
            const ScanReturn& s = part.sample[static_cast<std::size_t>(i)];
            if (s.range <= 0.0 || std::max(std::fabs(s.x), std::fabs(s.y)) > ProjectionCheck::farthest) continue;
            ++compared;
            own += s.own && std::hypot(s.x, s.y) > rig.machine().own_body_radius ? 1 : 0;
            differ += (s.usable() && !s.lone) != used.at({static_cast<int>(part.scanner), part.scanline, part.first_index + i}) ? 1 : 0;
          }
      }
    }
  }
  RecordProperty("compared", static_cast<int>(compared));
  RecordProperty("differ", static_cast<int>(differ));
  RecordProperty("own", static_cast<int>(own));
  EXPECT_GT(compared, 50000u);
  EXPECT_GT(own, 1000u) << "on the implements";
  EXPECT_LT(static_cast<double>(differ), 0.005 * static_cast<double>(compared)) << differ << " of " << compared;
}

}  // namespace
}  // namespace berm::test
