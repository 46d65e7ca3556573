// Where the kernel's monitor differs from the paper's figures taken to the letter, each by a scene in which both are shown what happens.
// safety_kernel/requirements/workspace_monitor.md, "Differences", has the list that these tests hold.
#include <gtest/gtest.h>

#include "monitor_scene.hpp"
#include "paper_monitor.hpp"

namespace berm::core_test {
namespace {

constexpr int kSide = 11, kY = 5, kX = 5;

// Both see the same; cell (kY, kX) of the paper's small map is cell (50, 50) of the kernel's.
class Both {
 public:
  Both(PaperMerge merge, bool continuous) : paper(merge, kSide, kHeightThreshold, kNeighbourThreshold, kSlopeThreshold), ours(continuous) {}

  void ground(int height) {
    ours.ground(height);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) paper.cell(y, x) = {PaperFlag::kSet, height, 0};
  }
  void see(int dy, int dx, int z, int points = 2) {
    for (int i = 0; i < points; ++i) paper.point(kY + dy, kX + dx, z);
    ours.see(50 + dy, 50 + dx, z, points);
  }
  void interpolate(int dy, int dx, int z) {
    paper.interpolated_point(kY + dy, kX + dx, z);
    ours.interpolate(50 + dy, 50 + dx, z);
  }
  void update() {
    paper.update();
    stop = ours.step();
  }
  void settle() {
    update();
    update();
  }
  void empty(int dy, int dx) {
    paper.cell(kY + dy, kX + dx).status = PaperFlag::kEmpty;
    ours.accumulated(50 + dy, 50 + dx, {SK_FLAG_EMPTY, -20000, -20000});
  }
  PaperFlag paper_flag() { return paper.cell(kY, kX).status; }
  int our_flag() const { return ours.accumulated(50, 50).flag; }

  PaperMonitor paper;
  MonitorScene ours;
  bool stop = false;
};

// verifies: SK-WM-12, SK-WM-41
TEST(PaperMonitor, Figure6MarksTheWrongCellSoThatNobodyIsTold) {
  for (const bool continuous : {true, false}) {
    Both both(continuous ? PaperMerge::kFigure7 : PaperMerge::kFigure8, continuous);
    both.ground(0);
    both.see(0, 0, 1700);
    both.settle();
    EXPECT_EQ(both.paper.notices(), 0) << "Figure 6 sets cell.status; only tempCell.status would reach notifyPlannerOfChange";
    EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
    EXPECT_TRUE(both.stop);
  }
}

// verifies: SK-WM-13
TEST(PaperMonitor, Figure6LosesAnObstacleBesideOneEmptyCell) {
  Both both(PaperMerge::kFigure7, true);
  both.ground(0);
  both.empty(0, 1);
  both.see(0, 0, 1700);
  both.settle();
  EXPECT_EQ(both.paper_flag(), PaperFlag::kChanged) << "the first EMPTY neighbour already makes the temporary cell CHANGED";
  EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
}

// verifies: SK-WM-21
TEST(PaperMonitor, Figure7LeavesEveryCellEmptySoThatNothingIsEverAnObstacle) {
  Both both(PaperMerge::kFigure7, true);
  for (int sweep = 0; sweep < 3; ++sweep) {
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) both.see(dy, dx, 0);
    both.settle();
  }
  EXPECT_EQ(both.paper_flag(), PaperFlag::kEmpty);
  EXPECT_EQ(both.our_flag(), SK_FLAG_SET);
  both.see(0, 0, 1700);
  both.settle();
  EXPECT_EQ(both.paper_flag(), PaperFlag::kChanged) << "all its neighbours are EMPTY";
  EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
}

// verifies: SK-WM-28
TEST(PaperMonitor, Figure8NeverClears) {
  Both both(PaperMerge::kFigure8, false);
  both.ground(0);
  both.paper.cell(kY, kX) = {PaperFlag::kObstacle, 0, 1700};
  both.ours.accumulated(50, 50, {SK_FLAG_OBSTACLE, 0, 1700});
  both.see(0, 0, 0);
  both.settle();
  EXPECT_EQ(both.paper_flag(), PaperFlag::kObstacle) << "it asks whether a NOT_VISITED cell is an OBSTACLE";
  EXPECT_EQ(both.our_flag(), SK_FLAG_SET);
}

// A person of 1700 mm who stands still, seen at 1650 mm in the next sweep from behind something that is nearly as high.
// verifies: SK-WM-28, SK-WM-29
TEST(PaperMonitor, Figure8RepairedStillClearsAgainstTheObstaclesOwnHeight) {
  Both both(PaperMerge::kFigure8Repaired, false);
  both.ground(0);
  both.paper.cell(kY, kX) = {PaperFlag::kObstacle, 0, 1700};
  both.ours.accumulated(50, 50, {SK_FLAG_OBSTACLE, 0, 1700});
  both.interpolate(0, 0, 1650);
  both.settle();
  EXPECT_EQ(both.paper_flag(), PaperFlag::kSet) << "the difference from the obstacle's own height is small when it has not moved";
  EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE) << "not near the height before it came";
  EXPECT_TRUE(both.stop);
}

