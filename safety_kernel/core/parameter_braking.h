/* Parameter check: the braking table. Returns SK_RULE_NONE or the first rule broken. */
#ifndef SK_PARAMETER_BRAKING_H
#define SK_PARAMETER_BRAKING_H
#include "parameter_rules.h"
SK_BEGIN

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_BRAKE_REACH_ORDER <= \result <= SK_RULE_BRAKE_TIME_REACH;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_braking_ok(p);
  @ ensures why_brake_reach_order: \result == SK_RULE_BRAKE_REACH_ORDER ==> !sk_rule_brake_reach_order(p);
  @ ensures why_brake_reach_covers: \result == SK_RULE_BRAKE_REACH_COVERS ==> !sk_rule_brake_reach_covers(p);
  @ ensures why_brake_angle_range: \result == SK_RULE_BRAKE_ANGLE_RANGE ==> !sk_rule_brake_angle_range(p);
  @ ensures why_brake_angle_speed: \result == SK_RULE_BRAKE_ANGLE_SPEED ==> !sk_rule_brake_angle_speed(p);
  @ ensures why_brake_angle_reach: \result == SK_RULE_BRAKE_ANGLE_REACH ==> !sk_rule_brake_angle_reach(p);
  @ ensures why_brake_time_range: \result == SK_RULE_BRAKE_TIME_RANGE ==> !sk_rule_brake_time_range(p);
  @ ensures why_brake_time_speed: \result == SK_RULE_BRAKE_TIME_SPEED ==> !sk_rule_brake_time_speed(p);
  @ ensures why_brake_time_reach: \result == SK_RULE_BRAKE_TIME_REACH ==> !sk_rule_brake_time_reach(p);
  @*/
int32_t sk_check_braking(const berm_parameters *p);

SK_END
#endif
