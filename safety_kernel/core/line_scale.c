#include "line_scale.h"

/*@ predicate sk_is_floor(integer q, integer n, integer d) = d * q <= n < d * q + d;
  @ predicate sk_is_ceil(integer q, integer n, integer d) = d * q - d < n <= d * q;
  @ predicate sk_product_most(integer d, integer v, integer n) = d * v <= n;
  @ predicate sk_product_least(integer d, integer v, integer n) = d * v >= n;
  @ lemma sk_smaller: \forall integer d, x, y; d > 0 && d * x < d * y + d ==> x <= y;
  @ lemma sk_floor_at_least: \forall integer d, q, n, v; d > 0 && sk_is_floor(q, n, d) && sk_product_most(d, v, n) ==> v <= q;
  @ lemma sk_floor_at_most: \forall integer d, q, n, v; d > 0 && sk_is_floor(q, n, d) && sk_product_least(d, v, n) ==> q <= v;
  @ lemma sk_ceil_at_least: \forall integer d, q, n, v; d > 0 && sk_is_ceil(q, n, d) && sk_product_most(d, v, n) ==> v <= q;
  @ lemma sk_ceil_at_most: \forall integer d, q, n, v; d > 0 && sk_is_ceil(q, n, d) && sk_product_least(d, v, n) ==> q <= v;
  @ lemma sk_whole: \forall integer a, b; (real)(a * b) == sk_times(a, b);
  @ lemma sk_ceil_over: \forall integer dv, da, r, u; da * u >= dv * r ==> sk_over_line(dv, da, r, u);
  @ lemma sk_floor_under: \forall integer dv, da, r, u; da * u <= dv * r ==> sk_under_line(dv, da, r, u);
  @*/

#define SK_PRODUCT_MAX 4611686018427387904 /* 2^62 */

/* Quotient rounded down and up, at one division. */
typedef struct sk_quotient { int64_t low, high; } sk_quotient;

/*@ requires d > 0 && -SK_PRODUCT_MAX <= n <= SK_PRODUCT_MAX;
  @ assigns \nothing;
  @ ensures sk_is_floor(\result.low, n, d);
  @ ensures sk_is_ceil(\result.high, n, d);
  @*/
static sk_quotient sk_divided(int64_t n, int64_t d)
{
  int64_t q = n / d;
  int64_t rest = n % d;
  sk_quotient out;
  out.low = rest < 0 ? q - 1 : q;
  out.high = rest > 0 ? q + 1 : q;
  return out;
}

sk_scaled sk_scale(int64_t dv, int64_t run, int64_t da)
{
  sk_quotient q;
  sk_scaled out;
  /*@ assert dv >= 0 ==> 0 <= dv * run <= dv * da; */
  /*@ assert dv <= 0 ==> dv * da <= dv * run <= 0; */
  q = sk_divided(dv * run, da);
  /*@ assert dv >= 0 ==> sk_product_most(da, 0, dv * run) && sk_product_least(da, dv, dv * run); */
  /*@ assert dv <= 0 ==> sk_product_most(da, dv, dv * run) && sk_product_least(da, 0, dv * run); */
  /*@ assert low: sk_least(0, dv) <= q.low <= sk_most(0, dv); */
  /*@ assert high: sk_least(0, dv) <= q.high <= sk_most(0, dv); */
  out.low = (int32_t)q.low;
  out.high = (int32_t)q.high;
  return out;
}
