// Four floats at a time, by the compilers' own vector types (GCC, Clang; any processor). A length of 10 m is good to a micrometre here.
#pragma once

#include <cstdint>
#include <cstring>

// A function so marked is compiled twice, and the loader takes what the processor has. Both do the same operations in the same order (no fused
// multiply-add), so that the results are the same bit for bit.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define BERM_APP_LANES __attribute__((target_clones("avx2", "default")))
#else
#define BERM_APP_LANES
#endif

namespace berm::app {

using Four = float __attribute__((vector_size(16)));
using FourInt = std::int32_t __attribute__((vector_size(16)));  // of a comparison: all bits or none

inline Four four(double v) {
  const auto f = static_cast<float>(v);
  return Four{f, f, f, f};
}
inline Four most4(Four a, Four b) { return a > b ? a : b; }
inline Four least4(Four a, Four b) { return a < b ? a : b; }
inline FourInt bits4(Four a) {
  FourInt out;
  std::memcpy(&out, &a, sizeof out);
  return out;
}
inline Four floats4(FourInt a) {
  Four out;
  std::memcpy(&out, &a, sizeof out);
  return out;
}
inline Four magnitude4(Four a) { return floats4(bits4(a) & 0x7FFFFFFF); }
// Where the mask is set, 0 elsewhere.
inline Four where4(FourInt mask, Four a) { return floats4(bits4(a) & mask); }
inline Four choose4(FourInt mask, Four then, Four otherwise) { return floats4((bits4(then) & mask) | (bits4(otherwise) & ~mask)); }
inline float sum4(Four a) { return (a[0] + a[1]) + (a[2] + a[3]); }
inline int sum4(FourInt a) { return a[0] + a[1] + a[2] + a[3]; }

}  // namespace berm::app
