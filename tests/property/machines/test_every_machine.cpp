// Every machine file: the kernel takes its parameters with every site, the app's kinematics and the plant's agree, and the app's reach preview covers
// the kernel's reach box and little more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "app/machine_loader.hpp"
#include "config/compile_parameters.hpp"
#include "core/parameter_check.h"
#include "geometry/reach.hpp"
#include "motion/arm_kinematics.hpp"
#include "motion/reach_preview.hpp"
#include "plant/machine/kinematics.hpp"
#include "plant/machine/plant_profile.hpp"

namespace {

namespace fs = std::filesystem;
using namespace berm;

constexpr std::uint64_t seed = 2026;

std::vector<fs::path> files(const char* folder) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(fs::path(BERM_CONFIG_DIR) / folder)) out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

class EveryMachine : public testing::TestWithParam<fs::path> {
protected:
  std::mt19937_64 random{seed};
  config::MachineFile file = config::load_machine_file(GetParam().string());
  double drawn(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  app::Joints drawn_pose() {
    app::Joints q{};
    for (std::size_t j = 0; j < app::joints; ++j) q[j] = drawn(file.joint[j].low, file.joint[j].high);
    return q;
  }
};

// verifies: IF-CF-7, IF-CF-22
TEST_P(EveryMachine, PassesTheKernelsCheckWithEverySiteWhateverItsBucketHolds) {
  for (const fs::path& site : files("sites")) {
    const berm_parameters p = config::compile_parameters(file, config::load_site_file(site.string()));
    EXPECT_EQ(sk_parameters_check(&p), SK_RULE_NONE) << site;
    config::MachineFile other = file;
    other.bucket_payload += 100.0;
    EXPECT_EQ(config::compile_parameters(other, config::load_site_file(site.string())).crc32, p.crc32);
  }
}

TEST_P(EveryMachine, StandsWhereThePlantHasItByTheAppsKinematics) {
  const plant::PlantProfile profile = plant::load_plant_profile(std::string(BERM_PLANT_PROFILES "/") + GetParam().stem().string() + "_plant.toml");
  const app::MachineModel model = app::machine_model(file);
  for (int i = 0; i < 500; ++i) {
    const app::Joints q = drawn_pose();
    plant::JointState state;
    state.angle = {q[0], q[1], q[2], q[3]};
    const plant::ImplementPose truth = plant::implement_pose(profile.shape, state);
    const app::ArmPoints own = app::forward(model, q);
    EXPECT_NEAR(own.bucket_pin.r, truth.bucket.origin.r, 1e-9);
    EXPECT_NEAR(own.tip.r, truth.tip.r, 1e-9);
    EXPECT_NEAR(own.tip.z, truth.tip.z, 1e-9);
  }
  EXPECT_LE(model.bucket_payload_kg, profile.shape.bucket_payload_max_kg);
}

// Nor does it lie beyond the box of a kernel whose machine hears nothing for 50 ms: what it takes too long for a stop is time in every pass.
TEST_P(EveryMachine, PreviewsTheReachBoxOfTheKernel) {
  constexpr double rounding = 1e-5;  // rad: the kernel counts in whole microradians, and rounds outward
  const app::MachineModel model = app::machine_model(file);
  const berm_parameters p = config::compile_parameters(file, config::load_site_file((fs::path(BERM_CONFIG_DIR) / "sites/bench.toml").string()));
  berm_parameters silent = p;
  silent.cycle_us = static_cast<std::int32_t>(std::lround((app::heartbeat_silence + app::kernel_sends_within) * 1e6));
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const app::Joints q = drawn_pose();
    app::Joints v{};
    for (std::size_t j = 0; j < app::joints; ++j) v[j] = drawn(-file.joint[j].velocity_max, file.joint[j].velocity_max);
    sk_reach_box box{}, silent_box{};
    const auto reach = [&](const berm_parameters& of, sk_reach_box& into, int j, std::int32_t row) {
      return sk_reach_joint(&of, j, row, static_cast<std::int32_t>(std::lround(q[static_cast<std::size_t>(j)] * 1e6)),
                            static_cast<std::int32_t>(std::lround(v[static_cast<std::size_t>(j)] * 1e6)), SK_REACH_ANY, 0, 0, &into);
    };
    bool fits = true;
    for (int j = 1; j < SK_JOINTS; ++j) fits = fits && reach(p, box, j, BERM_BRAKE_REACHES - 1) && reach(silent, silent_box, j, BERM_BRAKE_REACHES - 1);
    if (!fits) continue;
    const std::int32_t row = sk_brake_row(&p, kernel::max_reach_mm(p, box));
    if (row < 0 || !reach(p, box, 0, row)) continue;
    const app::ReachIntervals own = app::preview(model, q, v);
    const std::int32_t own_row = sk_brake_row(&p, static_cast<std::int32_t>(std::ceil(own.reach * 1e3)));
    if (own_row < 0 || !reach(silent, silent_box, 0, own_row)) continue;
    ++compared;
    for (std::size_t j = 0; j < app::joints; ++j) {
      EXPECT_LE(own.low[j], box.low_urad[j] * 1e-6 + rounding) << "joint " << j << " draw " << i;
      EXPECT_GE(own.high[j], box.high_urad[j] * 1e-6 - rounding) << "joint " << j << " draw " << i;
      EXPECT_GE(own.low[j], silent_box.low_urad[j] * 1e-6 - rounding) << "joint " << j << " draw " << i;
      EXPECT_LE(own.high[j], silent_box.high_urad[j] * 1e-6 + rounding) << "joint " << j << " draw " << i;
    }
  }
  EXPECT_GT(compared, 1000);
}

INSTANTIATE_TEST_SUITE_P(Machines, EveryMachine, testing::ValuesIn(files("machines")), [](const auto& it) { return it.param.stem().string(); });

}  // namespace
