// The kernel's process in lockstep with a miniature machine: starts, stops, refuses, and says what it counted.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <thread>
#include <vector>

#include "kernel_process.hpp"
#include "scan/scan_packet.h"
#include "scratch.hpp"

namespace berm::test {
namespace {

constexpr int kStartLimit = 400;
constexpr int kTimedOut = 124;  // what timeout(1) ends with
constexpr std::int32_t kStill[4] = {};
constexpr std::int32_t kBoomUp[4] = {0, 50000, 0, 0};

class KernelLockstep : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(kernel.started());
    app = std::make_unique<Peer>(kernel.socket_path(), BERM_ROLE_APP);
    ASSERT_TRUE(kernel.step());
    ASSERT_TRUE(app->receive_welcome());
    ASSERT_EQ(app->welcome().accepted, 1U) << app->welcome().reason;
  }
  const berm_heartbeat& heartbeat() const { return kernel.machine->heartbeat(); }
  void run() {
    for (int i = 0; i < kStartLimit && heartbeat().kernel_state != BERM_STATE_RUN; ++i) ASSERT_TRUE(kernel.step_with(*app, kStill));
    ASSERT_EQ(heartbeat().kernel_state, BERM_STATE_RUN) << "reason " << int(heartbeat().stop_reason);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) ASSERT_TRUE(kernel.step());
  }
  bool commands_motion() const {
    // the field's step; neutral is exact
    for (const auto v : kernel.machine->velocity_command().velocity_urad_s)
      if (v != 0) return true;
    return false;
  }

  KernelProcess kernel;
  std::unique_ptr<Peer> app;
};

// verifies: SK-CY-1, SK-CY-2
TEST_F(KernelLockstep, ReachesStandbyThenRunAndMovesTheBoom) {
  bool standby = false;
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(kernel.step());
    standby = standby || heartbeat().kernel_state == BERM_STATE_STANDBY;
    EXPECT_FALSE(heartbeat().enable);
  }
  EXPECT_TRUE(standby);
  run();
  const double before = kernel.machine->angle_rad[1];
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(kernel.step_with(*app, kBoomUp));
  EXPECT_GT(kernel.machine->angle_rad[1], before + 0.01);
  EXPECT_EQ(app->state()->state.kernel_state, BERM_STATE_RUN);
  EXPECT_EQ(app->state()->magic, BERM_CONTRACT_MAGIC);
  EXPECT_GT(app->state()->scan_head, 100U);
  EXPECT_EQ(app->state()->decision_head, kernel.machine->cycle());
  const std::string report = kernel.end();
  EXPECT_EQ(json_number(report, "frames_rejected"), 0) << report;
  EXPECT_EQ(json_number(report, "scan_rejected"), 0);
  EXPECT_EQ(json_number(report, "cycles"), static_cast<long>(kernel.machine->cycle()));
  std::printf("%s", report.c_str());
}

// verifies: SK-CY-10, IF-CT-13
TEST_F(KernelLockstep, AppSilenceIsHeldWithinFiftyMillisecondsAndLatchedWithinFiveHundred) {
  run();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(kernel.step_with(*app, kBoomUp));
  ASSERT_TRUE(commands_motion());
  steps(1);  // reads the last request
  steps(5);
  EXPECT_FALSE(commands_motion());
  EXPECT_EQ(heartbeat().stop_reason, BERM_STOP_REQUEST_HOLD);
  steps(45);
  EXPECT_EQ(heartbeat().stop_reason, BERM_STOP_APP_SILENT);
  EXPECT_FALSE(heartbeat().enable);
}

// verifies: SK-CY-11
TEST_F(KernelLockstep, AHungUpAppIsASilentApp) {
  run();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(kernel.step_with(*app, kBoomUp));
  app.reset();
  steps(6);
  EXPECT_FALSE(commands_motion());
  steps(45);
  EXPECT_EQ(heartbeat().stop_reason, BERM_STOP_APP_SILENT);
}

// verifies: SK-CY-12
TEST_F(KernelLockstep, LostStateFramesAreAFault) {
  run();
  kernel.machine->joints_silent = true;
  steps(6);
  EXPECT_EQ(heartbeat().stop_reason, BERM_STOP_STATE_FRAME);
  EXPECT_FALSE(commands_motion());
  steps(300);
  EXPECT_EQ(heartbeat().kernel_state, BERM_STATE_FAULT);
  EXPECT_FALSE(heartbeat().enable);
}

