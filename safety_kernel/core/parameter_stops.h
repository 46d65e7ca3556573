/* Parameter check: no stop of the braking table is shorter than any machine's. Returns SK_RULE_NONE or the first rule broken. */
#ifndef SK_PARAMETER_STOPS_H
#define SK_PARAMETER_STOPS_H
#include "parameter_rules.h"
SK_BEGIN

/*@ requires \valid_read(p);
  @ requires sk_rule_velocity_max(p) && sk_rule_acceleration_max(p) && sk_rule_brake_angle_range(p) && sk_rule_brake_time_range(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_STOP_ANGLE <= \result <= SK_RULE_STOP_TIME;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_stops_ok(p);
  @ ensures why_stop_angle: \result == SK_RULE_STOP_ANGLE ==> !sk_rule_stop_angle(p);
  @ ensures why_stop_time: \result == SK_RULE_STOP_TIME ==> !sk_rule_stop_time(p);
  @*/
int32_t sk_check_stops(const berm_parameters *p);

SK_END
#endif
