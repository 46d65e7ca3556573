#include "kernel_process.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>

#include "config/compile_parameters.hpp"
#include "send_descriptors.hpp"

namespace berm::test {

namespace {

constexpr int kPatienceMs = 10000;

bool wait_readable(int fd, int ms) {
  pollfd wait{fd, POLLIN, 0};
  return poll(&wait, 1, ms) == 1;
}

}  // namespace

Peer::Peer(const std::string& socket_path, char role) {
  socket_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, socket_path.c_str());
  if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) send(socket_, &role, 1, MSG_NOSIGNAL);
}

Peer::~Peer() {
  if (state_ != nullptr) munmap(const_cast<berm_state_segment*>(state_), sizeof *state_);
  if (request_ != nullptr) munmap(request_, sizeof *request_);
  for (const int fd : {socket_, state_fd_, request_fd_})
    if (fd >= 0) close(fd);
}

bool Peer::receive_welcome() {
  if (!wait_readable(socket_, kPatienceMs)) return false;
  iovec part{&welcome_, sizeof welcome_};
  alignas(cmsghdr) char control[CMSG_SPACE(2 * sizeof(int))];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  if (recvmsg(socket_, &message, MSG_CMSG_CLOEXEC) != static_cast<ssize_t>(sizeof welcome_)) return false;
  if (welcome_.accepted == 0) return true;
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (header == nullptr) return false;
  int fd[2] = {-1, -1};
  std::memcpy(fd, CMSG_DATA(header), header->cmsg_len - CMSG_LEN(0));
  state_fd_ = fd[0];
  request_fd_ = fd[1];
  void* state = mmap(nullptr, sizeof(berm_state_segment), PROT_READ, MAP_SHARED, state_fd_, 0);
  state_ = state == MAP_FAILED ? nullptr : static_cast<const berm_state_segment*>(state);
  if (request_fd_ >= 0) {
    void* request = mmap(nullptr, sizeof(berm_request_segment), PROT_READ | PROT_WRITE, MAP_SHARED, request_fd_, 0);
    request_ = request == MAP_FAILED ? nullptr : static_cast<berm_request_segment*>(request);
  }
  return state_ != nullptr && (request_fd_ < 0 || request_ != nullptr);
}

bool Peer::hand_over(int fd) {
  const char byte = 0;
  const int fds[1] = {fd};
  return berm::test::send_descriptors(socket_, &byte, 1, fds);
}

void Peer::write_request(const berm_request& request) {
  __atomic_fetch_add(&request_->guard, 1U, __ATOMIC_ACQ_REL);
  std::memcpy(&request_->request, &request, sizeof request);
  __atomic_fetch_add(&request_->guard, 1U, __ATOMIC_RELEASE);
}

KernelProcess::KernelProcess(const std::vector<std::string>& extra, bool with_machine) {
  char name[] = "/tmp/berm-kernel-XXXXXX";
  folder_ = mkdtemp(name);
  socket_path_ = folder_ + "/kernel.sock";
  const berm_parameters parameters = demo_parameters();
  config::save_parameters(parameters, folder_ + "/parameters");
  machine = std::make_unique<MiniMachine>(parameters);
  udp_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (with_machine && !can_.open(can_port_.can_address()).empty()) return;
  start(extra, with_machine);
}

std::vector<std::uint16_t> KernelProcess::hear(int ms) {
  std::vector<std::uint16_t> cycles;
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms);
  berm_can_frame frame;
  berm_heartbeat heartbeat{};
  for (auto left = until - std::chrono::steady_clock::now(); left.count() > 0; left = until - std::chrono::steady_clock::now())
    if (can_.receive(frame, static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(left).count())) && berm_decode_heartbeat(&frame, &heartbeat)) cycles.push_back(heartbeat.cycle);
  return cycles;
}

KernelProcess::~KernelProcess() {
  end();
  close(udp_);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void KernelProcess::start(const std::vector<std::string>& extra, bool with_machine) {
  int ready[2], output[2];
  if (pipe2(ready, O_CLOEXEC) != 0 || pipe2(output, O_CLOEXEC) != 0) return;
  std::vector<std::string> words = {BERM_KERNEL, "--parameters", folder_ + "/parameters", "--socket", socket_path_, "--ready-fd", std::to_string(ready[1])};
  if (with_machine) words.insert(words.end(), {"--can", can_port_.can_address(), "--scan-port", scan_port_.text()});
  if (!with_machine) words.insert(words.end(), {"--map-only", "--vlp16-port", vlp16_port_.text()});
  words.insert(words.end(), extra.begin(), extra.end());
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    fcntl(ready[1], F_SETFD, 0);  // kept at its own number: a number chosen here might be that one already, and then dup2() would not keep it
    dup2(output[1], 1);
    execv(BERM_KERNEL, arguments.data());
    _exit(127);
  }
  close(ready[1]);
  close(output[1]);
  output_ = output[0];
  char byte = 0;
  started_ = wait_readable(ready[0], kPatienceMs) && read(ready[0], &byte, 1) == 1;
  close(ready[0]);
}

void KernelProcess::send_datagram(std::uint16_t port, const std::vector<std::uint8_t>& bytes) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(port);
  sendto(udp_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  if (port == scan_port()) ++packets_sent_;
}

bool KernelProcess::step() {
  machine->step();
  for (const auto& frame : machine->frames()) can_.send(frame);
  for (const auto& frame : extra_frames) can_.send(frame);
  extra_frames.clear();
  for (const auto& packet : machine->packets()) {
    std::vector<std::uint8_t> bytes(BERM_SCAN_PACKET_MAX_BYTES);
    bytes.resize(berm_scan_encode(&packet, bytes.data()));
    send_datagram(scan_port(), bytes);
  }
  const berm_sim_clock clock{machine->cycle(), packets_sent_};
  can_.send(berm_encode_sim_clock(&clock));
  std::vector<berm_can_frame> answer;
  berm_can_frame frame{};
  while (can_.receive(frame, kPatienceMs)) {
    answer.push_back(frame);
    berm_heartbeat heartbeat{};
    if (!berm_decode_heartbeat(&frame, &heartbeat) || heartbeat.cycle != (machine->cycle() & 0xFFFFU)) continue;
    machine->obey(answer);
    return true;
  }
  return false;
}

bool KernelProcess::step_with(Peer& app, const std::int32_t (&velocity_urad_s)[4]) {
  if (!step()) return false;
  // The state is published after the heartbeat; wait for it as the app does.
  for (int i = 0; i < kPatienceMs && __atomic_load_n(&app.state()->wake, __ATOMIC_ACQUIRE) < machine->cycle(); ++i) usleep(1000);
  app.write_request(make_request(++request_sequence_, app.state()->state.time_us, velocity_urad_s));
  return true;
}

std::string KernelProcess::end() {
  if (pid_ < 0) return {};
  kill(pid_, SIGTERM);
  std::string line;
  char buffer[4096];
  ssize_t n;
  while (wait_readable(output_, kPatienceMs) && (n = read(output_, buffer, sizeof buffer)) > 0) line.append(buffer, static_cast<std::size_t>(n));
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  close(output_);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? line : std::string();
}

long json_number(const std::string& line, const std::string& name) {
  const auto at = line.find("\"" + name + "\": ");
  return at == std::string::npos ? -1 : std::stol(line.substr(at + name.size() + 4));
}

}  // namespace berm::test
