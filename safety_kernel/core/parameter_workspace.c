#include "parameter_workspace.h"
#include "parameter_range.h"
#include "parameter_rectangle.h"

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_workspace_heights(p);
  @*/
static bool heights_ok(const berm_parameters *p)
{
  return sk_is_within(p->workspace_rise_mm, 100, 2000) && sk_is_within(p->workspace_neighbour_mm, 100, 2000) &&
         sk_is_within(p->workspace_slope_mm, 100, 5000);
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_workspace_times(p);
  @*/
static bool times_ok(const berm_parameters *p)
{
  return sk_is_within(p->workspace_wait_us, 0, 10000000) && sk_is_within(p->workspace_period_us, 1, 1000000) &&
         sk_is_within(p->workspace_dwell_us, 0, 60000000) && sk_is_within(p->workspace_learn_us, 0, 120000000);
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_workspace_lidar_times(p);
  @*/
static bool lidar_times_ok(const berm_parameters *p)
{
  return sk_is_within(p->workspace_lidar_wait_us, 0, 10000000) && sk_is_within(p->workspace_lidar_period_us, 1, 1000000);
}

/*@ requires \valid_read(z);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_lane_ok(z);
  @*/
static bool lane_ok(const berm_lane *z)
{
  return sk_is_rectangle(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm);
}

/*@ requires \valid_read(p) && 0 <= p->lanes <= BERM_LANES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_lane_bounds(p);
  @*/
static bool lanes_ok(const berm_parameters *p)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= p->lanes;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_lane_ok(&p->lane[k]);
    @ loop assigns i;
    @ loop variant p->lanes - i;
    @*/
  for (i = 0; i < p->lanes; i++) {
    if (!lane_ok(&p->lane[i])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_SEPARATION_MODE <= \result <= SK_RULE_SEPARATION_INTRUSION;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_rule_separation_mode(p) && sk_rule_separation_approach(p) && sk_rule_separation_intrusion(p);
  @ ensures mode: \result == SK_RULE_SEPARATION_MODE ==> !sk_rule_separation_mode(p);
  @ ensures approach: \result == SK_RULE_SEPARATION_APPROACH ==> !sk_rule_separation_approach(p);
  @ ensures intrusion: \result == SK_RULE_SEPARATION_INTRUSION ==> !sk_rule_separation_intrusion(p);
  @*/
static int32_t separation_rule(const berm_parameters *p)
{
  if (!sk_is_within(p->workspace_separation, BERM_SEPARATION_NONE, BERM_SEPARATION_ENFORCED)) { return SK_RULE_SEPARATION_MODE; }
  if (!sk_is_within(p->workspace_approach_mm_s, 500, 5000)) { return SK_RULE_SEPARATION_APPROACH; }
  if (!sk_is_within(p->workspace_intrusion_mm, 0, 3000)) { return SK_RULE_SEPARATION_INTRUSION; }
  return SK_RULE_NONE;
}

int32_t sk_check_workspace(const berm_parameters *p)
{
  int32_t rule;
  if (!sk_is_within(p->workspace_watched, 0, 1)) { return SK_RULE_WORKSPACE_WATCHED; }
  if (!sk_is_within(p->workspace_radius_mm, p->own_body_radius_mm, 15000)) { return SK_RULE_WORKSPACE_RADIUS; }
  if (!heights_ok(p)) { return SK_RULE_WORKSPACE_HEIGHTS; }
  if (!times_ok(p)) { return SK_RULE_WORKSPACE_TIMES; }
  if (!sk_is_within(p->workspace_foreign, 0, 100)) { return SK_RULE_WORKSPACE_FOREIGN; }
  if (!sk_is_within(p->workspace_follows, 0, 1)) { return SK_RULE_WORKSPACE_FOLLOWS; }
  if (!sk_is_within(p->lanes, 0, BERM_LANES)) { return SK_RULE_LANE_COUNT; }
  if (!lanes_ok(p)) { return SK_RULE_LANE_BOUNDS; }
  rule = separation_rule(p);
  if (rule != SK_RULE_NONE) { return rule; }
  if (!lidar_times_ok(p)) { return SK_RULE_WORKSPACE_LIDAR_TIMES; }
  return sk_is_within(p->workspace_histogram, 0, 1) ? SK_RULE_NONE : SK_RULE_WORKSPACE_HISTOGRAM;
}
