// Four floats at a time, by the compilers' own vector types (GCC, Clang; any processor). A length of 10 m is good to a micrometre here.
#ifndef BERM_KERNEL_GEOMETRY_LANES_HPP
#define BERM_KERNEL_GEOMETRY_LANES_HPP

#include <cstdint>
#include <cstring>

// A function so marked is compiled twice, and the loader takes what the processor has. Both do the same operations in the same order (no fused
// multiply-add), so that the results are the same bit for bit.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define BERM_LANES_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define BERM_LANES_CLONES
#endif

namespace berm::kernel {

using Four = float __attribute__((vector_size(16)));
using FourInt = int32_t __attribute__((vector_size(16)));
using FourDouble = double __attribute__((vector_size(32)));
using FourLong = int64_t __attribute__((vector_size(32)));

inline Four load4(const float* from) noexcept {
  Four v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline FourInt load4(const int32_t* from) noexcept {
  FourInt v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store4(float* to, Four v) noexcept { std::memcpy(to, &v, sizeof v); }
inline void store4(int32_t* to, FourInt v) noexcept { std::memcpy(to, &v, sizeof v); }
inline Four four(float v) noexcept { return Four{v, v, v, v}; }

inline Four most4(Four a, Four b) noexcept { return a > b ? a : b; }
inline Four least4(Four a, Four b) noexcept { return a < b ? a : b; }
inline Four magnitude4(Four a) noexcept { return most4(a, -a); }

// The last three of a, then the first of b.
inline Four next4(Four a, Four b) noexcept { return __builtin_shufflevector(a, b, 1, 2, 3, 4); }

// To the nearest integer, for magnitudes below 2^22.
inline FourInt rounded4(Four v) noexcept {
  const Four shifted = v + four(12582912.0F); // 1.5 * 2^23: the last place is 1
  FourInt bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return bits - 0x4B400000;
}

inline bool any4(FourInt mask) noexcept {
  int64_t half[2];
  std::memcpy(half, &mask, sizeof half);
  return (half[0] | half[1]) != 0;
}
inline bool all4(FourInt mask) noexcept { return (mask[0] & mask[1] & mask[2] & mask[3]) != 0; }

} // namespace berm::kernel
#endif
