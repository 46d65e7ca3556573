// A machine whose empty swing brakes worse than was identified, at work: the app tells of its overruns, limits the swing for it, and loads the truck.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

struct Work {
  std::vector<nlohmann::json> overruns;
  int counted = 0, passes = 0;
  Joints prediction_rms{};
  int contacts = 0;
};

Work work(const Joints& brake_share, double seconds) {
  std::FILE* file = std::tmpfile();
  Loading run(1, start_pose(), fileno(file));
  run.plant.brake_share = brake_share;
  while (!run.sequencer.finished() && run.seconds < seconds) run.step();
  Work out;
  out.counted = run.sequencer.joint_watch().overruns();
  out.prediction_rms = run.sequencer.joint_watch().prediction_rms();
  out.contacts = run.plant.findings().wall_contacts + run.plant.findings().ground_contacts;
  std::rewind(file);
  std::string line;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    const auto event = nlohmann::json::parse(line);
    if (event["event"] == "overrun") out.overruns.push_back(event);
    if (event["event"] == "pass") ++out.passes;
    line.clear();
  }
  std::fclose(file);
  return out;
}

TEST(JointWatch, AMachineAsIdentifiedOverrunsNothingAndIsForetold) {
  const Work done = work({1.0, 1.0, 1.0, 1.0}, 90.0);
  EXPECT_GE(done.passes, 3);
  EXPECT_EQ(done.counted, 0) << (done.overruns.empty() ? "" : done.overruns.front().dump());
  EXPECT_LT(done.prediction_rms[swing], radians(0.2));
  EXPECT_GT(done.prediction_rms[swing], 0.0);
}

TEST(JointWatch, AWeakSwingBrakeIsToldAndLimited) {
  const Work done = work({0.4, 1.0, 1.0, 1.0}, 150.0);
  EXPECT_GE(done.passes, 4);
  ASSERT_FALSE(done.overruns.empty()) << "nothing overran: the test shows nothing";
  EXPECT_EQ(done.counted, static_cast<int>(done.overruns.size()));
  for (const auto& event : done.overruns) {
    EXPECT_EQ(event["joint"], "swing");
    EXPECT_TRUE(event["over_goal_deg"] > 2.0 || event["over_model_deg"] > 1.5) << event.dump();
    EXPECT_LT(event["pace"], 1.0);
  }
  bool full = false;
  for (const auto& event : done.overruns) full = full || event["loaded"] == true;
  EXPECT_TRUE(full) << "a full bucket's swing overran, though the bucket was empty when it stood";
  // Both loads and directions have overrun once by 40 s. Later it is let go faster again, little by little, until a landing shows it anew.
  int later = 0;
  for (const auto& event : done.overruns) {
    if (event["time_s"] < 40.0) continue;
    ++later;
    EXPECT_LT(event["over_goal_deg"], 1.0) << event.dump();
    EXPECT_LT(event["over_model_deg"], 4.0) << event.dump();
  }
  EXPECT_LE(later, 4);
  EXPECT_EQ(done.contacts, 0);
}

}  // namespace
