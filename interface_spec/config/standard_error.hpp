// Lines on standard error, for which nothing is given up: where they cannot be written the program goes on, and ends with the status it has.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "config/one_line.hpp"

namespace berm::config {

// As fmt::print to it, which throws when standard error is closed or full, from a catch handler as well. One line,
// whatever the values hold.
template <class... Values>
void print_error(fmt::format_string<Values...> words, Values&&... values) noexcept {
  try {
    const std::string line = one_line(fmt::format(words, std::forward<Values>(values)...));
    std::fwrite(line.data(), 1, line.size(), stderr);
  } catch (...) {  // no memory for a line: there is nobody to tell
  }
}

}  // namespace berm::config
