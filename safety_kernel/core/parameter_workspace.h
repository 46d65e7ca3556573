/* Parameter check: the Workspace Monitor, the trucks' lanes, the separation distance. Returns SK_RULE_NONE or the first rule broken. */
#ifndef SK_PARAMETER_WORKSPACE_H
#define SK_PARAMETER_WORKSPACE_H
#include "parameter_rules.h"
SK_BEGIN

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_WORKSPACE_WATCHED <= \result <= SK_RULE_WORKSPACE_HISTOGRAM;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_workspace_ok(p);
  @ ensures why_workspace_watched: \result == SK_RULE_WORKSPACE_WATCHED ==> !sk_rule_workspace_watched(p);
  @ ensures why_workspace_radius: \result == SK_RULE_WORKSPACE_RADIUS ==> !sk_rule_workspace_radius(p);
  @ ensures why_workspace_heights: \result == SK_RULE_WORKSPACE_HEIGHTS ==> !sk_rule_workspace_heights(p);
  @ ensures why_workspace_times: \result == SK_RULE_WORKSPACE_TIMES ==> !sk_rule_workspace_times(p);
  @ ensures why_workspace_foreign: \result == SK_RULE_WORKSPACE_FOREIGN ==> !sk_rule_workspace_foreign(p);
  @ ensures why_workspace_follows: \result == SK_RULE_WORKSPACE_FOLLOWS ==> !sk_rule_workspace_follows(p);
  @ ensures why_lane_count: \result == SK_RULE_LANE_COUNT ==> !sk_rule_lane_count(p);
  @ ensures why_lane_bounds: \result == SK_RULE_LANE_BOUNDS ==> !sk_rule_lane_bounds(p);
  @ ensures why_separation_mode: \result == SK_RULE_SEPARATION_MODE ==> !sk_rule_separation_mode(p);
  @ ensures why_separation_approach: \result == SK_RULE_SEPARATION_APPROACH ==> !sk_rule_separation_approach(p);
  @ ensures why_separation_intrusion: \result == SK_RULE_SEPARATION_INTRUSION ==> !sk_rule_separation_intrusion(p);
  @ ensures why_workspace_lidar_times: \result == SK_RULE_WORKSPACE_LIDAR_TIMES ==> !sk_rule_workspace_lidar_times(p);
  @ ensures why_workspace_histogram: \result == SK_RULE_WORKSPACE_HISTOGRAM ==> !sk_rule_workspace_histogram(p);
  @*/
int32_t sk_check_workspace(const berm_parameters *p);

SK_END
#endif
