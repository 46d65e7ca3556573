// Slices, maps and rules to judge, and a judgement from the words of the header alone.
#pragma once

#include <cstdint>

#include "core/clearance.h"

namespace berm::core_test {

constexpr std::int64_t kSceneNow = 100'000'000;
constexpr std::int32_t kSceneFresh = 20'000'000;

struct Block {
  std::int32_t x_low, x_high, y_low, y_high, z_low, z_high;
};

// A block's eight corners, with six planes: 0 under it, 1 to 4 upright at its sides (-x, +x, -y, +y), 5 slanted under its -x edge.
sk_slice block_slice(std::int32_t link, const Block& block);

// Now, fresh and margin of 300 mm; no own body, no dig zone, no overpass rule.
sk_clearance_rules scene_rules();

// Every cell seen at kSceneNow at this height.
void level(sk_height_map& map, std::int32_t height_mm);

// The same plane for every cell.
void choose(sk_choice& choice, int plane);

// What the header says of one cell: whether a plane separates slice and column, in arithmetic that cannot overflow.
bool separates(const sk_height_map& map, const sk_slice& slice, const sk_clearance_rules& rules, int plane, int iy, int ix);

// Whether the cell is the machine's own; is observed and fresh; may be touched by the dig-zone rule.
bool own_body(const sk_clearance_rules& rules, int iy, int ix);
bool current(const sk_height_map& map, const sk_clearance_rules& rules, int iy, int ix);
bool may_be_dug(const sk_height_map& map, const sk_slice& slice, const sk_clearance_rules& rules, int iy, int ix);

// The whole verdict, every cell judged by itself.
sk_clearance_result judge(const sk_height_map& map, const sk_slice& slice, const sk_choice& choice, const sk_clearance_rules& rules);

bool same(const sk_clearance_result& a, const sk_clearance_result& b);

}  // namespace berm::core_test
