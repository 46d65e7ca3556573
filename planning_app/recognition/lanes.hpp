// Eight floats at a time, by the compilers' own vector types (GCC, Clang; any processor). A length of 10 m is good to a micrometre here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

// A function so marked is compiled three times, and the loader takes what the processor has: with AVX-512 the registers are no wider, but twice as many.
// All do the same operations in the same order (no fused multiply-add), so that the results are the same bit for bit.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define BERM_APP_LANES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define BERM_APP_LANES
#endif

// How registers of this width are handed to a function depends on the processor that it is compiled for, and GCC warns of it (-Wno-psabi in CMakeLists.txt):
// what takes or returns them is inlined, always, and hands nothing over.
#define BERM_APP_INLINE [[gnu::always_inline]] inline

namespace berm::app {

using Eight = float __attribute__((vector_size(32)));
using EightInt = std::int32_t __attribute__((vector_size(32)));  // of a comparison: all bits or none
constexpr std::size_t kLanes = 8;

// Several of them in memory. Processors that have such registers want them to lie at multiples of 32 bytes, and a compiler for any processor lays them at
// 16: what holds them says so itself.
template <std::size_t count>
struct alignas(32) Eights {
  Eight of[count];
  [[gnu::always_inline]] Eight& operator[](std::size_t k) { return of[k]; }
  [[gnu::always_inline]] const Eight& operator[](std::size_t k) const { return of[k]; }
};

BERM_APP_INLINE Eight eight(double v) {
  const auto f = static_cast<float>(v);
  return Eight{f, f, f, f, f, f, f, f};
}
BERM_APP_INLINE Eight most8(Eight a, Eight b) { return a > b ? a : b; }
BERM_APP_INLINE Eight least8(Eight a, Eight b) { return a < b ? a : b; }
BERM_APP_INLINE EightInt bits8(Eight a) {
  EightInt out;
  std::memcpy(&out, &a, sizeof out);
  return out;
}
BERM_APP_INLINE Eight floats8(EightInt a) {
  Eight out;
  std::memcpy(&out, &a, sizeof out);
  return out;
}
BERM_APP_INLINE Eight magnitude8(Eight a) { return floats8(bits8(a) & 0x7FFFFFFF); }
// Where the mask is set, 0 elsewhere.
BERM_APP_INLINE Eight where8(EightInt mask, Eight a) { return floats8(bits8(a) & mask); }
BERM_APP_INLINE Eight choose8(EightInt mask, Eight then, Eight otherwise) { return floats8((bits8(then) & mask) | (bits8(otherwise) & ~mask)); }
BERM_APP_INLINE bool any8(EightInt mask) {
  std::int64_t __attribute__((vector_size(16))) half[2];  // one to the other, and only then from the registers
  std::memcpy(half, &mask, sizeof half);
  const auto both = half[0] | half[1];
  return (both[0] | both[1]) != 0;
}
BERM_APP_INLINE float sum8(Eight a) { return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7])); }
BERM_APP_INLINE int sum8(EightInt a) { return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7])); }

// To the nearest integer, for magnitudes below 2^22.
BERM_APP_INLINE EightInt rounded8(Eight v) { return bits8(v + eight(12582912.0)) - 0x4B400000; }  // 1.5 * 2^23: the last place is 1

// Natural logarithm of normal numbers above 0, good to 2e-7 of it or of 1 (Cephes, logf).
BERM_APP_INLINE Eight log8(Eight x) {
  const EightInt bits = bits8(x), halves = (bits - 0x3F3504F3) >> 23;  // so that the rest lies between the roots of 1/2 and 2
  const Eight exponent = __builtin_convertvector(halves, Eight), f = floats8(bits - (halves << 23)) - eight(1.0), z = f * f;
  Eight y = eight(7.0376836292E-2);
  for (const double c : {-1.1514610310E-1, 1.1676998740E-1, -1.2420140846E-1, 1.4249322787E-1, -1.6668057665E-1, 2.0000714765E-1, -2.4999993993E-1, 3.3333331174E-1}) y = y * f + eight(c);
  y = y * f * z - eight(2.12194440E-4) * exponent - eight(0.5) * z;
  return f + y + eight(0.693359375) * exponent;
}
// For magnitudes below 80, good to 2e-7 of it (Cephes, expf).
BERM_APP_INLINE Eight exp8(Eight x) {
  const EightInt n = rounded8(x * eight(1.44269504088896341));
  const Eight exponent = __builtin_convertvector(n, Eight), rest = x - exponent * eight(0.693359375) + exponent * eight(2.12194440E-4);
  Eight y = eight(1.9875691500E-4);
  for (const double c : {1.3981999507E-3, 8.3334519073E-3, 4.1665795894E-2, 1.6666665459E-1, 5.0000001201E-1}) y = y * rest + eight(c);
  return floats8(bits8(y * rest * rest + rest + eight(1.0)) + (n << 23));
}
// log(1 + x) of x from 0 on.
BERM_APP_INLINE Eight log1p8(Eight x) { return choose8(x < 1e-3F, x * (1.0F - 0.5F * x), log8(1.0F + x)); }

}  // namespace berm::app
