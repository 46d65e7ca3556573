/* Parameter check: the upper body's tail. Returns SK_RULE_NONE or the first rule broken. */
#ifndef SK_PARAMETER_TAIL_H
#define SK_PARAMETER_TAIL_H
#include "parameter_rules.h"
SK_BEGIN

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_TAIL_WATCHED <= \result <= SK_RULE_TAIL_FRESH;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_tail_ok(p);
  @ ensures why_tail_watched: \result == SK_RULE_TAIL_WATCHED ==> !sk_rule_tail_watched(p);
  @ ensures why_tail_radius: \result == SK_RULE_TAIL_RADIUS ==> !sk_rule_tail_radius(p);
  @ ensures why_tail_width: \result == SK_RULE_TAIL_WIDTH ==> !sk_rule_tail_width(p);
  @ ensures why_tail_heights: \result == SK_RULE_TAIL_HEIGHTS ==> !sk_rule_tail_heights(p);
  @ ensures why_tail_clearance: \result == SK_RULE_TAIL_CLEARANCE ==> !sk_rule_tail_clearance(p);
  @ ensures why_tail_fresh: \result == SK_RULE_TAIL_FRESH ==> !sk_rule_tail_fresh(p);
  @*/
int32_t sk_check_tail(const berm_parameters *p);

SK_END
#endif
