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

TEST(WholeFile, WhatKeepsNothingIsWrittenToDurablyAsWell) {
  EXPECT_NO_THROW(write_whole_file("/dev/null", "new", true));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THROW(write_whole_file("/dev/full", "new", true), std::runtime_error);
}

TEST(WholeFile, ThroughALinkTheFileIsReplacedThatItPointsTo) {
  const Scratch scratch;
  fs::create_directory(scratch.path("far"));
  const std::string file = scratch.write("far/result.json", "old, and longer"), link = scratch.path("link"), second = scratch.path("second");
  fs::create_hard_link(file, scratch.path("former"));
  fs::create_symlink("far/result.json", link);
  fs::create_symlink("link", second);
  write_whole_file(second, "new");
  EXPECT_TRUE(fs::is_symlink(link) && fs::is_symlink(second));
  EXPECT_EQ(read_text(file), "new");
  EXPECT_EQ(read_text(scratch.path("former")), "old, and longer") << "written in place: a reader would have found half of it";
  fs::remove(file);
  write_whole_file(link, "first");
  EXPECT_EQ(read_text(file), "first") << "the file at a link's end need not be there yet";
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path("far")), {}), 1) << "left beside it";
}

TEST(WholeFile, AnOpenFileUnderItsNumberIsWrittenInto) {
  const Scratch scratch;
  const std::string file = scratch.write("out", "");
  const int fd = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_GE(fd, 0);
  fs::create_symlink("/proc/self/fd/" + std::to_string(fd), scratch.path("stdout"));
  write_whole_file(scratch.path("stdout"), "through");
  struct stat opened {}, named {};
  ASSERT_EQ(fstat(fd, &opened), 0);
  ASSERT_EQ(stat(file.c_str(), &named), 0);
  close(fd);
  EXPECT_EQ(opened.st_ino, named.st_ino) << "replaced under who has it open";
  EXPECT_EQ(read_text(file), "through");
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
