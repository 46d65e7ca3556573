#include "parameter_sight.h"
#include "parameter_range.h"

int32_t sk_check_sight(const berm_parameters *p)
{
  if (!sk_is_within(p->sight_blind_permille, 50, 1000)) { return SK_RULE_SIGHT_BLIND; }
  if (!sk_is_within(p->dust_slow_permille, 1, 1000)) { return SK_RULE_DUST_SLOW; }
  if (!sk_is_within(p->dust_stop_permille, p->dust_slow_permille, 1000)) { return SK_RULE_DUST_STOP; }
  if (!sk_is_within(p->dust_speed_permille, 50, 1000)) { return SK_RULE_DUST_SPEED; }
  if (!sk_is_within(p->dust_dwell_us, 0, 60000000)) { return SK_RULE_DUST_DWELL; }
  return SK_RULE_NONE;
}