// A truck hides the person for a sweep: the line from its top over the person's cell.
// verifies: SK-WM-25, SK-WM-29
TEST(PaperMonitor, Figure7ClearsAnObstacleAfterAnInterpolatedHeightAboveIt) {
  Both both(PaperMerge::kFigure7, true);
  both.ground(0);
  both.paper.cell(kY, kX) = {PaperFlag::kObstacle, 1700, 0};
  both.ours.accumulated(50, 50, {SK_FLAG_OBSTACLE, 0, 1700});
  both.interpolate(0, 0, 2900);
  both.settle();
  both.see(0, 0, 1700);
  both.settle();
  EXPECT_EQ(both.paper_flag(), PaperFlag::kSet);
  EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
}

// The same without a person at first: the line becomes the ground, and who comes later does not rise over it.
// verifies: SK-WM-25
TEST(PaperMonitor, Figure7TakesAnInterpolatedHeightForTheGround) {
  Both both(PaperMerge::kFigure7, true);
  both.ground(0);
  both.interpolate(0, 0, 1800);
  both.settle();
  both.see(0, 0, 1700);
  both.settle();
  EXPECT_EQ(both.paper_flag(), PaperFlag::kSet);
  EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
}

// verifies: SK-WM-29
TEST(PaperMonitor, Figure7ClearsAPersonWhoLowersAnArm) {
  Both both(PaperMerge::kFigure7, true);
  both.ground(0);
  both.paper.cell(kY, kX) = {PaperFlag::kObstacle, 1700, 0};
  both.ours.accumulated(50, 50, {SK_FLAG_OBSTACLE, 0, 1700});
  for (const int height : {2300, 1700}) {
    both.see(0, 0, height);
    both.settle();
  }
  EXPECT_EQ(both.paper_flag(), PaperFlag::kSet);
  EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
  EXPECT_TRUE(both.stop);
}

// A neighbour of 1000 mm excuses a rise to 1250 mm and none to 1700 mm: who bends down is no less there.
// verifies: SK-WM-29
TEST(PaperMonitor, AnObstacleBecomesMerelyChangedByTheLetter) {
  Both both(PaperMerge::kFigure8, false);
  both.ground(0);
  both.paper.cell(kY, kX + 1) = {PaperFlag::kSet, 1000, 0};
  both.ours.accumulated(50, 51, {SK_FLAG_SET, 1000, -20000});
  both.see(0, 0, 1700);
  both.settle();
  ASSERT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
  ASSERT_EQ(both.paper_flag(), PaperFlag::kObstacle);
  both.see(0, 0, 1250);
  both.settle();
  EXPECT_EQ(both.paper_flag(), PaperFlag::kChanged);
  EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
}

// A scanner that stands still, or a lidar that turns ten times a second: the cell gets data between any two updates.
// verifies: SK-WM-10
TEST(PaperMonitor, ByTheLetterACellThatGetsDataWithoutEndIsNeverJudged) {
  Both both(PaperMerge::kFigure7, true);
  both.ground(0);
  int updates_to_stop = 0;
  for (int update = 1; update <= 100; ++update) {
    both.see(0, 0, 1700);
    both.update();
    if (both.stop && updates_to_stop == 0) updates_to_stop = update;
  }
  EXPECT_EQ(both.paper_flag(), PaperFlag::kSet);
  EXPECT_EQ(updates_to_stop, kWait / kPeriod) << "the first update when it is wait_us old";
}

// The shadow behind a heap was filled by the line over it; then the ground there is seen, and later somebody stands on it.
// verifies: SK-WM-22
TEST(PaperMonitor, Figure8KeepsAnInterpolatedHeightForGood) {
  Both both(PaperMerge::kFigure8, false);
  both.ground(0);
  both.empty(0, 0);
  both.interpolate(0, 0, 1500);
  both.settle();
  for (const int height : {0, 1700}) {
    both.see(0, 0, height);
    both.settle();
  }
  EXPECT_EQ(both.paper_flag(), PaperFlag::kSet);
  EXPECT_EQ(both.our_flag(), SK_FLAG_OBSTACLE);
}

// verifies: SK-WM-11
TEST(PaperMonitor, ByTheLetterTheFirstHeightOfACellIsComparedWithNothing) {
  Both both(PaperMerge::kFigure8, false);
  both.ground(1500);  // high ground
  both.empty(0, 0);
  both.see(0, 0, 2600);
  both.settle();
  EXPECT_EQ(both.paper_flag(), PaperFlag::kObstacle) << "with whatever height the cell began with, here 0";
  EXPECT_EQ(both.our_flag(), SK_FLAG_SET);
}

}  // namespace
}  // namespace berm::core_test
