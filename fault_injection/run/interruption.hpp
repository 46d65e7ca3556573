// SIGINT and SIGTERM as something to ask for, so that children are ended, folders removed and reports written.
#pragma once

#include <signal.h>

namespace berm::run {

// One in a process. A signal that was ignored before, as of a program that a script put into the background, stays ignored.
class Interruption {
 public:
  Interruption();  // from now on both signals wait to be asked for
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();
  bool asked() const;  // whether one has come that was not taken
  int take() const;    // its number, taken; 0 when none has come
  void check() const;  // throws std::runtime_error when one has come

 private:
  sigset_t before_{};
  int fd_ = -1;
};

}  // namespace berm::run
