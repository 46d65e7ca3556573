/* Parameter check: what the sensors can see. Returns SK_RULE_NONE or the first rule broken. */
#ifndef SK_PARAMETER_SIGHT_H
#define SK_PARAMETER_SIGHT_H
#include "parameter_rules.h"
SK_BEGIN

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_SIGHT_BLIND <= \result <= SK_RULE_DUST_DWELL;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_sight_ok(p);
  @ ensures why_sight_blind: \result == SK_RULE_SIGHT_BLIND ==> !sk_rule_sight_blind(p);
  @ ensures why_dust_slow: \result == SK_RULE_DUST_SLOW ==> !sk_rule_dust_slow(p);
  @ ensures why_dust_stop: \result == SK_RULE_DUST_STOP ==> !sk_rule_dust_stop(p);
  @ ensures why_dust_speed: \result == SK_RULE_DUST_SPEED ==> !sk_rule_dust_speed(p);
  @ ensures why_dust_dwell: \result == SK_RULE_DUST_DWELL ==> !sk_rule_dust_dwell(p);
  @*/
int32_t sk_check_sight(const berm_parameters *p);

SK_END
#endif
