// The recogniser in its thread: the same answers, in lockstep in a fixed cycle.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "drawn_bed.hpp"
#include "app/recognition_thread.hpp"
#include "recognition/ongoing_recognition.hpp"

namespace {

using namespace berm::app;

TruckRangeSet ranges() { return read_truck_ranges(BERM_CONFIG_DIR "/truck_classes.toml"); }

constexpr std::uint64_t cycles_between = 4;  // scanlines

// Tells the sweep from this cycle on, asking for an answer in every cycle; the cycle of the answer, 0 without one before its end.
std::uint64_t tell(RecognitionThread& finder, const std::vector<ScanPoint>& sweep, std::uint64_t cycle, std::optional<RecognisedTruck>& answer) {
  finder.begin(drawn_viewpoint);
  std::uint64_t answered = 0;
  visit_scanlines(sweep, [&](std::span<const ScanPoint> scanline) {
    if (answer) return;
    finder.take({scanline.begin(), scanline.end()}, 0.0, cycle);
    for (std::uint64_t k = 0; k < cycles_between && !answer; ++k, ++cycle)
      if ((answer = finder.answer(cycle))) answered = cycle;
  });
  return answered;
}

// A question in each scanline's cycle, which takes no time at all.
struct Direct {
  RecognisedTruck truck;
  std::uint64_t asked = 0;
};
Direct direct(const std::vector<ScanPoint>& sweep, std::uint64_t cycle) {
  const TruckRangeSet classes = ranges();
  OngoingRecognition recognition(drawn_viewpoint, classes);
  Direct out;
  visit_scanlines(sweep, [&](std::span<const ScanPoint> scanline) {
    if (out.asked == 0 && recognition.take(scanline) && (recognition.ask(), recognition.stands())) out = {recognition.ask(), cycle};
    cycle += cycles_between;
  });
  return out;
}

TEST(RecognitionThread, AnswersInLockstepInAFixedCycleAfterTheScanlineWithWhichTheAnswerStands) {
  const std::vector<ScanPoint> sweep = sweep_of({});
  const Direct expected = direct(sweep, 100);
  ASSERT_GT(expected.asked, 100u) << "it stands before the sweep's end";
  for (int run = 0; run < 2; ++run) {
    RecognitionThread finder(ranges(), 5);
    EXPECT_FALSE(finder.answer(5)) << "nothing was told";
    std::optional<RecognisedTruck> answer;
    EXPECT_EQ(tell(finder, sweep, 100, answer), expected.asked + 5);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->length, expected.truck.length);
    EXPECT_EQ(answer->pose.middle, expected.truck.pose.middle);
    finder.end(1000);
    EXPECT_FALSE(finder.answer(2000)) << "once";
  }
}

TEST(RecognitionThread, WithoutAnAnswerThatStandsTheEndIsTheLastQuestion) {
  DrawnBed lid;
  lid.lid = true;
  const std::vector<ScanPoint> sweep = sweep_of(lid);
  const RecognisedTruck whole = recognise_truck(sweep, drawn_viewpoint, ranges());
  ASSERT_FALSE(whole.found);
  RecognitionThread finder(ranges(), 5);
  std::optional<RecognisedTruck> answer;
  EXPECT_EQ(tell(finder, sweep, 100, answer), 0u);
  finder.end(1000);
  for (std::uint64_t cycle = 1000; cycle < 1005; ++cycle) ASSERT_FALSE(finder.answer(cycle)) << cycle;
  answer = finder.answer(1005);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->found);
  EXPECT_EQ(answer->reason, whole.reason);
  EXPECT_FALSE(finder.answer(1006)) << "once";
}

TEST(RecognitionThread, AnswersInRealTimeWhenItIsDone) {
  RecognitionThread finder(ranges(), 0);
  std::optional<RecognisedTruck> answer;
  tell(finder, sweep_of({}), 1, answer);
  finder.end(1000);
  for (int wait = 0; !answer && wait < 2000; ++wait) {
    answer = finder.answer(1000);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->found);
}

TEST(RecognitionThread, ANewerSweepReplacesOneThatGoesOn) {
  RecognitionThread finder(ranges(), 10);
  const std::vector<ScanPoint> sweep = sweep_of({});
  finder.begin(drawn_viewpoint);
  visit_scanlines(sweep, [&](std::span<const ScanPoint> scanline) { finder.take({scanline.begin(), scanline.end()}, 0.0, 1); });
  finder.end(1);
  finder.begin(drawn_viewpoint);
  finder.end(2);
  EXPECT_FALSE(finder.answer(11));
  const auto answer = finder.answer(12);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->found) << "of a sweep without a scanline";
  EXPECT_FALSE(finder.answer(13));
}

TEST(RecognitionThread, EndsWithAQuestionOpen) {
  RecognitionThread finder(ranges(), 10);
  finder.begin(drawn_viewpoint);
  const std::vector<ScanPoint> sweep = sweep_of({});
  visit_scanlines(sweep, [&](std::span<const ScanPoint> scanline) { finder.take({scanline.begin(), scanline.end()}, 0.0, 1); });
  finder.end(1);
}

}  // namespace
