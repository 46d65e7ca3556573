// Whole runs of the plant in lockstep with a played kernel and app.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "contract/berm_contract.h"
#include "fake_peers.hpp"
#include "plant/process/plant_run.hpp"
#include "scratch.hpp"

namespace berm::plant::testing {
namespace {

constexpr std::array<std::int32_t, 4> kSwing{500000, 0, 0, 0};

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Result { std::string folder, trace; nlohmann::json truth; };

Result run(const std::string& name, std::uint64_t seed, const std::function<Answer(std::uint32_t)>& policy,
           const Scenario& scenario = load_scenario(BERM_SCENARIOS "/bench.toml", BERM_PLANT_PROFILES), std::array<double, 2> pause_kernel_s = {}) {
  FakePeers peers(test_can_address(), policy);
  RunOptions options;
  options.seed = seed;
  options.pause_kernel_s = pause_kernel_s;
  options.can_address = test_can_address();
  options.scan_port = 9;  // nobody listens
  const test::Scratch scratch;
  options.out = scratch.path(name);
  options.peers.tick = peers.tick_fd;
  options.peers.kernel = peers.kernel_fd;
  PlantRun(scenario, load_plant_profile(scenario.machine_file), options).run();
  Result r{options.out, text_of(options.out + "/trace.csv"), nlohmann::json::parse(text_of(options.out + "/truth.json"))};
  EXPECT_FALSE(std::filesystem::exists(options.out + "/trace.csv.part"));
  EXPECT_TRUE(std::filesystem::exists(options.out + "/terrain_start.csv"));
  EXPECT_TRUE(std::filesystem::exists(options.out + "/terrain_end.csv"));
  return r;
}

// Columns of a row of the trace by number; row 0 is the header.
std::vector<std::string> row(const std::string& trace, std::size_t number) {
  std::istringstream lines(trace);
  std::string line;
  for (std::size_t i = 0; i <= number; ++i) std::getline(lines, line);
  std::istringstream fields(line);
  std::vector<std::string> out;
  for (std::string f; std::getline(fields, f, ',');) out.push_back(f);
  return out;
}

Answer swing_then_finish(std::uint32_t cycle) {
  Answer a;
  if (cycle > 50 && cycle < 200) a.velocity_urad_s = kSwing;
  a.finished = cycle >= 300;
  return a;
}

TEST(Lockstep, SameSeedSameBytesOtherSeedOtherBytes) {
  const Result a = run("a", 7, swing_then_finish), b = run("b", 7, swing_then_finish), c = run("c", 8, swing_then_finish);
  EXPECT_EQ(a.trace, b.trace);
  EXPECT_EQ(a.truth, b.truth);
  EXPECT_NE(a.trace, c.trace);
}

TEST(Lockstep, FinishedRunEndsOneSecondLaterAndMovedAsCommanded) {
  const Result r = run("finish", 1, swing_then_finish);
  EXPECT_EQ(r.truth.at("end_reason"), "finished");
  EXPECT_EQ(r.truth.at("simulated_seconds"), 4.0);
  EXPECT_EQ(r.truth.at("refused_frames"), 0);
  EXPECT_TRUE(r.truth.at("fault").is_null());
  EXPECT_EQ(row(r.trace, 0)[1], "swing_rad");
  EXPECT_EQ(row(r.trace, 50)[0], "0.500000");
  EXPECT_EQ(row(r.trace, 50)[1], "0.000000");
  EXPECT_GT(std::stod(row(r.trace, 400)[1]), 0.3);
  EXPECT_EQ(row(r.trace, 400)[5], "0.000000");
}

TEST(Lockstep, DeadKernelIsAStop) {
  const Result r = run("kernel", 1, [](std::uint32_t cycle) {
    Answer a;
    a.velocity_urad_s = kSwing;
    a.kernel_dies = cycle == 200;
    return a;
  });
  EXPECT_EQ(r.truth.at("end_reason"), "kernel gone");
  EXPECT_EQ(r.truth.at("fault"), "kernel gone");
  const double fault = r.truth.at("fault_s"), still = r.truth.at("first_standstill_after_fault_s");
  EXPECT_NEAR(fault, 2.00, 0.02);
  EXPECT_GT(std::stod(row(r.trace, 200)[5]), 0.4) << "it was moving";
  EXPECT_GT(still, fault + 0.05);
  EXPECT_LT(still, fault + 0.05 + 2.0);
  EXPECT_NEAR(r.truth.at("simulated_seconds"), still + 2.0, 0.05);
}

// Nobody is waited for meanwhile, though the fake's app and kernel say nothing; the machine brakes by itself when it has heard nothing for 50 ms.
TEST(Lockstep, AKernelThatIsHeldUpBeginsNoCycle) {
  std::vector<std::uint32_t> cycles;
  const Result r = run("held_up", 1, [&](std::uint32_t cycle) {
    cycles.push_back(cycle);
    return swing_then_finish(cycle);
  }, load_scenario(BERM_SCENARIOS "/bench.toml", BERM_PLANT_PROFILES), {1.5, 0.2});
  EXPECT_TRUE(r.truth.at("fault").is_null()) << "a peer was waited for until it was absent: " << r.truth.at("fault");
  const auto after = std::find(cycles.begin(), cycles.end(), 170U);
  ASSERT_TRUE(after != cycles.end() && after != cycles.begin());
  EXPECT_EQ(*(after - 1), 149U);
  EXPECT_EQ(cycles.size(), 400U - 20U);
  EXPECT_EQ(r.truth.at("end_reason"), "finished");
  EXPECT_EQ(r.truth.at("simulated_seconds"), 4.0);
  const auto speed = [&](std::size_t cycle) { return std::stod(row(r.trace, cycle)[5]); };
  EXPECT_NEAR(speed(153), speed(149), 0.03);
  EXPECT_LT(speed(170), speed(155) - 0.05);
  EXPECT_GT(speed(199), speed(175)) << "heard again, it goes on as commanded";
}

TEST(Lockstep, DeadAppEndsTheRunAtStandstill) {
  const Result r = run("app", 1, [](std::uint32_t cycle) {
    Answer a;
    a.enable = cycle <= 200;
    a.velocity_urad_s = kSwing;
    a.app_dies = cycle == 150;
    return a;
  });
  EXPECT_EQ(r.truth.at("end_reason"), "app gone");
  EXPECT_NEAR(r.truth.at("fault_s"), 1.5, 0.02);
  EXPECT_GT(r.truth.at("first_standstill_after_fault_s"), 2.0);
}

// The kernel lets nothing move for the ground's sake, and the operator's press does not help.
TEST(Lockstep, AnOperatorLiftsTheImplementsByHand) {
  Scenario scenario = load_scenario(BERM_SCENARIOS "/shift.toml", BERM_PLANT_PROFILES);
  scenario.operator_config->resets_after_s = {1.0, 2.0};
  scenario.start.angle[1] = 0.3;
  const Result r = run("by_hand", 1, [](std::uint32_t cycle) {
    Answer a;
    a.enable = false;
    a.stop_reason = BERM_STOP_UNKNOWN_GROUND;
    a.velocity_urad_s = kSwing;
    a.finished = cycle >= 2000;
    return a;
  }, scenario);
  const auto& lifts = r.truth.at("hand_lifts");
  ASSERT_EQ(lifts.size(), 1U);
  const double from = lifts[0].at("from_s"), to = lifts[0].at("to_s");
  EXPECT_GT(r.truth.at("operator_presses").size(), 1U);
  const auto at = [&](double t) { return row(r.trace, static_cast<std::size_t>(std::lround(t * 100))); };
  EXPECT_DOUBLE_EQ(std::stod(at(from)[2]), 0.3) << "the kernel enabled nothing";
  EXPECT_GT(std::stod(at(to)[2]), 0.4);
  EXPECT_NEAR(std::stod(at(to)[1]), 0.0, 1e-6) << "what the bus asks for moves nothing";
  EXPECT_EQ(std::stod(at(to)[6]), 0.0) << "the boom stands when he lets go";
  const auto& disturbed = r.truth.at("disturbances");
  EXPECT_TRUE(std::any_of(disturbed.begin(), disturbed.end(), [&](const auto& d) { return d.at("what") == "levers" && d.at("from_s") == from; })) << disturbed;
}

}  // namespace
}  // namespace berm::plant::testing
