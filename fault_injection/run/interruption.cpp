#include "run/interruption.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace berm::run {

Interruption::Interruption() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction now {};
    sigaction(number, nullptr, &now);
    if (now.sa_handler != SIG_IGN) sigaddset(&signals, number);  // blocked, an ignored signal would be kept for us
  }
  fd_ = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
  pthread_sigmask(SIG_BLOCK, &signals, &before_);
}

Interruption::~Interruption() {
  while (take() != 0) {}  // else the one that has been answered would end the program now
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  close(fd_);
}

bool Interruption::asked() const {
  pollfd come{fd_, POLLIN, 0};
  return poll(&come, 1, 0) == 1;
}

int Interruption::take() const {
  signalfd_siginfo come{};
  return read(fd_, &come, sizeof come) == static_cast<ssize_t>(sizeof come) ? static_cast<int>(come.ssi_signo) : 0;
}

void Interruption::check() const {
  if (asked()) throw std::runtime_error("interrupted: nothing is written");
}

}  // namespace berm::run
