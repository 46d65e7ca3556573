// What a reader says of a file with one text in it replaced.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "scratch.hpp"

namespace berm::test {

// The error of read(path), which throws Error: one line that begins with the path; "" when it is read.
template <typename Error, typename Read>
std::string refused_edit(const std::string& file, const std::string& from, const std::string& to, const Read& read) {
  std::ifstream in(file);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "not in " + file + ": " + from;
  const Scratch scratch;
  const std::string path = scratch.write("edited", text.replace(at, from.size(), to));
  try {
    read(path);
  } catch (const Error& refused) {
    const std::string error = refused.what();
    EXPECT_EQ(error.find(path), 0U) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    return error;
  }
  return "";
}

}  // namespace berm::test
