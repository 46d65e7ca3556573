// A child gets the descriptors that it was promised, however many the launcher has open.
#include "run/child_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace berm::run {
namespace {

// Reading end of a pipe that holds a line, under a number of its own.
int line_at(int number, const std::string& line) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  EXPECT_EQ(write(ends[1], line.data(), line.size()), static_cast<ssize_t>(line.size()));
  close(ends[1]);
  EXPECT_EQ(dup3(ends[0], number, O_CLOEXEC), number);
  close(ends[0]);
  return number;
}

TEST(ChildProcesses, GetTheirDescriptorsFromALauncherThatHasHundredsOpen) {
  std::vector<int> lines;
  for (int k = 0; k < 4; ++k) lines.push_back(line_at(203 - k, "line " + std::to_string(k) + "\n"));
  ChildOptions options;
  options.program = "/bin/sh";
  options.arguments = {"-c", "cat <&4; cat <&5; cat <&6; cat <&7; exec ls /proc/self/fd"};
  for (int k = 0; k < 4; ++k) options.descriptors.push_back({lines[static_cast<std::size_t>(k)], 4 + k});
  ChildProcess child;
  child.start(options);
  EXPECT_TRUE(child.wait_ended(20.0));
  EXPECT_EQ(child.exit_status(), 0);
  EXPECT_EQ(child.take_lines(), (std::vector<std::string>{"line 0", "line 1", "line 2", "line 3", "0", "1", "2", "3", "4", "5", "6", "7"})) << "3 is what ls itself opens";
  for (const int line : lines) close(line);
}

// Neither the bus nor the scanners' ports are to be reached from there.
TEST(ChildProcesses, WithoutNetworkHaveANamespaceOfTheirOwnWithNothingUp) {
  if (geteuid() != 0) GTEST_SKIP() << "SKIPPED: needs root";
  ChildOptions options;
  options.program = "/bin/sh";
  options.arguments = {"-c", "readlink /proc/self/ns/net; grep -c : /proc/self/net/dev; grep -c . /proc/self/net/route"};
  options.no_network = true;
  options.uid = 64999;
  ChildProcess child;
  child.start(options);
  EXPECT_TRUE(child.wait_ended(20.0));
  const std::vector<std::string> said = child.take_lines();
  ASSERT_EQ(said.size(), 3U);
  EXPECT_NE(said[0], std::filesystem::read_symlink("/proc/self/ns/net").string());
  EXPECT_EQ(said[1], "1") << "the loopback interface, which is down";
  EXPECT_LE(said[2].size(), 1U) << "no route";
}

}  // namespace
}  // namespace berm::run
