/* Parameter check: the limits and zones of the overpass rule. Returns SK_RULE_NONE or the first rule broken. */
#ifndef SK_PARAMETER_OVERPASS_H
#define SK_PARAMETER_OVERPASS_H
#include "parameter_rules.h"
SK_BEGIN

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_PASS_OVER <= \result <= SK_RULE_TRUCK_ZONE_CEILING;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_overpass_ok(p);
  @ ensures why_pass_over: \result == SK_RULE_PASS_OVER ==> !sk_rule_pass_over(p);
  @ ensures why_ground_zone_count: \result == SK_RULE_GROUND_ZONE_COUNT ==> !sk_rule_ground_zone_count(p);
  @ ensures why_ground_zone_bounds: \result == SK_RULE_GROUND_ZONE_BOUNDS ==> !sk_rule_ground_zone_bounds(p);
  @ ensures why_ground_zone_limit: \result == SK_RULE_GROUND_ZONE_LIMIT ==> !sk_rule_ground_zone_limit(p);
  @ ensures why_truck_zone_count: \result == SK_RULE_TRUCK_ZONE_COUNT ==> !sk_rule_truck_zone_count(p);
  @ ensures why_truck_zone_bounds: \result == SK_RULE_TRUCK_ZONE_BOUNDS ==> !sk_rule_truck_zone_bounds(p);
  @ ensures why_truck_zone_ceiling: \result == SK_RULE_TRUCK_ZONE_CEILING ==> !sk_rule_truck_zone_ceiling(p);
  @*/
int32_t sk_check_overpass(const berm_parameters *p);

SK_END
#endif
