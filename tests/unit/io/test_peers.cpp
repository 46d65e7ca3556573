// Who is let in, with what, and how the kernel notices that a peer has gone.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

#include "contract/berm_contract.h"
#include "io/peers.hpp"

namespace berm::kernel {
namespace {

struct Answer {
  bool came = false;
  berm_welcome welcome{};
  int descriptors = 0;
};

int connect_to(const std::string& path) {
  const int fd = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, path.c_str());
  if (connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return fd;
  close(fd);
  return -1;
}

Answer receive_answer(int fd) {
  Answer answer;
  pollfd wait{fd, POLLIN, 0};
  if (poll(&wait, 1, 2000) != 1) return answer;
  iovec part{&answer.welcome, sizeof answer.welcome};
  alignas(cmsghdr) char control[CMSG_SPACE(4 * sizeof(int))];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  answer.came = recvmsg(fd, &message, MSG_CMSG_CLOEXEC) == static_cast<ssize_t>(sizeof answer.welcome);
  if (const cmsghdr* header = CMSG_FIRSTHDR(&message); answer.came && header != nullptr) {
    answer.descriptors = static_cast<int>((header->cmsg_len - CMSG_LEN(0)) / sizeof(int));
    for (int i = 0; i < answer.descriptors; ++i) {
      int received;
      std::memcpy(&received, CMSG_DATA(header) + i * sizeof(int), sizeof received);
      close(received);
    }
  }
  return answer;
}

class Peers : public ::testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/berm-peers-XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder = name;
    ASSERT_EQ(chmod(name, 0755), 0);
    path = folder + "/kernel.sock";
    std::string error;
    ASSERT_TRUE(state.create("state", sizeof(berm_state_segment), SegmentAccess::kKernelWrites, error));
    ASSERT_TRUE(request.create("request", sizeof(berm_request_segment), SegmentAccess::kPeerWrites, error));
  }
  void TearDown() override {
    unlink(path.c_str());
    rmdir(folder.c_str());
  }
  void open(uid_t app, uid_t recorder, bool refuse_app = false) {
    std::string error;
    ASSERT_TRUE(server.open(path, {app, recorder, refuse_app}, state, request, error)) << error;
  }
  Answer ask(int fd, char role) {
    EXPECT_EQ(send(fd, &role, 1, MSG_NOSIGNAL), 1);
    for (int i = 0; i < 3; ++i) server.poll();
    return receive_answer(fd);
  }

  std::string folder, path;
  SharedSegment state, request;
  PeerServer server;
};

// verifies: SK-CY-71, IF-CT-21 (the roles), IF-CT-23 (accepted)
TEST_F(Peers, AppGetsBothSegmentsRecorderOne) {
  open(geteuid(), geteuid());
  const int app = connect_to(path), recorder = connect_to(path);
  const Answer to_app = ask(app, BERM_ROLE_APP);
  ASSERT_TRUE(to_app.came);
  EXPECT_EQ(to_app.welcome.accepted, 1U) << to_app.welcome.reason;
  EXPECT_EQ(to_app.welcome.state_size, sizeof(berm_state_segment));
  EXPECT_EQ(to_app.descriptors, 2);
  const Answer to_recorder = ask(recorder, BERM_ROLE_RECORDER);
  EXPECT_EQ(to_recorder.welcome.accepted, 1U);
  EXPECT_EQ(to_recorder.descriptors, 1);
  EXPECT_TRUE(server.app_connected());
  close(app);
  close(recorder);
}

// verifies: SK-CY-71, IF-CT-23 (refused), IF-CT-24
TEST_F(Peers, OneAppAtATimeAndItsHangUpIsNoticed) {
  open(geteuid(), geteuid());
  const int first = connect_to(path);
  ASSERT_EQ(ask(first, BERM_ROLE_APP).welcome.accepted, 1U);
  const int second = connect_to(path);
  const Answer refused = ask(second, BERM_ROLE_APP);
  EXPECT_TRUE(refused.came);
  EXPECT_EQ(refused.welcome.accepted, 0U);
  EXPECT_EQ(refused.descriptors, 0);
  EXPECT_STRNE(refused.welcome.reason, "");
  close(first);
  server.poll();
  EXPECT_FALSE(server.app_connected());
  const int third = connect_to(path);
  EXPECT_EQ(ask(third, BERM_ROLE_APP).welcome.accepted, 1U);
  EXPECT_EQ(server.app_connections(), 2U);
  close(second);
  close(third);
}

