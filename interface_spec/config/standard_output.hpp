// What a program printed is its result as much as its files are: on a full disk it must not end as if all were well.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace berm::config {

// From now on the program ends with status 2 and one line, in which it has this name, when not all that it printed reached standard output.
inline void watch_standard_output(const std::string& program) {
  static std::string name;
  const bool watched = !name.empty();
  name = program;
  if (watched) return;
  std::atexit([] {
    errno = 0;  // the standard streams of C++ are in step with C's, and have nothing of their own to flush
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    std::fprintf(stderr, "%s: standard output: cannot be written%s%s\n", name.c_str(), errno == 0 ? "" : ": ", errno == 0 ? "" : std::strerror(errno));
    std::fflush(stderr);
    _exit(2);
  });
}

}  // namespace berm::config