// verifies: SK-CY-13
TEST_F(KernelLockstep, EmergencyStopIsCategoryZero) {
  run();
  kernel.machine->estop_pressed = true;
  steps(5);
  EXPECT_EQ(heartbeat().stop_reason, BERM_STOP_EMERGENCY);
  EXPECT_EQ(heartbeat().stop_category, 0);
  EXPECT_FALSE(heartbeat().enable);
}

// verifies: SK-CY-80
TEST_F(KernelLockstep, WrongLengthAndUnguardedFramesAreRefusedAndCounted) {
  run();
  const berm_front_angle far{{3000000, 0, 0, 0}};
  berm_can_frame unguarded = berm_encode_front_angle(&far);
  kernel.extra_frames.push_back(unguarded);
  berm_can_frame shorter = unguarded;
  shorter.length = 5;
  kernel.extra_frames.push_back(shorter);
  ASSERT_TRUE(kernel.step_with(*app, kStill));
  ASSERT_TRUE(kernel.step_with(*app, kStill));
  EXPECT_LT(std::abs(app->state()->state.joint_angle_urad[0] - 1570796), 1000);
  EXPECT_EQ(heartbeat().kernel_state, BERM_STATE_RUN);
  EXPECT_EQ(json_number(kernel.end(), "frames_rejected"), 2);
}

// verifies: SK-CY-104
TEST_F(KernelLockstep, ForeignDatagramsOnTheScanPortAreCountedAndHarmless) {
  run();
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{60}, std::size_t{1206}, std::size_t{9000}})
    kernel.send_datagram(kernel.scan_port(), std::vector<std::uint8_t>(size, 0x5A));
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(kernel.step_with(*app, kStill));
  EXPECT_EQ(heartbeat().kernel_state, BERM_STATE_RUN);
  EXPECT_EQ(json_number(kernel.end(), "scan_rejected"), 5);
}

// verifies: SK-CY-20
TEST_F(KernelLockstep, UnknownGroundIsBlocked) {
  kernel.machine->pan_low_rad = 1.2;
  kernel.machine->pan_high_rad = 1.6;
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(kernel.step_with(*app, kBoomUp));
    ASSERT_FALSE(commands_motion()) << "cycle " << i;
  }
  EXPECT_EQ(app->state()->state.stop_reason, BERM_STOP_UNKNOWN_GROUND);
}

// verifies: SK-CY-70, IF-CT-5 (the seals), IF-CT-6
TEST_F(KernelLockstep, TheAppCannotWriteTheStateSegmentNorResizeAny) {
  EXPECT_EQ(mmap(nullptr, sizeof(berm_state_segment), PROT_READ | PROT_WRITE, MAP_SHARED, app->state_fd(), 0), MAP_FAILED);
  EXPECT_EQ(ftruncate(app->state_fd(), 16), -1);
  EXPECT_EQ(ftruncate(app->request_fd(), 16), -1);
  EXPECT_EQ(ftruncate(app->request_fd(), 1 << 20), -1);
  const char byte = 1;
  EXPECT_EQ(pwrite(app->state_fd(), &byte, 1, 0), -1);
}

// An app that died in its write leaves the guard odd, and perhaps half a request.
// verifies: IF-CT-8 (the kernel waits for nobody, and the CRC alone decides)
TEST_F(KernelLockstep, AnOddGuardHoldsTheKernelUpInNothing) {
  run();
  const auto write = [&](bool whole) {
    berm_request request = make_request(app->state()->state.request_sequence + 1, app->state()->state.time_us, kBoomUp);
    if (!whole) request.joint_velocity_urad_s[1] -= 1;
    app->write_request(request);
    app->leave_guard_odd();
  };
  write(true);
  ASSERT_TRUE(kernel.step());
  EXPECT_TRUE(commands_motion());
  write(false);
  ASSERT_TRUE(kernel.step());
  steps(1);  // published behind the heartbeat
  EXPECT_EQ(app->state()->decision[(app->state()->decision_head - 1) % BERM_DECISION_RING].request_result, BERM_REQUEST_CRC);
}

