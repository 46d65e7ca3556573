// Values replaced in a machine file's text, and every other byte left.
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "identify/machine_file_text.hpp"
#include "scratch.hpp"

namespace berm::identify::test {
namespace {

class MachineText : public testing::Test {
 protected:
  MachineFileText written(const std::string& text) {
    return MachineFileText(scratch_.write("machine.toml", text));
  }
  berm::test::Scratch scratch_;
};

TEST_F(MachineText, OnlyTheValueChanges) {
  MachineFileText t = written("# a = 1\n[a]  # [b]\nx = 1.5   # one\nname = \"# x = 3 [b]\" # kept\n\n[b]\r\nx = [\n  [1, 2], # ]\n  [3],\n  ]   # after\nxy = 2\n[[c]]\nx = 9\n");
  t.replace("b", "x", "[7]");
  EXPECT_EQ(t.text(), "# a = 1\n[a]  # [b]\nx = 1.5   # one\nname = \"# x = 3 [b]\" # kept\n\n[b]\r\nx = [7]   # after\nxy = 2\n[[c]]\nx = 9\n");
  t.replace("a", "x", "-2");
  t.replace("a", "name", "\"n\"");
  EXPECT_EQ(t.text(), "# a = 1\n[a]  # [b]\nx = -2   # one\nname = \"n\" # kept\n\n[b]\r\nx = [7]   # after\nxy = 2\n[[c]]\nx = 9\n");
}

TEST_F(MachineText, WhatDoesNotStandSoOnceIsRefused) {
  MachineFileText t = written("[a]\nx = 1\n[b]\ny = { x = 2 }\n[a]\nx = 3\n");
  for (const auto& [section, key] : {std::pair{"a", "x"}, std::pair{"b", "x"}, std::pair{"c", "x"}, std::pair{"a", "y"}}) {
    try {
      t.replace(section, key, "0");
      ADD_FAILURE() << section << "." << key;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find(scratch_.path("machine.toml: ") + section + "." + key + ": "), 0u) << error.what();
    }
  }
  EXPECT_EQ(t.text(), "[a]\nx = 1\n[b]\ny = { x = 2 }\n[a]\nx = 3\n");
}

TEST_F(MachineText, TheShippedFileIsTheSameWhereNothingIsReplaced) {
  MachineFileText t(BERM_MACHINE_FILE);
  const std::string before = t.text();
  t.replace("latency", "command", "0.77");
  std::istringstream a(before), b(t.text());
  std::string line_a, line_b;
  int changed = 0;
  while (std::getline(a, line_a) && std::getline(b, line_b)) {
    if (line_a == line_b) continue;
    ++changed;
    EXPECT_EQ(line_b.find("command = 0.77 "), 0u) << line_b;
  }
  EXPECT_EQ(changed, 1);
}

TEST_F(MachineText, TablesThatStandTogetherAreReplacedTogether) {
  MachineFileText t = written("[a]\nx = 1\n\n[r] # note\ny = [\n  [1],\n]\n[r.s.up]\nz = 1\n\n[[part]]\nx = 2\n[rest]\nx = 3\n");
  t.replace_tables("r", "[r]\nnew = 1\n[r.t]\nnew = 2\n");
  EXPECT_EQ(t.text(), "[a]\nx = 1\n\n[r]\nnew = 1\n[r.t]\nnew = 2\n\n[[part]]\nx = 2\n[rest]\nx = 3\n");
  t.replace_tables("r", "[r]\nnew = 4\n");
  EXPECT_EQ(t.text(), "[a]\nx = 1\n\n[r]\nnew = 4\n\n[[part]]\nx = 2\n[rest]\nx = 3\n");
}

TEST_F(MachineText, TablesThatAreMissingComeToTheEnd) {
  MachineFileText t = written("[a]\nx = 1");
  t.replace_tables("r", "[r]\nnew = 1\n");
  EXPECT_EQ(t.text(), "[a]\nx = 1\n\n[r]\nnew = 1\n");
  t.replace_tables("r", "[r]\nnew = 2\n");
  EXPECT_EQ(t.text(), "[a]\nx = 1\n\n[r]\nnew = 2\n") << "once";
}

TEST_F(MachineText, TablesThatStandApartAreRefused) {
  MachineFileText t = written("[r]\nx = 1\n[a]\nx = 1\n[r.s]\nx = 2\n");
  EXPECT_THROW(t.replace_tables("r", "[r]\n"), std::runtime_error);
  EXPECT_EQ(t.text(), "[r]\nx = 1\n[a]\nx = 1\n[r.s]\nx = 2\n");
}

}  // namespace
}  // namespace berm::identify::test
