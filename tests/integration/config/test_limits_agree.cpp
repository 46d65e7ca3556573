// Whatever the compiler of machine and site files takes, the kernel's own check takes too: no user meets a refusal without a field's name.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <regex>

#include "config/compile_parameters.hpp"
#include "config/strict_table.hpp"
#include "core/parameter_check.h"
#include "edited_file.hpp"

namespace berm::config::test {
namespace {

// verifies: IF-CF-7
TEST(LimitsAgree, TheDefaultsPassTheKernelsCheck) {
  const berm_parameters p = compile_parameters(load_machine_file(machine_path()), load_site_file(site_path()));
  EXPECT_EQ(sk_parameters_check(&p), SK_RULE_NONE);
  for (const char* name : {"/machines/zx200_rear.toml", "/machines/zx200_ring.toml"}) {
    const berm_parameters with_lidars = compile_parameters(load_machine_file(std::string(BERM_CONFIG_FILES) + name), load_site_file(site_path()));
    EXPECT_EQ(sk_parameters_check(&with_lidars), SK_RULE_NONE) << name;
    EXPECT_EQ(with_lidars.lidars, 2) << name;
  }
}

// At the very ends of ranges by which a block could void the guarantees.
// verifies: IF-CF-7
TEST(LimitsAgree, TheEndsOfTheRangesPassTheKernelsCheck) {
  const Scratch scratch;
  for (const auto& [from, to] : {std::pair{"\nmargin = 0.30", "\nmargin = 0.1"}, std::pair{"cycle = 0.01", "cycle = 0.02"}, std::pair{"cycle = 0.01", "cycle = 0.001"},
                                 std::pair{"state = 0.02", "state = 0.01"}, std::pair{"command = 0.09", "command = 0.01"},
                                 std::pair{"angle_error_deg = 0.15", "angle_error_deg = 0.02"}, std::pair{"velocity_error_deg_s = 0.3", "velocity_error_deg_s = 0.01"},
                                 std::pair{"creep_deg_s = 3.0", "creep_deg_s = 15.0"}, std::pair{"dig_swing_limit_deg_s = 6.0", "dig_swing_limit_deg_s = 15.0"}}) {
    const std::string path = scratch.write("edited.toml", replaced(read_text(machine_path()), from, to));
    const berm_parameters p = compile_parameters(load_machine_file(path), load_site_file(site_path()));
    EXPECT_EQ(sk_parameters_check(&p), SK_RULE_NONE) << to;
  }
}

// verifies: IF-CF-7, IF-CF-25
TEST(LimitsAgree, TheShortestStopsTakenPassTheKernelsCheck) {
  const Scratch scratch;
  const std::string good = read_text(machine_path());
  for (const char* measured : {"0.41", "0.8", "3.21", "4.64"}) {
    const auto with = [&](double acceleration) {
      char value[40];
      std::snprintf(value, sizeof value, "%.12f", acceleration);
      const std::string key = "acceleration_max_rad_s2 = ";
      return scratch.write("edited.toml", replaced(good, key + measured, key + value));
    };
    double refused = 0.01, taken = std::stod(measured);
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (refused + taken);
      try {
        load_machine_file(with(middle));
        taken = middle;
      } catch (const ConfigError& error) {
        EXPECT_NE(std::string(error.what()).find("a stop at 4 times acceleration_max_rad_s2"), std::string::npos) << error.what();
        refused = middle;
      }
    }
    EXPECT_LT(taken, 0.5 * std::stod(measured)) << "a table that was measured is far from it";
    EXPECT_GT(taken, 0.02);
    const berm_parameters p = compile_parameters(load_machine_file(with(taken)), load_site_file(site_path()));
    EXPECT_EQ(sk_parameters_check(&p), SK_RULE_NONE) << taken;
  }
}

// Replaces the number at a place by one that is near, far, at a round limit, or nonsense.
double strange(double value, std::mt19937_64& random) {
  static constexpr double kSpecial[] = {0.0, 1e-9, 0.001, 0.01, 0.05, 0.1, 0.3, 0.5, 1.0, 3.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 60.0, 120.0, 180.0, 200.0, 360.0, 1e6};
  constexpr std::size_t kCount = sizeof kSpecial / sizeof kSpecial[0];
  std::uniform_real_distribution<double> factor(0.3, 3.0);
  switch (random() % 4) {
    case 0: return kSpecial[random() % kCount];
    case 1: return -kSpecial[random() % kCount];
    case 2: return value * factor(random);
    default: return value * (random() % 2 == 0 ? 0.999 : 1.001);
  }
}

// Text with one or two of its numbers replaced.
std::string disturbed(const std::string& text, std::mt19937_64& random) {
  static const std::regex number(R"((=|\[|,)\s*(-?[0-9]+\.?[0-9]*)\b)");
  std::vector<std::smatch> found;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), number); it != std::sregex_iterator(); ++it) found.push_back(*it);
  const std::smatch& one = found[random() % found.size()];
  char value[40];
  std::snprintf(value, sizeof value, "%.9f", strange(std::stod(one[2]), random));
  std::string out = text;
  return out.replace(static_cast<std::size_t>(one.position(2)), static_cast<std::size_t>(one.length(2)), value);
}

// verifies: IF-CF-7
TEST(LimitsAgree, WhatIsTakenHerePassesTheKernelsCheck) {
  const char* text = std::getenv("BERM_SEED");
  const std::uint64_t seed = text != nullptr ? std::stoull(text) : 20261121;
  std::printf("seed %llu (BERM_SEED=%llu repeats it)\n", static_cast<unsigned long long>(seed), static_cast<unsigned long long>(seed));
  std::mt19937_64 random(seed);
  const Scratch scratch;
  const std::string machine = read_text(machine_path()), site = read_text(site_path());
  int taken = 0, refused = 0;
  for (int i = 0; i < 600; ++i) {
    const bool of_machine = random() % 5 != 0;
    const std::string edited = disturbed(disturbed(of_machine ? machine : site, random), random);
    const std::string path = scratch.write("edited.toml", edited);
    berm_parameters p{};
    try {
      p = compile_parameters(load_machine_file(of_machine ? path : machine_path()), load_site_file(of_machine ? site_path() : path));
    } catch (const ConfigError&) {
      ++refused;
      continue;
    }
    ++taken;
    const std::int32_t rule = sk_parameters_check(&p);
    ASSERT_EQ(rule, SK_RULE_NONE) << "draw " << i << " breaks rule " << rule << "; the file:\n" << edited;
  }
  std::printf("%d taken, %d refused\n", taken, refused);
  EXPECT_GT(taken, 30);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace berm::config::test
