// What a run makes of the end of a child that was to look at its input.
#include <gtest/gtest.h>

#include "run/child_process.hpp"
#include "run/parameter_file.hpp"

namespace berm::run {
namespace {

void end(const std::string& script) {
  ChildProcess child;
  ChildOptions options;
  options.program = "/bin/sh";
  options.arguments = {"-c", script};
  child.start(options);
  ASSERT_TRUE(child.wait_ended(20.0));
  expect_content(child);
}

TEST(Content, AnExitIsTrustedToHaveToldWhy) {
  EXPECT_NO_THROW(end("exit 0"));
  EXPECT_THROW(end("exit 2"), ToldAlready);
}

TEST(Content, ASignalIsTold) {
  try {
    end("kill -SEGV $$");
    FAIL() << "content";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "sh died: signal 11 (Segmentation fault)");
  }
}

}  // namespace
}  // namespace berm::run
