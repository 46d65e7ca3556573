// The page's table against the figures computed from the machine's parameters: no side is less, and none more than the last digit.
#include <gtest/gtest.h>

#include <iostream>

#include "figures.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

void expect_rounded_up(double stated, double computed, const std::string& where) {
  if (computed == Hidden::kAny || computed == Hidden::kNone) {
    EXPECT_EQ(stated, computed) << where;
    return;
  }
  EXPECT_GE(stated + 1e-9, computed) << where;
  EXPECT_LT(stated, computed + 0.01) << where;
}

// verifies: SK-FI-1, SK-FI-2, SK-FI-3, SK-FI-4, SK-FI-5, SK-FI-6, SK-FI-7, SK-FI-8, SK-FI-9, SK-FI-10, SK-FI-11, SK-FI-12, SK-FI-13, SK-FI-14
TEST(FiltersPage, StatesWhatIsComputed) {
  const std::vector<Row> computed = computed_rows(berm::test::demo_parameters()), page = page_rows();
  ASSERT_EQ(page.size(), computed.size());
  for (std::size_t r = 0; r < page.size(); ++r) {
    EXPECT_EQ(page[r].id, computed[r].id);
    EXPECT_EQ(page[r].what, computed[r].what);
    for (std::size_t d = 0; d < kDistances.size(); ++d) {
      const std::string where = page[r].id + " " + page[r].what + " at " + std::to_string(kDistances[d]);
      std::cout << where << ": " << computed[r].at[d].width << " x " << computed[r].at[d].height << ", " << computed[r].at[d].seconds << " s\n";
      expect_rounded_up(page[r].at[d].width, computed[r].at[d].width, where + ", width");
      expect_rounded_up(page[r].at[d].height, computed[r].at[d].height, where + ", height");
      expect_rounded_up(page[r].at[d].seconds, computed[r].at[d].seconds, where + ", seconds");
    }
  }
}

// verifies: SK-FI-1, SK-FI-8
TEST(FiltersPage, SaysHowFastAChildIsFound) {
  constexpr double kChild = 0.16;  // m, from the side
  const berm_parameters parameters = berm::test::demo_parameters();
  const std::array<double, 3> stated = child_rates();
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    const double rate = (kChild - beam_width(parameters, kDistances[d])) / line_gap(kDistances[d], 1.0) * 180.0 / 3.14159265358979323846;
    EXPECT_LE(stated[d], rate) << kDistances[d] << " m";
    EXPECT_GT(stated[d], rate - 1.0) << kDistances[d] << " m";
  }
}

}  // namespace
}  // namespace berm::kernel::test
