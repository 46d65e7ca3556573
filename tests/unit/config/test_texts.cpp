// Words of others in our lines and tables: a message stays one short line, a table keeps its columns.
#include <gtest/gtest.h>

#include "config/csv_field.hpp"
#include "config/one_line.hpp"
#include "config/standard_error.hpp"

namespace berm::config {
namespace {

TEST(Texts, AMessageStaysOneLineWhateverANameHolds) {
  testing::internal::CaptureStderr();
  print_error("berm try: {}: cannot be read\n", "a\nb\r\x1b[2J\x7f.pcd");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "berm try: a?b??[2J?.pcd: cannot be read\n");
}

TEST(Texts, WhatALineIsMadeOfStays) {
  EXPECT_EQ(one_line("\r3 of 7 runs\n"), "\r3 of 7 runs\n");
  EXPECT_EQ(one_line("\n"), "\n");
  EXPECT_EQ(one_line(""), "");
  EXPECT_EQ(one_line("gr\xC3\xBC" "n.pcd"), "gr\xC3\xBC" "n.pcd") << "a name beyond ASCII is the user's own";
}

TEST(Texts, WhatAFileHoldsIsQuotedInPart) {
  EXPECT_EQ(excerpt("x y z"), "x y z");
  EXPECT_EQ(excerpt(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(excerpt(std::string(3'000'000, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(excerpt("a\nb\x1b\xFF\0c"), "a?b??");
  EXPECT_EQ(excerpt("abcdef", 3), "abc...");
}

TEST(Texts, AFieldOfATableKeepsItsColumn) {
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("six_wheels up"), "six_wheels up");
  EXPECT_EQ(csv_field("no bed, but a cab"), "\"no bed, but a cab\"");
  EXPECT_EQ(csv_field("the \"long\" one"), "\"the \"\"long\"\" one\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

}  // namespace
}  // namespace berm::config
