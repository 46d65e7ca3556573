// The recogniser in its thread: the same answers, in lockstep in a fixed cycle.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "drawn_bed.hpp"
#include "app/recognition_thread.hpp"

namespace {

using namespace berm::app;

TruckRangeSet ranges() { return read_truck_ranges(BERM_CONFIG_DIR "/truck_classes.toml"); }

TEST(RecognitionThread, AnswersInLockstepInAFixedCycleAndAsTheRecogniserDoes) {
  const std::vector<ScanPoint> sweep = sweep_of({});
  const RecognisedTruck direct = recognise_truck(sweep, drawn_viewpoint, ranges());
  ASSERT_TRUE(direct.found) << direct.reason;
  for (int run = 0; run < 2; ++run) {
    RecognitionThread finder(ranges(), 20);
    EXPECT_FALSE(finder.answer(5)) << "nothing was asked";
    finder.ask(sweep, drawn_viewpoint, 100);
    for (std::uint64_t cycle = 100; cycle < 120; ++cycle) ASSERT_FALSE(finder.answer(cycle)) << cycle;
    const auto answer = finder.answer(120);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->length, direct.length);
    EXPECT_EQ(answer->pose.middle, direct.pose.middle);
    EXPECT_FALSE(finder.answer(121)) << "once";
  }
}

TEST(RecognitionThread, AnswersInRealTimeWhenItIsDone) {
  RecognitionThread finder(ranges(), 0);
  finder.ask(sweep_of({}), drawn_viewpoint, 1);
  std::optional<RecognisedTruck> answer;
  std::uint64_t cycle = 1;
  for (; !answer && cycle < 2000; ++cycle) {
    answer = finder.answer(cycle);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->found);
}

TEST(RecognitionThread, ANewerQuestionReplacesAnOpenOne) {
  RecognitionThread finder(ranges(), 10);
  finder.ask(sweep_of({}), drawn_viewpoint, 1);
  finder.ask({}, drawn_viewpoint, 2);
  EXPECT_FALSE(finder.answer(11));
  const auto answer = finder.answer(12);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->found);
  EXPECT_FALSE(finder.answer(13));
}

TEST(RecognitionThread, EndsWithAQuestionOpen) {
  RecognitionThread finder(ranges(), 10);
  finder.ask(sweep_of({}), drawn_viewpoint, 1);
}

}  // namespace
