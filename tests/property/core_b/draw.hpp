// Draws over whole ranges: RapidCheck by itself keeps to a part of a range in its first cases. Not shrunk: with hundreds of draws a case, that
// would take minutes; a failing case is repeated by its seed.
#pragma once

#include <rapidcheck.h>

namespace berm::core_test {

template <typename T>
T draw(T low, T high) {  // both included
  return *rc::gen::noShrink(rc::gen::resize(rc::kNominalSize, rc::gen::inRange<T>(low, static_cast<T>(high + 1))));
}

inline bool chance(int percent) { return draw(0, 99) >= 100 - percent; }

}  // namespace berm::core_test
