// The table of requirements/separation.md: what ISO 13855's distance leaves of the demonstration machine, by how often its sensors see a direction.
// Worked out by the core's functions; the document must have these very lines.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "core/governor.h"
#include "io/sector_watch.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

struct Sensing {
  double revisit_s, wait_s, period_s;
};

std::string metres(std::int64_t mm) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", std::ceil(static_cast<double>(mm) / 100.0) / 10.0);
  return text;
}

class SeparationTable {
 public:
  SeparationTable() { parameters_.workspace_separation = BERM_SEPARATION_ENFORCED; }
  std::string line(const Sensing& sensing) {
    parameters_.workspace_wait_us = static_cast<std::int32_t>(std::lround(sensing.wait_s * 1e6));
    parameters_.workspace_period_us = static_cast<std::int32_t>(std::lround(sensing.period_s * 1e6));
    const SectorWatch watch(parameters_);
    rules_ = watch.rules();
    blind_us_ = static_cast<std::int32_t>(std::lround(sensing.revisit_s * 1e6));
    char head[96];
    const double told_s = (blind_us_ + rules_.detect_us) * 1e-6;
    std::snprintf(head, sizeof head, "| %.1f | %.1f, %.1f | %.2f |", sensing.revisit_s, sensing.wait_s, sensing.period_s, told_s);
    std::string text = head;
    for (const std::string& cell : {radius(7'500, 0), radius(7'500, fastest_us(7'500)), radius(10'340, fastest_us(10'340)), speed(5'500, 12'000),
                                    speed(7'500, 12'000), speed(7'500, 15'000)})
      text += " " + cell + " |";
    return text;
  }

 private:
  std::int32_t row(std::int32_t reach_mm) const { return sk_brake_row(&parameters_, reach_mm); }
  std::int64_t fastest_us(std::int32_t reach_mm) const {
    return sk_governor_stop_time(&parameters_, BERM_SWING, row(reach_mm), parameters_.velocity_max_urad_s[BERM_SWING]);
  }
  std::string radius(std::int32_t reach_mm, std::int64_t stop_us) const {
    return metres(reach_mm + sk_separation_distance(rules_.approach_mm_s, blind_us_ + rules_.detect_us + stop_us, rules_.intrusion_mm));
  }
  std::string speed(std::int32_t reach_mm, std::int32_t radius_mm) const {
    const std::int32_t stop_us = sk_separation_stop_time(rules_, blind_us_, radius_mm - reach_mm);
    const std::int32_t level = sk_governor_timed_level(&parameters_, BERM_SWING, row(reach_mm), stop_us);
    if (level == 0) return "denied";
    const double degrees_s = sk_governor_timed_speed(&parameters_, BERM_SWING, level) * 1e-6 * 180.0 / 3.14159265358979323846;
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", std::floor(10.0 * degrees_s) / 10.0);
    return text;
  }

  berm_parameters parameters_ = berm::test::demo_parameters();
  sk_separation_rules rules_{};
  std::int32_t blind_us_ = 0;
};

// verifies: SK-SD-18
TEST(SeparationTableTest, StandsInTheRequirements) {
  constexpr Sensing kSensing[] = {{0.1, 0.0, 0.1}, {0.1, 0.2, 0.1}, {0.1, 2.0, 0.5}, {1.0, 0.2, 0.1},
                                  {5.0, 0.2, 0.1}, {5.0, 2.0, 0.5}, {15.0, 2.0, 0.5}};
  std::ifstream file(std::string(BERM_SOURCE_DIR) + "/safety_kernel/requirements/separation.md");
  std::ostringstream document;
  document << file.rdbuf();
  SeparationTable table;
  std::string lines;
  for (const Sensing& sensing : kSensing) lines += table.line(sensing) + "\n";
  std::printf("%s", lines.c_str());
  EXPECT_NE(document.str().find("|---|---|---|---|---|---|---|---|---|\n" + lines), std::string::npos) << "the document has another table";
}

}  // namespace
}  // namespace berm::kernel::test
