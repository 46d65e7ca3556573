// The kernel's command line.
#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

#include "io/options.hpp"

namespace berm::kernel {
namespace {

struct Parsed {
  OptionsResult result;
  Options options;
  std::string error;
};

Parsed parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "berm_kernel");
  Parsed p;
  p.result = parse_options(static_cast<int>(arguments.size()), arguments.data(), p.options, p.error);
  return p;
}

// verifies: SK-CY-91
TEST(KernelOptions, TakesWhatTheLauncherGives) {
  const Parsed p = parse({"--parameters", "p", "--can", "udp:239.255.66.1:4000", "--scan-port", "5000", "--socket", "s", "--lockstep", "--app-uid", "64601",
                          "--recorder-uid", "0", "--ready-fd", "10", "--vlp16-mount", "1,-2.5,1.8,90", "--lidar-port", "2370", "--lidar-port", "2371"});
  ASSERT_EQ(p.result, OptionsResult::kRun) << p.error;
  EXPECT_TRUE(p.options.lockstep);
  EXPECT_EQ(p.options.scan_port, 5000);
  EXPECT_EQ(p.options.app_uid, 64601U);
  ASSERT_EQ(p.options.lidar_ports, 2);
  EXPECT_EQ(p.options.lidar_port[1], 2371);
  EXPECT_EQ(p.options.recorder_uid, 0U);
  EXPECT_EQ(p.options.ready_fd, 10);
  EXPECT_DOUBLE_EQ(p.options.vlp16_mount.y_m, -2.5);
  EXPECT_NEAR(p.options.vlp16_mount.yaw_rad, 1.5707963, 1e-6);
}

// verifies: SK-CY-91
TEST(KernelOptions, MapOnlyNeedsNoMachine) {
  const Parsed p = parse({"--parameters", "p", "--socket", "s", "--map-only", "--vlp16-port", "2368"});
  ASSERT_EQ(p.result, OptionsResult::kRun) << p.error;
  EXPECT_EQ(p.options.vlp16_port, 2368);
  EXPECT_EQ(p.options.app_uid, geteuid());
}

// verifies: SK-CY-55
TEST(KernelOptions, AFixedVlp16GoesWithNoMachine) {
  for (const bool lockstep : {false, true}) {
    std::vector<const char*> arguments = {"--parameters", "p", "--can", "x", "--socket", "s", "--scan-port", "1"};
    if (lockstep) arguments.push_back("--lockstep");
    ASSERT_EQ(parse(arguments).result, OptionsResult::kRun);
    arguments.insert(arguments.end(), {"--vlp16-port", "2"});
    const Parsed p = parse(arguments);
    EXPECT_EQ(p.result, OptionsResult::kError);
    EXPECT_NE(p.error.find("--vlp16-port goes with --map-only alone"), std::string::npos) << p.error;
  }
}

// verifies: SK-CY-91
TEST(KernelOptions, BadOnesAreNamed) {
  const std::pair<std::vector<const char*>, const char*> bad[] = {
      {{"--parameters", "p", "--can", "x", "--socket", "s"}, "--scan-port"},
      {{"--can", "x", "--socket", "s", "--scan-port", "1"}, "--parameters"},
      {{"--scan-port", "65536"}, "--scan-port"},
      {{"--scan-port", "12x"}, "--scan-port"},
      {{"--scan-port"}, "--scan-port"},
      {{"--lidar-port", "0"}, "--lidar-port"},
      {{"--lidar-port", "1", "--lidar-port", "2", "--lidar-port", "3", "--lidar-port", "4", "--lidar-port", "5"}, "--lidar-port"},
      {{"--app-uid", "-1"}, "--app-uid"},
      {{"--ready-fd", "5000"}, "--ready-fd"},
      {{"--vlp16-mount", "1,2,3"}, "--vlp16-mount"},
      {{"--vlp16-mount", "1,2,31,0"}, "--vlp16-mount"},
      {{"--vlp16-mount", "1,2,nan,0"}, "--vlp16-mount"},
      {{"--frobnicate"}, "--frobnicate"},
      {{"--parameters", "p", "--socket", "s", "--vlp16-port", "1", "--map-only", "--lockstep"}, "--lockstep"},
  };
  for (const auto& [arguments, named] : bad) {
    const Parsed p = parse(arguments);
    EXPECT_EQ(p.result, OptionsResult::kError) << named;
    EXPECT_NE(p.error.find(named), std::string::npos) << p.error;
    EXPECT_EQ(p.error.find('\n'), std::string::npos);
  }
  EXPECT_EQ(parse({"--help"}).result, OptionsResult::kHelp);
}

}  // namespace
}  // namespace berm::kernel
