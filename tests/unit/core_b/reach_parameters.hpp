// A parameter block with round figures: what the reach box reads, and zero elsewhere.
#pragma once

#include "config/parameter_block.h"
#include "core/reach_box.h"

namespace berm::core_test {

// 0.1 s from measurement to the stop; 1 rad/s2; errors of 1 mrad and 2 mrad/s; columns of 0.1 rad/s up to 0.7 rad/s;
// brake angle (row + 1) * column * 10 mrad + joint; reaches 3, 6, 9, 12 m.
berm_parameters reach_parameters();

sk_reach_box untouched_box();
bool same(const sk_reach_box& a, const sk_reach_box& b);

}  // namespace berm::core_test
