// berm_app as a process before a kernel in miniature: greeting, segments, one request and one tick for each cycle, sandbox, end.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/futex.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <climits>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/app_loop.hpp"
#include "app_bench/bench_machine.hpp"
#include "scan/scan_packet.h"
#include "scratch.hpp"
#include "send_descriptors.hpp"

namespace {

using namespace berm;
using namespace berm::app;

int segment_fd(std::size_t size, bool sealed) {
  const int fd = static_cast<int>(::syscall(SYS_memfd_create, "segment", MFD_ALLOW_SEALING));
  EXPECT_GE(fd, 0);
  EXPECT_EQ(::ftruncate(fd, static_cast<off_t>(size)), 0);
  if (sealed) {
    EXPECT_EQ(::fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW), 0);
  }
  return fd;
}

class AppProcess : public ::testing::Test {
protected:
  void SetUp() override {
    path_ = scratch_.path("socket");
  }

  void TearDown() override {
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
    for (const int fd : {peer_, tick_, listener_, state_fd_, request_fd_})
      if (fd >= 0) ::close(fd);
  }

  // Listens, starts the app, answers its greeting.
  void start(bool sealed = true, std::uint32_t state_size = sizeof(berm_state_segment), std::uint32_t accepted = 1) {
    listener_ = ::socket(AF_UNIX, SOCK_SEQPACKET, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, path_.c_str());
    ASSERT_EQ(::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::listen(listener_, 1), 0);
    int ticks[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ticks), 0);
    tick_ = ticks[0];
    ::fcntl(tick_, F_SETFD, FD_CLOEXEC);
    const timeval patience{20, 0};
    ::setsockopt(tick_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    child_ = ::fork();
    if (child_ == 0) {
      const std::string tick = std::to_string(ticks[1]), out = scratch_.path("out"), errors = scratch_.path("err");
      ::dup2(::open(out.c_str(), O_CREAT | O_WRONLY, 0600), 1);
      ::dup2(::open(errors.c_str(), O_CREAT | O_WRONLY, 0600), 2);
      ::execl(BERM_APP, "berm_app", "--machine", BERM_CONFIG_DIR "/machines/zx200.toml", "--site", BERM_CONFIG_DIR "/sites/bench.toml", "--truck-classes", BERM_CONFIG_DIR "/truck_classes.toml", "--scripts", BERM_SCRIPTS, "--socket", path_.c_str(),
              "--trucks", "1", "--tick-fd", tick.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ticks[1]);
    peer_ = ::accept(listener_, nullptr, nullptr);
    ASSERT_GE(peer_, 0);
    std::uint8_t role = 0;
    ASSERT_EQ(::recv(peer_, &role, 1, 0), 1);
    ASSERT_EQ(role, BERM_ROLE_APP);
    state_fd_ = segment_fd(sizeof(berm_state_segment), sealed);
    request_fd_ = segment_fd(sizeof(berm_request_segment), sealed);
    state_ = static_cast<berm_state_segment*>(::mmap(nullptr, sizeof(berm_state_segment), PROT_READ | PROT_WRITE, MAP_SHARED, state_fd_, 0));
    request_ = static_cast<berm_request_segment*>(::mmap(nullptr, sizeof(berm_request_segment), PROT_READ | PROT_WRITE, MAP_SHARED, request_fd_, 0));
    state_->magic = BERM_CONTRACT_MAGIC;
    state_->version = BERM_CONTRACT_VERSION;
    state_->size = sizeof(berm_state_segment);
    berm_welcome welcome{BERM_CONTRACT_MAGIC, BERM_CONTRACT_VERSION, accepted, state_size, sizeof(berm_request_segment), "not today"};
    const int fds[2] = {state_fd_, request_fd_};
    ASSERT_TRUE(berm::test::send_descriptors(peer_, &welcome, sizeof welcome, fds));
  }

  void publish(const berm_state_segment& from) {
    ++state_->state_guard;
    state_->state = from.state;
    std::memcpy(state_->decision, from.decision, sizeof from.decision);
    state_->decision_head = from.decision_head;
    std::memcpy(state_->scan, from.scan, sizeof from.scan);
    state_->scan_head = from.scan_head;
    ++state_->state_guard;
    __atomic_add_fetch(&state_->wake, 1, __ATOMIC_SEQ_CST);
    ::syscall(SYS_futex, &state_->wake, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
  }

  // Exit code, or -1 when it was ended by a signal.
  int wait_for_end() {
    int status = 0;
    EXPECT_EQ(::waitpid(child_, &status, 0), child_);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string text(const char* name) {
    std::ifstream in(scratch_.path(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }

  test::Scratch scratch_;
  std::string path_;
  int listener_ = -1, peer_ = -1, tick_ = -1, state_fd_ = -1, request_fd_ = -1;
  pid_t child_ = -1;
  berm_state_segment* state_ = nullptr;
  berm_request_segment* request_ = nullptr;
};

// verifies: IF-CT-8 (the app: the guard is even, the request whole), IF-CT-9, IF-CT-18 (a reader),
// IF-CT-26 (each cycle once, request before tick)
TEST_F(AppProcess, AnswersEachCycleOnceWithAValidRequest) {
  start();
  app_bench::BenchMachine plant(app_bench::zx200(), {0.0, radians(45.0), radians(-100.0), radians(-100.0)}, 3);
  bool moved = false;
  for (std::uint64_t k = 1; k <= 1500; ++k) {
    plant.step(request_->request);
    publish(plant.segment());
    Tick tick{};
    ASSERT_EQ(::recv(tick_, &tick, sizeof tick, 0), static_cast<ssize_t>(sizeof tick)) << "cycle " << k;
    ASSERT_EQ(tick.cycle, plant.state().cycle);
    ASSERT_EQ(tick.flags, 0u);
    const berm_request& r = request_->request;
    ASSERT_EQ(request_->guard % 2, 0u);
    ASSERT_EQ(r.magic, BERM_CONTRACT_MAGIC);
    ASSERT_EQ(r.sequence, k);
    ASSERT_EQ(r.stamp_us, plant.state().time_us);
    ASSERT_EQ(r.crc32, berm_crc32(reinterpret_cast<const std::uint8_t*>(&r), offsetof(berm_request, crc32)));
    if (k == 700) {
      Tick extra{};
      ::usleep(300'000);
      EXPECT_EQ(::recv(tick_, &extra, sizeof extra, MSG_DONTWAIT), -1) << "a second tick for one cycle";
    }
    for (const std::int32_t v : r.joint_velocity_urad_s) moved = moved || v != 0;
  }
  EXPECT_TRUE(moved);
  // What the running process holds: stdio, the kernel's socket, the tick; and a filter.
  std::ifstream status("/proc/" + std::to_string(child_) + "/status");
  std::string line;
  bool filtered = false;
  while (std::getline(status, line)) filtered = filtered || line == "Seccomp:\t2";
  EXPECT_TRUE(filtered);
  std::error_code error;
  int descriptors = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(child_) + "/fd", error)) {
    (void)entry;
    ++descriptors;
  }
  if (error) GTEST_LOG_(WARNING) << "SKIPPED in part: only root may list the descriptors of a process that is not dumpable";
  else EXPECT_EQ(descriptors, 5);
  ::kill(child_, SIGTERM);
  EXPECT_EQ(wait_for_end(), 0);
  EXPECT_NE(text("out").find("\"event\":\"truck\""), std::string::npos);
  EXPECT_EQ(text("out").find("projection_disagrees"), std::string::npos);
  EXPECT_NE(text("out").find("\"points_disagreeing\":0,"), std::string::npos);
}

TEST_F(AppProcess, TellsOnceThatTheKernelPutsPointsElsewhere) {
  start();
  app_bench::BenchMachine plant(app_bench::zx200(), {0.0, radians(45.0), radians(-100.0), radians(-100.0)}, 3);
  for (int k = 1; k <= 200; ++k) {
    plant.step(request_->request);
    berm_state_segment& segment = plant.mutable_segment();
    for (std::uint32_t n = segment.scan_head - 2; k > 100 && n != segment.scan_head; ++n)
      for (auto& point : segment.scan[n % BERM_SCAN_RING].point_mm) point[1] += point[2] != 0 ? 20 : 0;
    publish(segment);
    Tick tick{};
    ASSERT_EQ(::recv(tick_, &tick, sizeof tick, 0), static_cast<ssize_t>(sizeof tick)) << "cycle " << k;
  }
  ::kill(child_, SIGTERM);
  EXPECT_EQ(wait_for_end(), 0);
  const std::string out = text("out");
  const auto told = out.find("{\"event\":\"projection_disagrees\"");
  ASSERT_NE(told, std::string::npos);
  EXPECT_EQ(out.find("projection_disagrees", told + 20), std::string::npos) << "once";
  const auto event = nlohmann::json::parse(out.substr(told, out.find('\n', told) - told));
  EXPECT_NEAR(event["distance_m"].get<double>(), 0.02, 0.003);
  EXPECT_NEAR(event["time_s"].get<double>(), 1.03, 0.03);
  const auto end = out.find("{\"event\":\"exit\"");
  ASSERT_NE(end, std::string::npos);
  const auto last = nlohmann::json::parse(out.substr(end, out.find('\n', end) - end));
  EXPECT_GT(last["points_disagreeing"].get<int>(), 1000);
  EXPECT_GT(last["points_compared"].get<int>(), last["points_disagreeing"].get<int>());
}

TEST_F(AppProcess, EndsWhenTheKernelIsGone) {
  start();
  app_bench::BenchMachine plant(app_bench::zx200(), {0.0, radians(45.0), radians(-100.0), radians(-100.0)}, 3);
  plant.step(berm_request{});
  publish(plant.segment());
  Tick tick{};
  ASSERT_EQ(::recv(tick_, &tick, sizeof tick, 0), static_cast<ssize_t>(sizeof tick));
  ::close(peer_);
  peer_ = -1;
  EXPECT_EQ(wait_for_end(), 1);
  EXPECT_NE(text("out").find("kernel gone"), std::string::npos);
}

// verifies: IF-CT-25 (the seal)
TEST_F(AppProcess, RefusesASegmentThatCouldShrink) {
  start(false);
  EXPECT_EQ(wait_for_end(), 1);
  EXPECT_NE(text("err").find("not sealed against shrinking"), std::string::npos);
}

// verifies: IF-CT-25 (the sizes)
TEST_F(AppProcess, RefusesAnotherLayout) {
  start(true, sizeof(berm_state_segment) + 8);
  EXPECT_EQ(wait_for_end(), 1);
  EXPECT_NE(text("err").find("state segment"), std::string::npos);
}

// verifies: IF-CT-23 (the reason reaches the peer)
TEST_F(AppProcess, SaysWhyItWasRefused) {
  start(true, sizeof(berm_state_segment), 0);
  EXPECT_EQ(wait_for_end(), 1);
  EXPECT_NE(text("err").find("not today"), std::string::npos);
}

}  // namespace
