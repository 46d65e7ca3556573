// Options of the commands: what CLI11 lets through, files that would overwrite each other, and a standard output that takes nothing.
#include "config/command_line.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>

#include "scratch.hpp"

namespace berm::config {
namespace {

class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    app.add_option("FILE", file, "read");
    app.add_option("--other", other, "a name, or a file that is read");
    output(app.add_option("--json", json, "written"));
    output(app.add_option("--picture", picture, "written"))->capture_default_str();
    app.add_option("--hours", hours, "")->check(CLI::Range(0.01, 10.0));
    app.add_option("--many", many, "")->check(CLI::Range(0.01, 10.0));
    app.add_option("--seed", seed, "");
    app.add_option("--runs", runs, "");
    std::ofstream(sweep) << "points";
  }
  // The line on standard error; empty when the options were taken.
  std::string refusal(const std::vector<std::string>& words) {
    std::vector<std::string> all{"berm try"};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> argv;
    for (std::string& word : all) argv.push_back(word.data());
    testing::internal::CaptureStderr();
    const auto status = parse_options(app, static_cast<int>(argv.size()), argv.data());
    std::string line = testing::internal::GetCapturedStderr();
    EXPECT_EQ(status.value_or(0), line.empty() ? 0 : 2);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), line.empty() ? 0 : 1) << line;
    return line;
  }

  test::Scratch scratch;
  const std::string sweep = scratch.path("sweep.pcd");
  CLI::App app{"", "berm try"};
  std::string file, other, json, picture, map = "map.svg";
  double hours = 1.0;
  std::vector<double> many;
  std::uint64_t seed = 1;
  int runs = 1;
};

TEST_F(CommandLine, WhatIsRightIsTaken) {
  EXPECT_EQ(refusal({sweep, "--json", scratch.path("a.json"), "--picture", scratch.path("a.svg"), "--hours", "0.5", "--many", "1", "2", "--seed", "18446744073709551615"}), "");
  EXPECT_EQ(hours, 0.5);
  EXPECT_EQ(seed, UINT64_MAX);
}

TEST_F(CommandLine, ANumberThatIsNoneIsWithinNoRange) {
  for (const char* none : {"nan", "NAN(1)"}) {
    EXPECT_NE(refusal({"--hours", none}).find("--hours"), std::string::npos) << none;
    EXPECT_NE(refusal({"--many", "1", none}).find("--many"), std::string::npos) << none;
  }
  EXPECT_NE(refusal({"--hours", "inf"}), "");
}

TEST_F(CommandLine, ASeedIsTheOneThatWasTyped) {
  EXPECT_EQ(refusal({"--seed", "-1"}), "berm try: --seed: -1 is negative (see --help)\n");
  EXPECT_EQ(refusal({"--seed", "99999999999999999999999"}), "berm try: --seed: 99999999999999999999999 is beyond 18446744073709551615 (see --help)\n");
}

TEST_F(CommandLine, ANumberIsTheDecimalThatItLooksLike) {
  for (const char* octal : {"010", "-010", "0x10", "0777777777777777777777777", "0xFFFFFFFFFFFFFFFFFFFF"}) {
    if (octal[0] != '-') {
      EXPECT_EQ(refusal({"--seed", octal}), "berm try: --seed: " + std::string(octal) + " is no whole number in decimal digits without leading zeros (see --help)\n");
    }
    EXPECT_NE(refusal({"--runs", octal}), "") << octal;
  }
  EXPECT_NE(refusal({"--runs", "4294967297"}), "");
  EXPECT_EQ(refusal({"--seed", "0", "--runs", "-10", "--hours", "00.5"}), "");
  EXPECT_EQ(runs, -10);
}

TEST_F(CommandLine, ANameIsNotEmpty) {
  EXPECT_EQ(refusal({""}), "berm try: FILE: must not be empty (see --help)\n");
  EXPECT_EQ(refusal({"--other", ""}), "berm try: --other: must not be empty (see --help)\n");
  EXPECT_EQ(refusal({"--json", ""}), "berm try: --json: must not be empty (see --help)\n");
  EXPECT_EQ(refusal({"--picture", ""}), "berm try: --picture: must not be empty (see --help)\n") << "nor where there is a default";
  std::vector<std::string> several;
  app.add_option("--several", several, "names");
  EXPECT_EQ(refusal({"--several", "a", ""}), "berm try: --several: must not be empty (see --help)\n");
  EXPECT_NE(refusal({"--json="}).find("--json"), std::string::npos);
}

TEST_F(CommandLine, AnEmptyNameIsTakenWhereItMeansNone) {
  output_or_none(app.add_option("--map", map, "written"));
  EXPECT_EQ(refusal({"--map", ""}), "");
  EXPECT_EQ(map, "");
  EXPECT_EQ(refusal({sweep, "--map", sweep}), "berm try: --map: " + sweep + " is FILE too, and would be overwritten (see --help)\n") << "otherwise it is written";
}

