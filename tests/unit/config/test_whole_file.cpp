// Output files: whole or not there, and what is no regular file stays what it is.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "config/whole_file.hpp"
#include "edited_file.hpp"

namespace berm::config::test {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::string& path) {
  try {
    write_whole_file(path, "new");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "written";
}

TEST(WholeFile, ReplacesARegularFileAndLeavesNothingBeside) {
  const Scratch scratch;
  const std::string path = scratch.path("result.json");
  write_whole_file(path, "old, and longer");
  write_whole_file(path, std::string_view("n\0w", 3), true);
  EXPECT_EQ(read_text(path), std::string("n\0w", 3));
  EXPECT_EQ(scratch.names(), std::vector<std::string>{"result.json"});
}

TEST(WholeFile, WhatCannotBeWrittenIsNamedAndNothingIsLeft) {
  const Scratch scratch;
  fs::create_directory(scratch.path("folder"));
  EXPECT_EQ(refusal(scratch.path("folder")), scratch.path("folder") + ": cannot be written: Is a directory");
  EXPECT_EQ(refusal(scratch.path("none/file")), scratch.path("none/file") + ": cannot be written: No such file or directory");
  EXPECT_EQ(scratch.names(), std::vector<std::string>{"folder"});
}

TEST(WholeFile, APipeIsWrittenToAndStaysAPipe) {
  const Scratch scratch;
  const std::string path = scratch.path("pipe");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  const int reader = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  write_whole_file(path, "through");
  char got[16] = {};
  EXPECT_EQ(read(reader, got, sizeof got), 7);
  EXPECT_STREQ(got, "through");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(path));
}

TEST(WholeFile, ALinkToADeviceStaysALink) {
  const Scratch scratch;
  const std::string path = scratch.path("link");
  fs::create_symlink("/dev/full", path);
  EXPECT_EQ(refusal(path), path + ": cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_symlink(path));
  fs::remove(path);
  fs::create_symlink("/dev/null", path);
  EXPECT_EQ(refusal(path), "written");
  EXPECT_TRUE(fs::is_symlink(path));
}

}  // namespace
}  // namespace berm::config::test
