// The structures have one layout in C11 and C++17, every field is naturally aligned, and there is no hidden padding.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>

#include "contract/berm_contract.h"
#include "layout.h"

namespace {

// verifies: IF-CT-1, IF-CF-3
TEST(Layout, TheSameInC11AndCxx17) {
  std::size_t in_c = 0, in_cxx = 0;
  const layout_entry* c = layout_c11(&in_c);
  const layout_entry* cxx = layout_cxx17(&in_cxx);
  ASSERT_EQ(in_c, in_cxx);
  ASSERT_GT(in_c, 100u);
  for (std::size_t i = 0; i < in_c; ++i) {
    std::printf("%-22s %-24s %7zu %7zu | %7zu %7zu\n", c[i].type, c[i].field, c[i].offset, c[i].size, cxx[i].offset, cxx[i].size);
    EXPECT_STREQ(c[i].type, cxx[i].type);
    EXPECT_STREQ(c[i].field, cxx[i].field);
    EXPECT_EQ(c[i].offset, cxx[i].offset) << c[i].type << "." << c[i].field;
    EXPECT_EQ(c[i].size, cxx[i].size) << c[i].type << "." << c[i].field;
  }
}

// verifies: IF-CT-2, IF-CF-3
TEST(Layout, NoHiddenPadding) {
  std::size_t count = 0;
  const layout_entry* entry = layout_cxx17(&count);
  std::size_t end = 0, structures = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool whole = entry[i].field[0] == '\0';
    EXPECT_EQ(entry[i].offset, end) << entry[i].type << "." << (whole ? "end" : entry[i].field);
    end = whole ? 0 : entry[i].offset + entry[i].size;
    structures += whole ? 1 : 0;
  }
  EXPECT_EQ(structures, 16u);
}

// verifies: IF-CT-2
TEST(Layout, TheSizesThatPeersCheck) {
  std::size_t count = 0;
  const layout_entry* entry = layout_cxx17(&count);
  std::map<std::string, std::size_t> size;
  for (std::size_t i = 0; i < count; ++i)
    if (entry[i].field[0] == '\0') size[entry[i].type] = entry[i].offset;
  EXPECT_EQ(size["berm_request"], 64u);
  EXPECT_EQ(size["berm_request_segment"], 128u);
  EXPECT_EQ(size["berm_state"], 320u);
  EXPECT_EQ(size["berm_scan_block"], 2200u);
  EXPECT_EQ(size["berm_decision"], 176u);
  EXPECT_EQ(size["berm_slice"], 296u);
  EXPECT_EQ(size["berm_welcome"], 128u);
  EXPECT_EQ(size["berm_state_segment"], 64u + 320 + 256 * 176 + 64 * 2200 + 96 * 296 + 5 * 104 * 104);
}

}  // namespace
