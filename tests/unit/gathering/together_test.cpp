// Recordings that were made at the same time are played by time.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <tuple>

#include "gathering/gather_recording.hpp"
#include "gathering/recording_clocks.hpp"
#include "gathering/scan_frame.hpp"
#include "points/pcd.hpp"
#include "points/recording.hpp"
#include "scratch.hpp"
#include "scanned_room.hpp"

namespace berm::app {
namespace {

using namespace test;

const Box kBox{{2.4, -0.5, 0.3}, {2.9, 0.1, 1.9}};

// Both scan the room at once; the box is taken away in the middle. The second sweeps over the box but before that.
class TwoRecordings : public testing::Test {
protected:
  TwoRecordings() {
    ScannedRoom room(4);
    // On the axis of the pan: a PCD knows one place of the optical centre.
    constexpr double kQuarterTurn = 1.5707963267948966;
    const DhLink pan_joint{0.0, 1.0, 0.0, 0.0, DhLink::Joint::kRevolute, 0};
    const KinematicChain chains[] = {KinematicChain({pan_joint, {0.0, 0.1, 0.0, kQuarterTurn}}),
                                     KinematicChain({pan_joint, {0.25, -0.1, 0.0, kQuarterTurn - 0.4}})};
    std::vector<ScanPoint> points[2];
    std::uint32_t scanline[2] = {0, 0};
    for (int i = 0; i < 160; ++i) {
      room.box = i < 80 ? std::optional(kBox) : std::nullopt;
      for (std::size_t s = 0; s < 2; ++s) {
        if (s == 1 && i % 3 != 0) continue;  // the slower one
        const double pan[] = {s == 1 && i >= 80 ? 0.75 : (i < 80 ? -0.4 + 0.01 * i : 1.2 - 0.01 * i)};
        const Eigen::Isometry3d pose = chains[s].pose(pan);
        for (const PolarReturn& p : room.scan(pose, 0.01)) {
          const Eigen::Vector3d at = pose * Eigen::Vector3d(p.range_m * std::cos(p.angle_rad), p.range_m * std::sin(p.angle_rad), 0.0);
          points[s].push_back({static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(at.z()), scanline[s], 100.0 + 0.02 * i});
        }
        ++scanline[s];
      }
    }
    const berm::test::Scratch scratch;
    for (std::size_t s = 0; s < 2; ++s) {
      const std::string path = scratch.path("together_" + std::to_string(s) + ".pcd");
      const double middle[] = {0.0};
      const Eigen::Vector3d centre = chains[s].pose(middle).translation();
      write_pcd(path, points[s], {centre.x(), centre.y(), centre.z()});
      recordings_.push_back(read_recording(path));
    }
  }

  static std::size_t on_box(const PointCloudGatherer& gatherer) {
    const auto points = gatherer.points();
    return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [](const ScanPoint& p) {
      return p.x < 3.2F && p.y > -0.6F && p.y < 0.2F && p.z > 0.4F && p.z < 1.8F;
    }));
  }

  PointCloudGatherer gatherer() const {
    PointCloudGatherer out(GatheringOptions{.epoch = kEpochRuleOfRecordings});
    for (std::size_t s = 0; s < 2; ++s) out.add_scanner({});
    return out;
  }

  std::vector<PointCloud> recordings_;
};