TEST_F(CommandLine, WhatIsReadIsNotOverwritten) {
  EXPECT_EQ(refusal({sweep, "--json", sweep}), "berm try: --json: " + sweep + " is FILE too, and would be overwritten (see --help)\n");
  EXPECT_NE(refusal({sweep, "--json", scratch.path("./sweep.pcd")}), "") << "by another name";
  std::filesystem::create_symlink(sweep, scratch.path("link"));
  EXPECT_NE(refusal({sweep, "--picture", scratch.path("link")}), "") << "through a link";
  EXPECT_NE(refusal({"--other", sweep, "--picture", sweep}), "");
}

TEST_F(CommandLine, TwoResultsDoNotGoIntoOneFile) {
  EXPECT_NE(refusal({"--json", scratch.path("x"), "--picture", scratch.path("x")}), "") << "neither exists yet";
  EXPECT_EQ(refusal({"--json", "/dev/null", "--picture", "/dev/null"}), "");
}

class InScratch {  // the folder that a user would be in
 public:
  explicit InScratch(const test::Scratch& scratch) { std::filesystem::current_path(scratch.path("")); }
  ~InScratch() { std::filesystem::current_path(before_); }

 private:
  const std::filesystem::path before_ = std::filesystem::current_path();
};

TEST_F(CommandLine, TwoNamesOfAFileThatIsNotThereYetAreOne) {
  const InScratch there(scratch);
  EXPECT_EQ(refusal({"--json", "x", "--picture", "./x"}), "berm try: --picture: ./x is --json too (see --help)\n");
  EXPECT_NE(refusal({"--json", "x", "--picture", scratch.path("x")}), "");
  EXPECT_EQ(refusal({"--json", "x", "--picture", "y"}), "");
}

TEST_F(CommandLine, AFileThatIsWrittenUnaskedIsNoOtherEither) {
  const InScratch there(scratch);
  output(app.add_option("--map", map, "written"))->capture_default_str();
  EXPECT_EQ(refusal({"--json", "map.svg"}), "berm try: --map: map.svg is --json too (see --help)\n");
  std::ofstream("map.svg") << "points";
  EXPECT_EQ(refusal({"map.svg"}), "berm try: --map: map.svg is FILE too, and would be overwritten (see --help)\n");
  EXPECT_EQ(refusal({"map.svg", "--map", "other.svg"}), "");
}

TEST_F(CommandLine, AResultThatCannotBeWrittenIsToldOfBeforeTheWork) {
  EXPECT_EQ(refusal({"--json", scratch.path("none/x")}), "berm try: --json: " + scratch.path("none/x") + ": its folder does not exist (see --help)\n");
  EXPECT_EQ(refusal({"--json", scratch.path("")}), "berm try: --json: " + scratch.path("") + ": is a folder (see --help)\n");
}

TEST_F(CommandLine, WhatWasGivenIsGivenAgain) {
  bool flag = false, other_flag = false;
  app.add_flag("--flag", flag);
  app.add_flag("--off", other_flag);
  ASSERT_EQ(refusal({sweep, "--many", "1", "2.50", "--seed", "7", "--flag", "--other", "it's a name"}), "");
  EXPECT_EQ(options_again(app, {"FILE", "--seed"}), " --other 'it'\\''s a name' --many 1 2.50 --flag");
}

using CommandLineDeathTest = CommandLine;

TEST_F(CommandLineDeathTest, AStandardErrorThatTakesNothingChangesNoStatus) {
  const auto refused = [this](bool closed) {
    if (closed) close(STDERR_FILENO);
    else if (std::freopen("/dev/full", "w", stderr) == nullptr) std::exit(9);
    char name[] = "berm try", option[] = "--none";
    char* argv[] = {name, option, nullptr};
    std::exit(parse_options(app, 2, argv).value_or(8));
  };
  EXPECT_EXIT(refused(false), testing::ExitedWithCode(2), "");
  EXPECT_EXIT(refused(true), testing::ExitedWithCode(2), "");
}

TEST_F(CommandLineDeathTest, WhatDoesNotReachStandardOutputIsNoSuccess) {
  const auto prints = [this](const char* to) {
    char name[] = "berm try";
    char* argv[] = {name, nullptr};
    parse_options(app, 1, argv);
    if (std::freopen(to, "w", stdout) == nullptr) std::exit(9);
    std::printf("a result\n");
    std::exit(0);
  };
  EXPECT_EXIT(prints("/dev/null"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(prints("/dev/full"), testing::ExitedWithCode(2), "berm try: standard output: cannot be written: No space left on device");
}

}  // namespace
}  // namespace berm::config
