#include "parameter_tail.h"
#include "parameter_range.h"

int32_t sk_check_tail(const berm_parameters *p)
{
  if (!sk_is_within(p->tail_watched, 0, 1)) { return SK_RULE_TAIL_WATCHED; }
  if (!sk_is_within(p->tail_radius_mm, 500, p->own_body_radius_mm)) { return SK_RULE_TAIL_RADIUS; }
  if (!sk_is_within(p->tail_half_width_mm, 100, p->tail_radius_mm)) { return SK_RULE_TAIL_WIDTH; }
  if (p->tail_low_mm < 0 || p->tail_low_mm >= p->tail_high_mm || p->tail_high_mm > 10000) { return SK_RULE_TAIL_HEIGHTS; }
  if (!sk_is_within(p->tail_clearance_mm, 500, 3000)) { return SK_RULE_TAIL_CLEARANCE; }
  if (!sk_is_within(p->tail_fresh_us, 1, p->fresh_us)) { return SK_RULE_TAIL_FRESH; }
  return SK_RULE_NONE;
}
