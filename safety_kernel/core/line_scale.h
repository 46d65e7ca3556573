/* A line through (0, 0) and (da, dv), at a run along it: whole millimetres below and above it. */
#ifndef SK_LINE_SCALE_H
#define SK_LINE_SCALE_H
#include "least_most.h"
SK_BEGIN

#define SK_LINE_MAX_MM (2 * SK_COORD_MAX_MM) /* between two points of the map, along one axis */

/*@ logic real sk_times(real a, real b) = a * b;
  @ predicate sk_on_line(real dv, real da, real a, real v) = sk_times(da, v) == sk_times(dv, a);
  @ predicate sk_over_line(real dv, real da, real a, real v) = sk_times(da, v) >= sk_times(dv, a);
  @ predicate sk_under_line(real dv, real da, real a, real v) = sk_times(da, v) <= sk_times(dv, a);
  @*/

typedef struct sk_scaled { int32_t low, high; } sk_scaled;

/*@ requires 0 < da <= SK_LINE_MAX_MM && 0 <= run <= da && -SK_LINE_MAX_MM <= dv <= SK_LINE_MAX_MM;
  @ assigns \nothing;
  @ ensures under: sk_under_line(dv, da, run, \result.low);
  @ ensures over: sk_over_line(dv, da, run, \result.high);
  @ ensures low: sk_least(0, dv) <= \result.low <= sk_most(0, dv);
  @ ensures high: sk_least(0, dv) <= \result.high <= sk_most(0, dv);
  @*/
sk_scaled sk_scale(int64_t dv, int64_t run, int64_t da);

SK_END
#endif
