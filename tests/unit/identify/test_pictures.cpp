// A machine may be called anything, and its pictures stay XML.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "identify/braking_picture.hpp"
#include "identify/step_picture.hpp"
#include "scratch.hpp"

namespace berm::identify {
namespace {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Pictures, TheMachinesNameIsEscaped) {
  const test::Scratch scratch;
  const config::MachineFile machine = config::load_machine_file(BERM_MACHINE_FILE);
  Result braking;
  StepResult steps;
  braking.machine_name = steps.machine_name = "a<b>&c";
  write_braking_picture(scratch.path("braking.svg"), braking, machine, {});
  write_step_picture(scratch.path("steps.svg"), steps, machine, {});
  for (const char* name : {"braking.svg", "steps.svg"}) {
    EXPECT_NE(text_of(scratch.path(name)).find(" of a&lt;b&gt;&amp;c (simulation)"), std::string::npos) << name;
    EXPECT_EQ(text_of(scratch.path(name)).find("<b>"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace berm::identify
