// berm_params as a user starts it: exit status, one line on standard error, and what is left behind.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "config/compile_parameters.hpp"
#include "edited_file.hpp"

namespace berm::config::test {
namespace {

struct Outcome {
  int status;
  std::string out, error;
};

Outcome run(const Scratch& scratch, const std::string& arguments) {
  const std::string command = std::string(BERM_PARAMS) + " " + arguments + " >" + scratch.path("stdout") + " 2>" + scratch.path("stderr");
  const int status = std::system(command.c_str());
  Outcome done{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(scratch.path("stdout")), read_text(scratch.path("stderr"))};
  std::remove(scratch.path("stdout").c_str());
  std::remove(scratch.path("stderr").c_str());
  return done;
}

void expect_one_line(const Outcome& done, const std::string& what) {
  EXPECT_GT(done.status, 0) << what;
  EXPECT_EQ(done.out, "") << what;
  EXPECT_EQ(done.error.find('\n'), done.error.size() - 1) << what << ": " << done.error;
}

// verifies: IF-CF-14, IF-CF-15
TEST(BermParams, CompilesTheDefaultsAndShowsThem) {
  const Scratch scratch;
  const Outcome made = run(scratch, machine_path() + " " + site_path() + " -o " + scratch.path("block"));
  EXPECT_EQ(made.status, 0) << made.error;
  EXPECT_EQ(made.error, "");
  EXPECT_EQ(scratch.names(), std::vector<std::string>{"block"});
  const berm_parameters p = load_parameters(scratch.path("block"));
  const Outcome shown = run(scratch, "--show " + scratch.path("block"));
  EXPECT_EQ(shown.status, 0);
  EXPECT_EQ(shown.out, describe(p));
}

// verifies: IF-CF-2, IF-CF-14
TEST(BermParams, BadFilesGiveOneLineAndNoBlock) {
  const Scratch scratch;
  for (const bool machine : {true, false})
    for (const BadEdit& edit : machine ? bad_machine_edits() : bad_site_edits()) {
      const std::string bad = scratch.write("bad.toml", replaced(read_text(machine ? machine_path() : site_path()), edit.from, edit.to));
      const Outcome done = run(scratch, (machine ? bad + " " + site_path() : machine_path() + " " + bad) + " -o " + scratch.path("block"));
      expect_one_line(done, edit.name);
      EXPECT_NE(done.error.find(bad + ": " + edit.field), std::string::npos) << done.error;
      EXPECT_EQ(scratch.names(), std::vector<std::string>{"bad.toml"}) << edit.name;
    }
}

// verifies: IF-CF-14
TEST(BermParams, ABlockThatIsThereSurvivesABadFile) {
  const Scratch scratch;
  scratch.write("block", "as it was");
  const std::string bad = scratch.write("bad.toml", "schema = 3\n");
  expect_one_line(run(scratch, bad + " " + site_path() + " -o " + scratch.path("block")), "bad machine");
  EXPECT_EQ(read_text(scratch.path("block")), "as it was");
}

// verifies: IF-CF-2
TEST(BermParams, BadCommandLines) {
  const Scratch scratch;
  for (const std::string& arguments : {std::string(), machine_path(), machine_path() + " " + site_path(), std::string("--no-such-option"),
                                       std::string("--show /no/such/block"), machine_path() + " " + site_path() + " -o /no/such/folder/block",
                                       "--show " + machine_path()})
    expect_one_line(run(scratch, arguments), arguments);
  EXPECT_TRUE(scratch.names().empty());
}

TEST(BermParams, ShowingABlockTakesNothingToCompile) {
  const Scratch scratch;
  ASSERT_EQ(run(scratch, machine_path() + " " + site_path() + " -o " + scratch.path("block")).status, 0);
  for (const std::string& more : {machine_path(), machine_path() + " " + site_path(), "-o " + scratch.path("other"), machine_path() + " " + site_path() + " -o " + scratch.path("other")}) {
    const Outcome done = run(scratch, more + " --show " + scratch.path("block"));
    expect_one_line(done, more);
    EXPECT_NE(done.error.find("excludes --show"), std::string::npos) << done.error;
  }
  EXPECT_EQ(scratch.names(), std::vector<std::string>{"block"});
}

TEST(BermParams, Help) {
  const Scratch scratch;
  const Outcome done = run(scratch, "--help");
  EXPECT_EQ(done.status, 0);
  EXPECT_NE(done.out.find("--show"), std::string::npos);
}

}  // namespace
}  // namespace berm::config::test
