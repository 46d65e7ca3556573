/* Integer division rounded down and up, least and greatest. For the files of the core only. */
#ifndef SK_ROUNDING_H
#define SK_ROUNDING_H
#include "sk_common.h"

#define SK_ROUNDING_MAX 4611686018427387904 /* 2^62 */

/*@ predicate sk_is_floor(integer q, integer n, integer d) = d * q <= n < d * q + d;
  @ predicate sk_is_ceil(integer q, integer n, integer d) = d * q - d < n <= d * q;
  @ logic integer sk_least(integer a, integer b) = a <= b ? a : b;
  @ logic integer sk_most(integer a, integer b) = a >= b ? a : b;
  @*/

/*@ requires d > 0 && -SK_ROUNDING_MAX <= n <= SK_ROUNDING_MAX;
  @ assigns \nothing;
  @ ensures sk_is_floor(\result, n, d);
  @*/
static inline int64_t sk_floor_div(int64_t n, int64_t d)
{
  int64_t q = n / d;
  if (n % d < 0) { q = q - 1; }
  return q;
}

/*@ requires d > 0 && -SK_ROUNDING_MAX <= n <= SK_ROUNDING_MAX;
  @ assigns \nothing;
  @ ensures sk_is_ceil(\result, n, d);
  @*/
static inline int64_t sk_ceil_div(int64_t n, int64_t d)
{
  int64_t q = n / d;
  if (n % d > 0) { q = q + 1; }
  return q;
}

/*@ assigns \nothing;
  @ ensures \result == sk_least(a, b);
  @*/
static inline int64_t sk_least_of(int64_t a, int64_t b)
{
  return a <= b ? a : b;
}

/*@ assigns \nothing;
  @ ensures \result == sk_most(a, b);
  @*/
static inline int64_t sk_most_of(int64_t a, int64_t b)
{
  return a >= b ? a : b;
}

#endif
