// A run has its folder for itself, until it ends, however it ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "run/out_folder.hpp"
#include "scratch.hpp"

namespace {

using berm::run::OutFolder;

std::string refusal(const std::string& path) {
  try {
    const OutFolder folder(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(OutFolders, AreMadeAndLeftAsTheyAre) {
  const berm::test::Scratch base;
  const std::string path = base.path("a/b");
  EXPECT_EQ(refusal(path), "");
  EXPECT_TRUE(std::filesystem::is_directory(path));
  EXPECT_TRUE(std::filesystem::is_empty(path)) << "a lock that is a file would stay";
}

TEST(OutFolders, AreOneRunsAtATime) {
  const berm::test::Scratch base;
  {
    const OutFolder first(base.path("out"));
    const std::string why = refusal(base.path("out"));
    EXPECT_THAT(why, testing::StartsWith(base.path("out") + ": in use"));
    EXPECT_EQ(why.find('\n'), std::string::npos);
    EXPECT_EQ(refusal(base.path("other")), "");
  }
  EXPECT_EQ(refusal(base.path("out")), "");
}

TEST(OutFolders, OfKilledRunsAreFree) {
  const berm::test::Scratch base;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const OutFolder folder(base.path("out"));
    [[maybe_unused]] const ssize_t told = write(ready[1], "r", 1);
    for (;;) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_NE(refusal(base.path("out")), "");
  kill(child, SIGKILL);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(refusal(base.path("out")), "");
  close(ready[0]);
  close(ready[1]);
}

TEST(OutFolders, ThatCannotBeAreNamed) {
  const berm::test::Scratch base;
  const std::string file = base.write("file", "");
  EXPECT_THAT(refusal(file), testing::StartsWith(file + ": "));
  EXPECT_THAT(refusal(file + "/under"), testing::StartsWith(file + "/under: "));
}

TEST(OutFolders, LoseAFormerRunAndNothingElse) {
  const berm::test::Scratch base;
  for (const char* name : {"trace.csv", "truth.json", "app.jsonl", "journal.mcap.part", "terrain_end.csv.truck", "scenario.toml", "notes.txt"}) base.write(name, "former");
  EXPECT_EQ(berm::run::remove_former_run(base.folder()), "trace.csv, truth.json, terrain_end.csv.truck, journal.mcap.part, app.jsonl");
  EXPECT_EQ(base.names(), (std::vector<std::string>{"notes.txt", "scenario.toml"}));
  EXPECT_EQ(berm::run::remove_former_run(base.folder()), "");
}

}  // namespace