// The app writes two requests in turn, without end: whatever the kernel copies of them, it takes the one or the other whole, or nothing.
// verifies: IF-CT-8 (once a cycle the kernel copies the 64 bytes), SK-CY-70 (copies each request once)
TEST_F(KernelLockstep, ARequestThatIsWrittenMeanwhileIsTakenWholeOrNotAtAll) {
  run();
  constexpr std::int32_t kUp[4] = {0, 50000, 0, 0}, kDown[4] = {0, -50000, 0, 0};  // of even and of odd sequences
  // The kernel answers the machine before it writes the decision.
  const auto decided = [&] {
    for (int wait = 0; wait < 5000 && __atomic_load_n(&app->state()->decision_head, __ATOMIC_ACQUIRE) != static_cast<std::uint32_t>(kernel.machine->cycle()); ++wait) usleep(1000);
    ASSERT_EQ(app->state()->decision_head, static_cast<std::uint32_t>(kernel.machine->cycle()));
  };
  decided();
  int taken = 0, torn = 0;
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t even = (app->state()->state.request_sequence | 1U) + 1U;
    const berm_request request[2] = {make_request(even, app->state()->state.time_us, kUp), make_request(even + 1, app->state()->state.time_us, kDown)};
    std::atomic<bool> end = false, written = false;
    std::thread writer([&] {
      while (!end) {
        for (const berm_request& r : request) app->write_request(r);
        written = true;
      }
    });
    while (!written) usleep(100);  // what was there before is gone: the kernel may not have taken it yet
    const auto next = static_cast<std::uint32_t>(kernel.machine->cycle());
    const bool stepped = kernel.step();
    decided();
    end = true;
    writer.join();
    ASSERT_TRUE(stepped);
    const berm_decision& decision = app->state()->decision[next % BERM_DECISION_RING];
    taken += decision.request_result == BERM_REQUEST_ACCEPTED;
    torn += decision.request_result == BERM_REQUEST_CRC;
    if (decision.request_result != BERM_REQUEST_ACCEPTED) continue;
    ASSERT_EQ(decision.requested_urad_s[1], decision.request_sequence % 2 == 0 ? kUp[1] : kDown[1]) << "a mixture, cycle " << i;
  }
  std::printf("%d taken, %d torn\n", taken, torn);
  EXPECT_GT(taken, 0);
}

// Of the map only what is under the machine is known so early, and what is published cannot be undone: so the first round is looked at.
// verifies: IF-CT-17 (all rows within 13 cycles)
TEST(KernelMap, ThirteenCyclesPublishEveryRow) {
  KernelProcess kernel;
  ASSERT_TRUE(kernel.started());
  Peer recorder(kernel.socket_path(), BERM_ROLE_RECORDER);
  const auto own = [&] {
    std::vector<int> rows;
    for (const auto& row : recorder.state()->map_status) rows.push_back(static_cast<int>(std::count(std::begin(row), std::end(row), BERM_CELL_OWN_BODY)));
    return rows;
  };
  const auto run_to = [&](std::uint32_t cycles) {
    while (kernel.machine->cycle() < cycles) ASSERT_TRUE(kernel.step());
    ASSERT_TRUE(recorder.state() != nullptr || recorder.receive_welcome());
    for (int wait = 0; wait < 5000 && __atomic_load_n(&recorder.state()->wake, __ATOMIC_ACQUIRE) < cycles; ++wait) usleep(1000);
  };
  run_to(13);
  const std::vector<int> first = own();
  EXPECT_GT(std::accumulate(first.begin(), first.end(), 0), 100);
  run_to(39);
  EXPECT_EQ(own(), first);
}

// verifies: SK-CY-71, IF-CT-23 (a recorder)
TEST_F(KernelLockstep, ARecorderSeesDecisionsAndGetsNoRequestSegment) {
  Peer recorder(kernel.socket_path(), BERM_ROLE_RECORDER);
  steps(1);
  ASSERT_TRUE(recorder.receive_welcome());
  EXPECT_EQ(recorder.welcome().accepted, 1U);
  EXPECT_EQ(recorder.request_fd(), -1);
  steps(2);
  EXPECT_GE(recorder.state()->decision_head, 3U);
}