TEST_F(TwoRecordings, PlayedTogetherAreFedInTheOrderOfTime) {
  // By hand: all scanlines of both, sorted by time; of equal times the first recording's first.
  struct Scanline {
    std::size_t of;
    std::span<const ScanPoint> points;
  };
  std::vector<Scanline> all;
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t begin = 0, end = 0; begin < recordings_[s].points.size(); begin = end) {
      while (end < recordings_[s].points.size() && recordings_[s].points[end].scanline == recordings_[s].points[begin].scanline) ++end;
      all.push_back({s, std::span(recordings_[s].points).subspan(begin, end - begin)});
    }
  std::stable_sort(all.begin(), all.end(), [](const Scanline& a, const Scanline& b) { return a.points[0].time_s < b.points[0].time_s; });
  PointCloudGatherer by_hand = gatherer();
  std::optional<Eigen::Isometry3d> before[2];
  for (const Scanline& line : all) {
    const auto& at = recordings_[line.of].viewpoint;
    const auto scan = fit_scan(line.points, {at[0], at[1], at[2]}, before[line.of] ? &*before[line.of] : nullptr);
    ASSERT_TRUE(scan);
    before[line.of] = scan->frame;
    by_hand.add_scan(line.of, scan->frame, scan->returns, line.points[0].time_s);
  }

  PointCloudGatherer together = gatherer();
  std::vector<RecordingPlayer> players;
  for (std::size_t s = 0; s < 2; ++s) players.emplace_back(recordings_[s], s, Eigen::Isometry3d::Identity());
  play_together(players, together);
  EXPECT_EQ(players[0].unplanned() + players[1].unplanned(), 0U);
  EXPECT_EQ(together.counts().deleted, by_hand.counts().deleted);
  EXPECT_EQ(together.counts().merged, by_hand.counts().merged);
  const auto expected = by_hand.points(), got = together.points();
  ASSERT_EQ(got.size(), expected.size());
  const auto key = [](const ScanPoint& p) { return std::tuple(p.scanline, p.time_s, p.x, p.y, p.z); };
  for (std::size_t i = 0; i < got.size(); ++i) ASSERT_EQ(key(got[i]), key(expected[i])) << i;

  // The box is gone, as the first saw last. One after another the second, played last, puts it back.
  EXPECT_EQ(on_box(together), 0U);
  PointCloudGatherer in_turn = gatherer();
  for (std::size_t s = 0; s < 2; ++s) gather_recording(recordings_[s], s, Eigen::Isometry3d::Identity(), in_turn);
  EXPECT_GT(on_box(in_turn), 100U);
}

TEST_F(TwoRecordings, TheirTimesTellThatTheyBelongTogether) {
  const RecordingTimes times[] = {times_of(recordings_[0]), times_of(recordings_[1])};
  EXPECT_EQ(times[0].first_s, 100.0);
  EXPECT_NEAR(times[0].last_s, 103.18, 1e-9);
  EXPECT_EQ(played_together(times, ClockRule::kByTimes), (std::vector<std::vector<std::size_t>>{{0, 1}}));
  EXPECT_EQ(played_together(times, ClockRule::kOwn), (std::vector<std::vector<std::size_t>>{{0}, {1}}));
}

TEST(RecordingClocks, WhatIsPlayedTogether) {
  using Groups = std::vector<std::vector<std::size_t>>;
  const auto groups = [](const std::vector<RecordingTimes>& times, ClockRule rule = ClockRule::kByTimes) { return played_together(times, rule); };
  const auto pcd = [](double first, double last) { return RecordingTimes{"a.pcd", "pcd", true, first, last}; };
  EXPECT_EQ(groups({}), Groups{});
  EXPECT_EQ(groups({pcd(5, 6), pcd(1, 2), pcd(1.5, 3)}), (Groups{{0}, {1, 2}})) << "the groups stay in the order of the files";
  EXPECT_EQ(groups({pcd(1, 2), pcd(8, 9), pcd(3, 4), pcd(1.5, 3.5)}), (Groups{{0, 2, 3}, {1}})) << "the last ties two together";
  EXPECT_EQ(groups({pcd(0, 2), pcd(0, 2)}), (Groups{{0}, {1}})) << "each counts from its own beginning";
  EXPECT_EQ(groups({pcd(0, 2), pcd(1, 2), pcd(1, 2)}), (Groups{{0}, {1, 2}}));
  EXPECT_EQ(groups({{"a.pcap", "pcap", true, 1, 2}, {"b.pcap", "pcap", true, 1, 2}}), (Groups{{0}, {1}})) << "of which hour is not known";
  EXPECT_EQ(groups({{"a.json", "lms", true, 1, 2}, pcd(1, 2)}), (Groups{{0}, {1}})) << "since the scanner's start";
  EXPECT_EQ(groups({{"a.pcd", "pcd", false, 0, 0}, pcd(-1, 2)}), (Groups{{0}, {1}})) << "no times";
  EXPECT_EQ(groups({pcd(0, 2), {"a.pcap", "pcap", true, 7, 9}}, ClockRule::kOne), (Groups{{0, 1}}));
  try {
    groups({pcd(0, 2), {"none.pcd", "pcd", false, 0, 0}}, ClockRule::kOne);
    FAIL();
  } catch (const PointFileError& error) {
    EXPECT_EQ(std::string(error.what()), "none.pcd: time: the file has none, and --clock one wants one of every file");
  }
}

}  // namespace
}  // namespace berm::app
