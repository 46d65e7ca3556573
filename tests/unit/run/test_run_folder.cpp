// A run's folder goes with it, and what a killed run has left goes with the next.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "run/kernel_session.hpp"
#include "scratch.hpp"

namespace {

using berm::run::RunFolder;

class RunFolders : public ::testing::Test {
 protected:
  void SetUp() override { setenv("TMPDIR", base_.folder().c_str(), 1); }
  void TearDown() override { unsetenv("TMPDIR"); }
  std::size_t folders() const { return base_.names().size(); }

  berm::test::Scratch base_;
};

TEST_F(RunFolders, GoWithTheirRun) {
  std::string path;
  {
    const RunFolder folder;
    path = folder.path();
    std::ofstream(folder.file("some")) << "thing";
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(RunFolders, OfOtherRunsAtWorkStay) {
  const RunFolder first;
  std::ofstream(first.file("some")) << "thing";
  const RunFolder second;
  EXPECT_TRUE(std::filesystem::exists(first.file("some")));
  EXPECT_EQ(folders(), 2u);
}

TEST_F(RunFolders, OfKilledRunsAreRemovedByTheNext) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const RunFolder folder;
    std::ofstream(folder.file("some")) << "thing";
    [[maybe_unused]] const ssize_t told = write(ready[1], "r", 1);
    for (;;) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_EQ(folders(), 1u);
  { const RunFolder while_it_runs; }
  EXPECT_EQ(folders(), 1u) << "it is at work";
  kill(child, SIGKILL);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(folders(), 1u);
  { const RunFolder next; }
  EXPECT_EQ(folders(), 0u);
  close(ready[0]);
  close(ready[1]);
}

TEST_F(RunFolders, OfOtherProgramsStay) {
  std::filesystem::create_directory(base_.path("berm-run-of-old"));  // no file tells whether its run lives
  std::filesystem::create_directory(base_.path("other"));
  base_.write("other/alive", "");
  { const RunFolder folder; }
  EXPECT_EQ(folders(), 2u);
}

constexpr berm::run::Uids kSeparate{true, 64600, 64601, 0, 64602}, kShared{false, 0, 0, 0, 0};

mode_t mode_of(const std::string& path) {
  struct stat about{};
  return stat(path.c_str(), &about) == 0 ? about.st_mode & 07777 : 0;
}

std::string refusal(const RunFolder& folder, const berm::run::Uids& uids) {
  try {
    berm::run::expect_reachable(folder, uids);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(RunFolders, WhereTheChildrenCannotGetToAreRefusedByName) {
  chmod(base_.folder().c_str(), 0711);
  const RunFolder folder;
  EXPECT_EQ(refusal(folder, kSeparate).find(base_.folder() + ":"), std::string::npos);
  chmod(base_.folder().c_str(), 0700);
  EXPECT_EQ(refusal(folder, kSeparate), "TMPDIR: " + base_.folder() + ": mode 0700 keeps the users of kernel and app (64600 and 64601) out: others must be able to enter it");
  EXPECT_EQ(refusal(folder, kShared), "") << "they are the caller";
}

TEST_F(RunFolders, WhatTheChildrenReadHasItsModeWhateverTheUmaskAndTheSource) {
  const mode_t before = umask(077);
  const RunFolder folder;
  const std::string secret = base_.write("secret.toml", "x = 1");
  chmod(secret.c_str(), 0600);
  berm::run::copy_for_children(secret, folder.file("copy.toml"));
  std::filesystem::create_directory(folder.file("scripts"));
  std::ofstream(folder.file("scripts/one")) << "rules";
  berm::run::open_to_children(folder.file("scripts"));
  umask(before);
  EXPECT_EQ(mode_of(folder.path()), 0755u);
  EXPECT_EQ(mode_of(folder.file("copy.toml")), 0644u);
  EXPECT_EQ(mode_of(folder.file("scripts")), 0755u);
  EXPECT_EQ(mode_of(folder.file("scripts/one")), 0644u);
  EXPECT_EQ(mode_of(secret), 0600u) << "the source stays as it is";
}

}  // namespace
