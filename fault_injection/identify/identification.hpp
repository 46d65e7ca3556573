// A whole identification: the runs, the bounds, the files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace berm::identify {

struct Options {
  std::string machine = "zx200";
  std::string scenario = "identify", scenario_empty = "identify_empty";
  std::string out, json, picture;     // out: empty for NAME_measured.toml; json, picture: empty for none
  std::string plant_out;              // empty: what the plant writes is thrown away
  std::uint64_t seed = 1;
  int repetitions = 3;
  double allowance = 0.10;
  std::vector<std::size_t> joints;    // rising; empty: all
  std::vector<std::size_t> columns;   // rising, 1..7; empty: all
  bool quiet = false;
};

// Throws std::exception with one line (run::ToldAlready with none) and then leaves no file behind.
void identify(const Options& options);

}  // namespace berm::identify
