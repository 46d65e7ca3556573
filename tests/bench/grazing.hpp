// Bodies with integer coordinates that graze a column by distances known exactly: who says what.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace berm::bench {

struct GrazingRow {
  std::string distance;
  bool contact;  // what is true: touching is contact
  int cases;
  double micrometres_least, micrometres_most;
  int ours, fcl, bullet, bullet_no_margin;  // how many are called contact (ours: not clear)
};

// A block over the corner of a column, its lower face sloping, the corner in the middle of the face or off it by a known distance.
std::vector<GrazingRow> grazing_table(std::uint32_t seed);

}  // namespace berm::bench
