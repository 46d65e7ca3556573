#include "identify/interruption.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <stdexcept>

namespace berm::identify {

Interruption::Interruption() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  fd_ = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
}

Interruption::~Interruption() {
  if (fd_ >= 0) close(fd_);
}

void Interruption::check() const {
  pollfd asked{fd_, POLLIN, 0};
  if (fd_ >= 0 && poll(&asked, 1, 0) == 1) throw std::runtime_error("interrupted: nothing is written");
}

}  // namespace berm::identify