// verifies: SK-CY-71, IF-CT-24
TEST_F(Peers, FourRecordersAndNoFifth) {
  open(geteuid(), geteuid());
  int fd[5];
  for (int i = 0; i < 5; ++i) {
    fd[i] = connect_to(path);
    EXPECT_EQ(ask(fd[i], BERM_ROLE_RECORDER).welcome.accepted, i < 4 ? 1U : 0U);
  }
  for (const int f : fd) close(f);
}

// verifies: SK-CY-71, IF-CT-22
TEST_F(Peers, AnotherUidIsRefused) {
  open(geteuid() + 1, geteuid());
  const int fd = connect_to(path);
  const Answer answer = ask(fd, BERM_ROLE_APP);
  EXPECT_TRUE(answer.came);
  EXPECT_EQ(answer.welcome.accepted, 0U);
  EXPECT_EQ(answer.descriptors, 0);
  EXPECT_FALSE(server.app_connected());
  close(fd);
}

// verifies: SK-CY-71, IF-CT-22
TEST_F(Peers, AProcessOfAnotherUidIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "SKIPPED: only root can start a process under another uid";
  open(0, 0);
  const pid_t child = fork();
  if (child == 0) {
    if (setuid(65534) != 0) _exit(9);
    const int fd = connect_to(path);
    const char role = BERM_ROLE_APP;
    if (fd < 0 || send(fd, &role, 1, MSG_NOSIGNAL) != 1) _exit(8);
    const Answer answer = receive_answer(fd);
    _exit(answer.came && answer.welcome.accepted == 0 && answer.descriptors == 0 ? 0 : 1);
  }
  int status = 0;
  for (int i = 0; i < 500 && waitpid(child, &status, WNOHANG) == 0; ++i) {
    server.poll();
    usleep(10000);
  }
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

// verifies: SK-CY-41, SK-CY-71
TEST_F(Peers, WithoutAMachineTheAppIsRefused) {
  open(geteuid(), geteuid(), true);
  const int fd = connect_to(path);
  EXPECT_EQ(ask(fd, BERM_ROLE_APP).welcome.accepted, 0U);
  close(fd);
}

// verifies: SK-CY-71, IF-CT-21
TEST_F(Peers, ASilentNewcomerIsDroppedAndAWrongRoleRefused) {
  open(geteuid(), geteuid());
  const int silent = connect_to(path);
  for (int i = 0; i < PeerServer::kHandshakePolls + 5; ++i) server.poll();
  char byte;
  EXPECT_EQ(recv(silent, &byte, 1, MSG_DONTWAIT), 0) << "closed by the kernel";
  const int wrong = connect_to(path);
  EXPECT_EQ(ask(wrong, 'Q').welcome.accepted, 0U);
  close(silent);
  close(wrong);
}

// verifies: SK-JO-5, IF-JR-2
TEST_F(Peers, OneWriterOfTheJournalAndOnlyWhereOneIsKept) {
  SharedSegment ring, tail;
  std::string error;
  ASSERT_TRUE(ring.create("ring", 4096, SegmentAccess::kKernelWrites, error));
  ASSERT_TRUE(tail.create("tail", 64, SegmentAccess::kPeerWrites, error));
  server.serve_journal(ring, tail);
  ASSERT_TRUE(server.open(path, {geteuid(), geteuid(), false, geteuid()}, state, request, error)) << error;
  EXPECT_FALSE(server.journal_was_connected());
  const int first = connect_to(path), second = connect_to(path);
  const Answer accepted = ask(first, BERM_ROLE_JOURNAL);
  EXPECT_EQ(accepted.welcome.accepted, 1U);
  EXPECT_EQ(accepted.descriptors, 2);
  EXPECT_EQ(accepted.welcome.state_size, 4096U);
  EXPECT_EQ(accepted.welcome.request_size, 64U);
  EXPECT_EQ(ask(second, BERM_ROLE_JOURNAL).welcome.accepted, 0U);
  close(first);
  server.poll();
  EXPECT_FALSE(server.journal_connected());
  EXPECT_TRUE(server.journal_was_connected());
  close(second);
}

// verifies: SK-JO-5
TEST_F(Peers, WithoutAJournalNobodyWritesIt) {
  open(geteuid(), geteuid());
  const int fd = connect_to(path);
  const Answer answer = ask(fd, BERM_ROLE_JOURNAL);
  EXPECT_TRUE(answer.came);
  EXPECT_EQ(answer.welcome.accepted, 0U);
  EXPECT_EQ(answer.descriptors, 0);
  close(fd);
}

}  // namespace
}  // namespace berm::kernel
