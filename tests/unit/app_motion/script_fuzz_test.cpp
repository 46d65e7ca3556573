// Scripts as any bytes: taken whole, or refused with one line. BERM_SAMPLES sets the number of mutants.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "sample_script.hpp"

namespace {

using namespace berm::app;
using namespace berm::app::test;

TEST(ScriptTextFuzz, AnyBytes) {
  const char* samples = std::getenv("BERM_SAMPLES");
  const int count = samples != nullptr ? std::atoi(samples) : 20000;
  constexpr unsigned seed = 31;
  std::mt19937 random(seed);
  const auto draw = [&random] { return static_cast<unsigned>(random()); };
  static const std::string pieces[] = {"-1", "1e999", "nan", "\n", "\"", ":", "#", "rule", "when", "and", "deg", "goal", "joint boom", "\xFF", std::string(3, '\0'), "360.0001 deg", " + "};
  int accepted = 0, refused = 0;
  for (int i = 0; i < count; ++i) {
    std::string bytes = good;
    for (unsigned edits = draw() % 3 + 1; edits > 0 && !bytes.empty(); --edits) {
      const std::size_t at = draw() % bytes.size();
      switch (draw() % 5) {
        case 0: bytes[at] = static_cast<char>(draw()); break;
        case 1: bytes.resize(at); break;
        case 2: bytes.erase(at, draw() % 9); break;
        case 3: bytes.insert(at, bytes.substr(draw() % bytes.size(), draw() % 60)); break;
        default: bytes.insert(at, pieces[draw() % std::size(pieces)]);
      }
    }
    try {
      const Script script = parsed(bytes).bind(std::vector<double>{1.6, 0.6, -1.5, -0.4}, 1.0);
      ++accepted;
      for (const Joint j : {swing, boom, stick, bucket}) {
        ASSERT_FALSE(script.of(j).rules().empty());
        for (const Rule& rule : script.of(j).rules()) {
          ASSERT_TRUE(std::isfinite(rule.goal) && rule.pace > 0.0 && rule.pace <= 1.0);
          for (const Condition& c : rule.conditions) ASSERT_TRUE(std::isfinite(c.threshold) && std::isfinite(c.tolerance));
        }
      }
    } catch (const ScriptError& error) {
      ++refused;
      const std::string line = error.what();
      ASSERT_EQ(line.rfind("my.script: ", 0), 0U) << line << ", mutant " << i << " of seed " << seed;
      for (const char c : line) ASSERT_TRUE(c >= ' ' && c <= '~') << "mutant " << i << " of seed " << seed;
    }
  }
  EXPECT_GT(refused, count / 4);
  EXPECT_GT(accepted, count / 100);
  printf("%d accepted, %d refused, seed %u\n", accepted, refused, seed);
}

}  // namespace
