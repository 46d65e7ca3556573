// Looking for the truck: from where it is seen whole, until there is one that can be loaded.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app_bench/loading.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using app_bench::Loading;
using app_bench::start_pose;

bool moves(const Answer& answer) { return std::any_of(answer.velocity.begin(), answer.velocity.end(), [](double v) { return v != 0.0; }); }

// The app's events, as a reader of its standard output has them.
class Events {
public:
  Events() {
    int pair[2];
    EXPECT_EQ(::pipe(pair), 0);
    read_ = pair[0], write_ = pair[1];
  }
  ~Events() { ::close(read_), ::close(write_); }
  Events(const Events&) = delete;
  Events& operator=(const Events&) = delete;
  int fd() const { return write_; }
  std::vector<nlohmann::json> named(const std::string& name) {
    char buffer[65536];
    ::write(write_, "\n", 1);  // never empty
    const ssize_t n = ::read(read_, buffer, sizeof buffer);
    std::istringstream lines(std::string(buffer, static_cast<std::size_t>(std::max<ssize_t>(n, 0))));
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) all_.push_back(nlohmann::json::parse(line));
    std::vector<nlohmann::json> out;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(out), [&](const nlohmann::json& e) { return e.at("event") == name; });
    return out;
  }

private:
  int read_ = -1, write_ = -1;
  std::vector<nlohmann::json> all_;
};

TEST(TruckLook, AsksWithOneSweepOverTheWholePlaceFromWhereTheMachineStands) {
  Loading run(1, start_pose());
  while (run.finder.asked.empty() && run.seconds < 60.0) run.step();
  ASSERT_EQ(run.finder.asked.size(), 1u);
  const auto& asked = run.finder.asked.front();
  const ScannerMount& mount = run.machine.scanner[0];
  const double swing_angle = run.plant.angle()[swing];
  EXPECT_NEAR(asked.viewpoint[0], mount.x * std::cos(swing_angle) - mount.y * std::sin(swing_angle), 0.01);
  EXPECT_NEAR(asked.viewpoint[1], mount.x * std::sin(swing_angle) + mount.y * std::cos(swing_angle), 0.01);
  EXPECT_NEAR(asked.viewpoint[2], mount.z, 1e-9);
  EXPECT_NEAR(swing_angle, radians(36.0), radians(3.0)) << "60 degrees before the truck's bearing";
  // Bearings from the head: well beyond both ends of the bed.
  double low = 1e9, high = -1e9;
  for (const ScanPoint& p : asked.points) {
    if (static_cast<double>(p.y) < asked.viewpoint[1] + 2.0) continue;
    const double b = std::atan2(static_cast<double>(p.y) - asked.viewpoint[1], static_cast<double>(p.x) - asked.viewpoint[0]);
    low = std::min(low, b), high = std::max(high, b);
  }
  const TruckBed bed = app_bench::bench_bed();
  for (const double u : {-0.5, 0.5})
    for (const double v : {-0.5, 0.5}) {
      const double b = std::atan2(bed.centre_y + v * bed.width - asked.viewpoint[1], bed.centre_x + u * bed.length - asked.viewpoint[0]);
      EXPECT_GT(b, low + radians(5.0));
      EXPECT_LT(b, high - radians(5.0));
    }
  EXPECT_FALSE(moves(run.last));
}

TEST(TruckLook, WithoutATruckItLooksAgainTellsTheOperatorAndDoesNotDig) {
  Events events;
  Loading run(1, start_pose(), events.fd());
  run.finder.truck = {};
  run.finder.truck.reason = "the sweep shows no upright wall";
  while (run.seconds < 75.0) {
    run.step();
    ASSERT_NE(run.last.phase, BERM_PHASE_DIG);
  }
  EXPECT_GE(run.finder.asked.size(), 4u);
  const auto none = events.named("no_truck"), operators = events.named("operator_needed");
  EXPECT_EQ(none.size(), run.finder.asked.size());
  EXPECT_EQ(none.front().at("reason"), "the sweep shows no upright wall");
  ASSERT_EQ(operators.size(), 1u) << "once";
  EXPECT_EQ(operators.front().at("reason"), "no_truck");
  EXPECT_NE(operators.front().at("advice").get<std::string>().find("truck"), std::string::npos);
  EXPECT_FALSE(moves(run.last));
  run.finder.truck = app_bench::bench_truck();
  const double parked = run.seconds;
  while (run.last.phase != BERM_PHASE_DIG && run.seconds < parked + 60.0) run.step();
  EXPECT_EQ(run.last.phase, BERM_PHASE_DIG) << "there is one now";
  EXPECT_EQ(events.named("recognised").size(), 1u);
}

// The kernel lets nothing pass over a truck that stands elsewhere.
TEST(TruckLook, ATruckOutsideTheTruckZoneIsNotLoaded) {
  Events events;
  Loading run(1, start_pose(), events.fd());
  run.finder.truck.pose.middle.x() += 6.0;
  while (run.seconds < 45.0) {
    run.step();
    ASSERT_NE(run.last.phase, BERM_PHASE_DIG);
  }
  ASSERT_FALSE(events.named("truck_misplaced").empty());
  EXPECT_NEAR(events.named("truck_misplaced").front().at("x_m").get<double>(), 5.3, 1e-9);
  EXPECT_TRUE(events.named("recognised").empty());
}

TEST(TruckLook, ATruckThatLeavesMeanwhileIsNotLookedForAnyLonger) {
  Loading run(1, start_pose());
  run.finder.truck = {};
  while (run.finder.asked.empty() && run.seconds < 60.0) run.step();
  run.plant.truck_parked = false;
  const std::size_t asked = run.finder.asked.size();
  for (int k = 0; k < 2000; ++k) run.step();
  EXPECT_EQ(run.finder.asked.size(), asked);
  EXPECT_FALSE(moves(run.last));
}

TEST(TruckLook, AStopInTheLookBeginsItAnew) {
  Loading run(1, start_pose());
  while (run.plant.angle()[swing] < radians(30.0) && run.seconds < 60.0) run.step();
  while (std::fabs(run.plant.state().joint_velocity_urad_s[0]) > 20000 && run.seconds < 60.0) run.step();
  for (int k = 0; k < 150; ++k) run.step();  // the sweep is under way
  ASSERT_TRUE(run.finder.asked.empty());
  run.plant.kernel_runs = false;
  for (int k = 0; k < 300; ++k) run.step();
  EXPECT_TRUE(run.finder.asked.empty()) << "half a sweep tells nothing";
  run.plant.kernel_runs = true;
  const double resumed = run.seconds;
  while (run.finder.asked.empty() && run.seconds < resumed + 40.0) run.step();
  EXPECT_EQ(run.finder.asked.size(), 1u);
}

}  // namespace
