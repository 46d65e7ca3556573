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
inline bool any4(FourInt mask) {
  std::int64_t half[2];
  std::memcpy(half, &mask, sizeof half);
  return (half[0] | half[1]) != 0;
}
inline float sum4(Four a) { return (a[0] + a[1]) + (a[2] + a[3]); }
inline int sum4(FourInt a) { return a[0] + a[1] + a[2] + a[3]; }

// To the nearest integer, for magnitudes below 2^22.
inline FourInt rounded4(Four v) { return bits4(v + four(12582912.0)) - 0x4B400000; }  // 1.5 * 2^23: the last place is 1

// Natural logarithm of normal numbers above 0, good to 2e-7 of it or of 1 (Cephes, logf).
inline Four log4(Four x) {
  const FourInt bits = bits4(x), halves = (bits - 0x3F3504F3) >> 23;  // so that the rest lies between the roots of 1/2 and 2
  const Four exponent = __builtin_convertvector(halves, Four), f = floats4(bits - (halves << 23)) - four(1.0), z = f * f;
  Four y = four(7.0376836292E-2);
  for (const double c : {-1.1514610310E-1, 1.1676998740E-1, -1.2420140846E-1, 1.4249322787E-1, -1.6668057665E-1, 2.0000714765E-1, -2.4999993993E-1, 3.3333331174E-1}) y = y * f + four(c);
  y = y * f * z - four(2.12194440E-4) * exponent - four(0.5) * z;
  return f + y + four(0.693359375) * exponent;
}
// For magnitudes below 80, good to 2e-7 of it (Cephes, expf).
inline Four exp4(Four x) {
  const FourInt n = rounded4(x * four(1.44269504088896341));
  const Four exponent = __builtin_convertvector(n, Four), rest = x - exponent * four(0.693359375) + exponent * four(2.12194440E-4);
  Four y = four(1.9875691500E-4);
  for (const double c : {1.3981999507E-3, 8.3334519073E-3, 4.1665795894E-2, 1.6666665459E-1, 5.0000001201E-1}) y = y * rest + four(c);
  return floats4(bits4(y * rest * rest + rest + four(1.0)) + (n << 23));
}
// log(1 + x) of x from 0 on.
inline Four log1p4(Four x) { return choose4(x < 1e-3F, x * (1.0F - 0.5F * x), log4(1.0F + x)); }

}  // namespace berm::app
