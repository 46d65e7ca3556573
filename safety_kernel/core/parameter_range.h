/* Shared by the files of the parameter check. */
#ifndef SK_PARAMETER_RANGE_H
#define SK_PARAMETER_RANGE_H
#include "parameter_rules.h"
SK_BEGIN

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_within(v, low, high);
  @*/
static inline bool sk_is_within(int32_t v, int32_t low, int32_t high)
{
  return low <= v && v <= high;
}

/* Boom pin to bucket tip, stretched, from the swing axis. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == sk_total_reach(p);
  @*/
static inline int64_t sk_reach_total(const berm_parameters *p)
{
  return (int64_t)p->boom_pin_x_mm + (int64_t)p->boom_length_mm + (int64_t)p->stick_length_mm + (int64_t)p->bucket_length_mm;
}

SK_END
#endif
