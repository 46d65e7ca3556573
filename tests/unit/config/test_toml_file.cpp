// What lies too deep in a TOML file is refused before toml11's recursion meets it, and nothing else is.
#include "config/toml_file.hpp"

#include <gtest/gtest.h>

#include "config/strict_table.hpp"
#include "edited_file.hpp"

namespace berm::config::test {
namespace {

std::string times(std::size_t count, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

// What is said behind the file's name.
std::string verdict(const std::string& text) {
  const Scratch scratch;
  const std::string path = scratch.write("file.toml", text);
  try {
    StrictTable::parse_file(path);
  } catch (const ConfigError& error) {
    return std::string(error.what()).substr(path.size());
  }
  return "read";
}

// verifies: IF-CF-24
TEST(TomlFile, TooDeepIsRefusedInEachForm) {
  const std::string refused = ": line 2: nested more than 100 deep";
  for (const std::size_t n : {101, 10000, 100000}) {
    EXPECT_EQ(verdict("b = 1\na = " + times(n, "[") + times(n, "]")), refused) << n;
    EXPECT_EQ(verdict("b = 1\na = " + times(n, "{a = ") + "1" + times(n, "}")), refused) << n;
    EXPECT_EQ(verdict("b = 1\na" + times(n, ".a") + " = 1\n"), refused) << n;
    EXPECT_EQ(verdict("b = 1\n[a" + times(n, ".a") + "]\n"), refused) << n;
    EXPECT_EQ(verdict("b = 1\n[[a" + times(n, " . \"a\"") + "]]\n"), refused) << n;
  }
  EXPECT_EQ(verdict("b = 1\na = " + times(10, "{a.a.a.a.a.a.a.a.a.a.a = ") + "1" + times(10, "}")), refused);
  EXPECT_EQ(verdict("a = [" + times(10000, "[\n")), ": line 100: nested more than 100 deep");
}

// verifies: IF-CF-24
TEST(TomlFile, NotSoDeepIsRead) {
  EXPECT_EQ(verdict("a = " + times(100, "[") + times(100, "]")), "read");
  EXPECT_EQ(verdict("a = " + times(99, "{a = ") + "1" + times(99, "}")), "read");
  EXPECT_EQ(verdict("a" + times(99, ".a") + " = 1.5\n"), "read");
  EXPECT_EQ(verdict("[a" + times(99, ".a") + "]\na" + times(99, ".a") + " = 1.5\n"), "read");
}

// verifies: IF-CF-24
TEST(TomlFile, WhatNestsNothingIsNotCounted) {
  const std::string deep = times(200, "[{.");
  EXPECT_EQ(verdict("# " + deep + "\na = 1 # " + deep), "read");
  EXPECT_EQ(verdict("a = \"\\\"" + deep + "\\\\\"\nb = '" + deep + "\\'\n'" + deep + "' = 1\n"), "read");
  EXPECT_EQ(verdict("a = \"\"\"\n" + deep + "\n\"\" \\\"\"\" " + deep + "\"\"\"\"\"\n"), "read");
  EXPECT_EQ(verdict("b = '''\n" + deep + "\n'' " + deep + "''''\nc = ''\n"), "read");
  EXPECT_EQ(verdict("a = [" + times(1000, "1.5, ") + "]\nb = [\n" + times(1000, "[1.5, 2.5],\n") + "]\n"), "read");
  std::string tables;
  for (int i = 0; i < 1000; ++i) tables += "[t" + std::to_string(i) + ".a]\nb.c = {d = [1.5]}\n";
  EXPECT_EQ(verdict(tables), "read");
}

// verifies: IF-CF-24
TEST(TomlFile, BehindATextItIsCountedAgain) {
  for (const char* text : {R"("\"")", R"("\\")", "''", R"('\')", "\"\"\"\n\"\"\"\"\"", "''''''''", "'#'"})
    EXPECT_NE(verdict("a = [" + std::string(text) + ", " + times(10000, "[")).find("nested more than 100 deep"), std::string::npos) << text;
}

// verifies: IF-CF-24
// A line costs toml11 the square of its length: a megabyte would be minutes.
TEST(TomlFile, ALongLineIsRefused) {
  EXPECT_EQ(verdict("a = 1\nb = [" + times(200000, "1,") + "1]\n"), ": line 2: more than 10000 bytes");
  EXPECT_EQ(verdict("b = '" + std::string(9994, 'x') + "'\n"), "read");
  EXPECT_EQ(verdict("# " + std::string(9999, 'x')), ": line 1: more than 10000 bytes");
}

// A device has no end: reading all of it would take all memory.
TEST(TomlFile, WhatHasNoEndIsRefused) {
  try {
    StrictTable::parse_file("/dev/zero");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "/dev/zero: more than 1048576 bytes");
  }
}

// verifies: IF-CF-1
TEST(TomlFile, AKeyThatIsDefinedAgainIsNamed) {
  EXPECT_EQ(verdict("a = 1\nb = 2\na = 3\n"), ": line 3: not valid TOML: a is defined already");
  EXPECT_EQ(verdict("[t]\na = 1\nb = 2\na = [\n3,\n4]\n"), ": line 4: not valid TOML: a is defined already");
  EXPECT_EQ(verdict("[t]\na = 1\n[u]\n[t]\nb = 1\n"), ": line 4: not valid TOML: t is defined already");
  EXPECT_EQ(verdict("[t.u]\na = 1\n[t.u]\na = 1\n"), ": line 3: not valid TOML: t.u is defined already");
  EXPECT_EQ(verdict("t.a = 1\nt.a = 2\n"), ": line 2: not valid TOML: t.a is defined already");
  EXPECT_EQ(verdict("t = {a = 1,\ta = 2}\n"), ": line 1: not valid TOML: a is defined already");
  EXPECT_EQ(verdict("t = {a = 1}\nt.b = 2\n"), ": line 2: not valid TOML: t is defined already");
  EXPECT_EQ(verdict("a = 1\n[a.b]\nc = 1\n"), ": line 2: not valid TOML: a is defined already");
  EXPECT_EQ(verdict("[a]\nb = 1\n[[a]]\nb = 1\n"), ": line 3: not valid TOML: a is defined already");
  EXPECT_EQ(verdict("a = [1]\n[[a]]\nb = 1\n"), ": line 2: not valid TOML: a is defined already");
  EXPECT_EQ(verdict("\"a (b)\" = 1\n\"a (b)\" = 1\n"), ": line 2: not valid TOML: a (b) is defined already");
  EXPECT_EQ(verdict("\"a\\nb\" = 1\n\"a\\nb\" = 1\n"), ": line 2: not valid TOML") << "its error would be two lines";
}

TEST(TomlFile, AKeyOrANumberOfThousandsIsQuotedInPart) {
  const std::string key(3000, 'k'), number(3000, '9');
  EXPECT_EQ(verdict(key + " = 1\n" + key + " = 1\n"), ": line 2: not valid TOML: " + key.substr(0, 60) + "... is defined already");
  const std::string refusal = verdict("a." + key + " = " + number + "\n");
  EXPECT_EQ(refusal.rfind(": a." + key.substr(0, 78) + "...: " + number.substr(0, 80) + "... is outside ", 0), 0U) << refusal;
}

// verifies: IF-CF-1
// toml11 makes 9223372036854775807 of it, and of a binary one its last 64 digits.
TEST(TomlFile, ANumberThatFitsNowhereIsNamedAsItStands) {
  const std::string integers = " is outside -9223372036854775808 .. 9223372036854775807";
  EXPECT_EQ(verdict("[t]\na = 99_999_999_999_999_999_999\n"), ": t.a: 99999999999999999999" + integers);
  for (const char* number : {"9223372036854775808", "-9223372036854775809", "+99999999999999999999", "0xFFFFFFFFFFFFFFFF", "0o7777777777777777777777"})
    EXPECT_EQ(verdict("b = 1\na.c = [1, " + std::string(number) + "] # more\n"), ": a.c: " + std::string(number) + integers);
  const std::string binary = "0b1" + std::string(63, '0');
  EXPECT_EQ(verdict("[[u]]\n[[u]]\na = " + binary + "101\n"), ": u[1].a: " + binary + "101" + integers);
  EXPECT_EQ(verdict("a = [[1], [" + binary + "]]\n"), ": a: " + binary + integers);
  EXPECT_NE(verdict("a = -1e999\n").find(": a: -1e999 is outside -1.79"), std::string::npos);
}

TEST(TomlFile, TheLastNumberThatFitsIsRead) {
  EXPECT_EQ(verdict("a = [9223372036854775807, -9223372036854775808, +9_223_372_036_854_775_807, 0x7FFFFFFFFFFFFFFF, 0o777777777777777777777]\n"), "read");
  EXPECT_EQ(verdict("a = 0b" + std::string(63, '1') + "\nb = 1\nc = -1_0\n"), "read");
  EXPECT_EQ(verdict("a = 0b" + std::string(10, '0') + std::string(63, '1') + "\nb = 1\nc = -1_0\nd = 0xF\ne = +5\n"), "read");
  EXPECT_EQ(verdict("a = [1.7976931348623157e308, -1.7976931348623157e308, inf, -inf, nan, 1e-999]\n"), "read");
}

// verifies: IF-CF-24
// Each is looked up in the text, which costs a walk through all of it.
TEST(TomlFile, ManyNumbersThatMayNotFitAreRefused) {
  const std::string most = ": more than 200 numbers that may not fit into 64 bits", last = "9223372036854775807,", binary = "a = 0b" + std::string(64, '0') + "\n";
  EXPECT_EQ(verdict("a = [" + times(200, last) + "]\n"), "read");
  EXPECT_EQ(verdict("a = 1\nb.c = [" + times(201, last) + "]\n"), ": b.c" + most);
  EXPECT_EQ(verdict(binary + "b = [" + times(199, "1,") + "]\n"), "read");
  EXPECT_NE(verdict(binary + "b = [" + times(200, "1,") + "]\n").find(most), std::string::npos) << "at either, for tables have no order";
  EXPECT_EQ(verdict("a = [" + times(201, "1.7976931348623157e308,") + "]\n"), ": a" + most);
}

TEST(TomlFile, OtherRefusalsStayAsTheyAre) {
  EXPECT_EQ(verdict("a = = 1\n"), ": line 1: not valid TOML");
  EXPECT_EQ(verdict(""), "read");
  const Scratch scratch;
  EXPECT_THROW(parse_toml_file(scratch.path("none.toml")), ConfigError);
  EXPECT_THROW(parse_toml_file(scratch.folder()), ConfigError);
}

}  // namespace
}  // namespace berm::config::test