// verifies: SK-CY-41
TEST(KernelMapOnly, FillsTheMapWithoutAMachineAndRefusesTheApp) {
  KernelProcess kernel({}, false);
  ASSERT_TRUE(kernel.started());
  Peer recorder(kernel.socket_path(), BERM_ROLE_RECORDER);
  ASSERT_TRUE(recorder.receive_welcome());
  ASSERT_EQ(recorder.welcome().accepted, 1U);
  Peer app(kernel.socket_path(), BERM_ROLE_APP);
  ASSERT_TRUE(app.receive_welcome());
  EXPECT_EQ(app.welcome().accepted, 0U);
  // One packet of a VLP-16: single last return, every laser at 5 m.
  std::vector<std::uint8_t> packet(1206, 0);
  for (std::size_t block = 0; block < 12; ++block) {
    packet[block * 100] = 0xFF;
    packet[block * 100 + 1] = 0xEE;
    packet[block * 100 + 2] = static_cast<std::uint8_t>(block * 20);
    for (std::size_t shot = 0; shot < 32; ++shot) {
      packet[block * 100 + 4 + shot * 3] = 2500 & 0xFF;
      packet[block * 100 + 5 + shot * 3] = 2500 >> 8;
    }
  }
  packet[1204] = 0x38;
  packet[1205] = 0x22;
  kernel.send_datagram(kernel.vlp16_port(), packet);
  packet[1205] = 0x21;
  kernel.send_datagram(kernel.vlp16_port(), packet);
  const std::uint32_t until = __atomic_load_n(&recorder.state()->wake, __ATOMIC_ACQUIRE) + 30;
  for (int i = 0; i < 5000 && static_cast<std::int32_t>(__atomic_load_n(&recorder.state()->wake, __ATOMIC_ACQUIRE) - until) < 0; ++i) usleep(1000);
  int observed = 0;
  for (const auto& row : recorder.state()->map_status)
    for (const auto status : row) observed += status == BERM_CELL_OBSERVED ? 1 : 0;
  EXPECT_GE(observed, 1);
  EXPECT_EQ(recorder.state()->state.kernel_state, BERM_STATE_INIT);
  const std::string report = kernel.end();
  EXPECT_EQ(json_number(report, "vlp16_packets"), 1) << report;
  EXPECT_EQ(json_number(report, "vlp16_rejected"), 1);
  EXPECT_EQ(json_number(report, "vlp16_points"), 384);
}

// What a command says and how it ends; one that goes on is ended after 10 s.
struct Told {
  std::string said;
  bool failed = false;
};
Told told(const std::string& arguments) {
  Told out;
  std::FILE* pipe = popen(("timeout 10 " + std::string(BERM_KERNEL) + " " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return out;
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) out.said += buffer;
  const int status = pclose(pipe);
  out.failed = WIFEXITED(status) && WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != kTimedOut;
  return out;
}

// verifies: SK-CY-55, SK-CY-60, SK-CY-91
TEST(KernelStart, BadInputIsOneLineAndAFailure) {
  const struct {
    const char* arguments;
    const char* says;
  } cases[] = {
      {"--parameters /nonexistent/block --can udp:239.255.66.1:4000 --scan-port 5000 --socket /tmp/x", "/nonexistent/block"},
      {"--parameters /dev/null --can udp:239.255.66.1:4000 --scan-port 5000 --socket /tmp/x", "bytes"},
      {"--scan-port 0", "--scan-port"},
      {"--unknown", "--unknown"},
      {"--parameters p --can udp:239.255.66.1:4000 --scan-port 5000 --socket /tmp/x --vlp16-port 5001", "--vlp16-port goes with --map-only"},
  };
  for (const auto& c : cases) {
    const auto [said, failed] = told(c.arguments);
    EXPECT_TRUE(failed) << c.arguments;
    EXPECT_NE(said.find(c.says), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  }
}

TEST(KernelStart, IsReadyWhateverDescriptorsItsCallerHasOpen) {
  std::vector<int> taken;
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE(KernelProcess({}, false).started()) << i << " more descriptors open";
    taken.push_back(open("/dev/null", O_RDONLY | O_CLOEXEC));
  }
  for (const int fd : taken) close(fd);
}

// verifies: SK-CY-60
TEST(KernelStart, ABlockThatIsWrongInOnePointIsRefusedBeforeAnythingIsOpened) {
  const struct {
    const char* says;
    void (*spoil)(berm_parameters&);
    bool crc_made_right;
  } cases[] = {
      {"magic", [](berm_parameters& p) { p.magic += 1; }, true},
      {"version", [](berm_parameters& p) { p.version += 1; }, true},
      {"CRC", [](berm_parameters& p) { p.margin_mm += 1; }, false},
      {"rule", [](berm_parameters& p) { p.margin_mm = 0; }, true},
  };
  const Scratch scratch;
  const std::string file = scratch.path("block"), socket = scratch.path("kernel.sock");
  for (const auto& c : cases) {
    berm_parameters block = demo_parameters();
    c.spoil(block);
    if (c.crc_made_right)
      block.crc32 = static_cast<std::int32_t>(berm_crc32(reinterpret_cast<const std::uint8_t*>(&block), offsetof(berm_parameters, crc32)));
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(&block), sizeof block);
    const auto [said, failed] = told("--parameters " + file + " --can udp:239.255.66.1:4000 --scan-port 5000 --socket " + socket);
    EXPECT_TRUE(failed) << c.says;
    EXPECT_EQ(said.find("berm_kernel: " + file + ": "), 0U) << said;
    EXPECT_NE(said.find(c.says), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_FALSE(std::filesystem::exists(socket)) << c.says;
  }
}

}  // namespace
}  // namespace berm::test
