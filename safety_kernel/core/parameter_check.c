#include "parameter_check.h"
#include "parameter_braking.h"
#include "parameter_lidar.h"
#include "parameter_overpass.h"
#include "parameter_parts.h"
#include "parameter_range.h"
#include "parameter_rectangle.h"
#include "parameter_tail.h"
#include "parameter_sight.h"
#include "parameter_stops.h"
#include "parameter_workspace.h"

/*@ requires \valid_read(v + (0 .. SK_JOINTS - 1));
  @ assigns \nothing;
  @ ensures \result == true <==> (\forall integer j; 0 <= j < SK_JOINTS ==> sk_within(v[j], low, high));
  @*/
static bool joints_within(const int32_t *v, int32_t low, int32_t high)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= SK_JOINTS;
    @ loop invariant \forall integer j; 0 <= j < k ==> sk_within(v[j], low, high);
    @ loop assigns k;
    @ loop variant SK_JOINTS - k;
    @*/
  for (k = 0; k < SK_JOINTS; k++) {
    if (!sk_is_within(v[k], low, high)) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: 0 <= \result <= SK_RULE_CELL;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_head_ok(p);
  @ ensures why_magic: \result == SK_RULE_MAGIC ==> !sk_rule_magic(p);
  @ ensures why_version: \result == SK_RULE_VERSION ==> !sk_rule_version(p);
  @ ensures why_size: \result == SK_RULE_SIZE ==> !sk_rule_size(p);
  @ ensures why_cell: \result == SK_RULE_CELL ==> !sk_rule_cell(p);
  @*/
static int32_t check_head(const berm_parameters *p)
{
  if (p->magic != BERM_PARAMETERS_MAGIC) { return SK_RULE_MAGIC; }
  if (p->version != BERM_PARAMETERS_VERSION) { return SK_RULE_VERSION; }
  if (p->size != (int32_t)sizeof(berm_parameters)) { return SK_RULE_SIZE; }
  if (p->cell_mm != SK_CELL_MM) { return SK_RULE_CELL; }
  return SK_RULE_NONE;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_BOOM_PIN_X <= \result <= SK_RULE_OWN_BODY_RADIUS;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_kinematics_ok(p);
  @ ensures why_boom_pin_x: \result == SK_RULE_BOOM_PIN_X ==> !sk_rule_boom_pin_x(p);
  @ ensures why_boom_pin_z: \result == SK_RULE_BOOM_PIN_Z ==> !sk_rule_boom_pin_z(p);
  @ ensures why_boom_length: \result == SK_RULE_BOOM_LENGTH ==> !sk_rule_boom_length(p);
  @ ensures why_stick_length: \result == SK_RULE_STICK_LENGTH ==> !sk_rule_stick_length(p);
  @ ensures why_bucket_length: \result == SK_RULE_BUCKET_LENGTH ==> !sk_rule_bucket_length(p);
  @ ensures why_total_reach: \result == SK_RULE_TOTAL_REACH ==> !sk_rule_total_reach(p);
  @ ensures why_own_body_radius: \result == SK_RULE_OWN_BODY_RADIUS ==> !sk_rule_own_body_radius(p);
  @*/
static int32_t check_kinematics(const berm_parameters *p)
{
  if (!sk_is_within(p->boom_pin_x_mm, -3000, 3000)) { return SK_RULE_BOOM_PIN_X; }
  if (!sk_is_within(p->boom_pin_z_mm, 0, 5000)) { return SK_RULE_BOOM_PIN_Z; }
  if (!sk_is_within(p->boom_length_mm, 1000, 12000)) { return SK_RULE_BOOM_LENGTH; }
  if (!sk_is_within(p->stick_length_mm, 500, 8000)) { return SK_RULE_STICK_LENGTH; }
  if (!sk_is_within(p->bucket_length_mm, 300, 4000)) { return SK_RULE_BUCKET_LENGTH; }
  if (sk_reach_total(p) > 15000) { return SK_RULE_TOTAL_REACH; }
  if (!sk_is_within(p->own_body_radius_mm, 500, 6000)) { return SK_RULE_OWN_BODY_RADIUS; }
  return SK_RULE_NONE;
}

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && 0 < limit <= 6283186;
  @ assigns \nothing;
  @ ensures \result == true <==> -limit <= p->joint_low_urad[j] < p->joint_high_urad[j] <= limit;
  @*/
static bool range_ordered(const berm_parameters *p, int32_t j, int32_t limit)
{
  return -limit <= p->joint_low_urad[j] && p->joint_low_urad[j] < p->joint_high_urad[j] && p->joint_high_urad[j] <= limit;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_joint_range(p);
  @*/
static bool joint_ranges_ordered(const berm_parameters *p)
{
  return range_ordered(p, 0, 6283186) && range_ordered(p, 1, 3141593) && range_ordered(p, 2, 3141593) && range_ordered(p, 3, 3141593);
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_creep_velocity(p);
  @*/
static bool creep_within(const berm_parameters *p)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= SK_JOINTS;
    @ loop invariant \forall integer j; 0 <= j < k ==>
    @   sk_within(p->creep_velocity_urad_s[j], 0, p->velocity_max_urad_s[j]) && p->creep_velocity_urad_s[j] <= SK_SLOW_MAX_URAD_S;
    @ loop assigns k;
    @ loop variant SK_JOINTS - k;
    @*/
  for (k = 0; k < SK_JOINTS; k++) {
    if (!sk_is_within(p->creep_velocity_urad_s[k], 0, p->velocity_max_urad_s[k])) { return false; }
    if (p->creep_velocity_urad_s[k] > SK_SLOW_MAX_URAD_S) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_JOINT_RANGE <= \result <= SK_RULE_COMMAND_LATENCY;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_joints_ok(p);
  @ ensures why_joint_range: \result == SK_RULE_JOINT_RANGE ==> !sk_rule_joint_range(p);
  @ ensures why_velocity_max: \result == SK_RULE_VELOCITY_MAX ==> !sk_rule_velocity_max(p);
  @ ensures why_acceleration_max: \result == SK_RULE_ACCELERATION_MAX ==> !sk_rule_acceleration_max(p);
  @ ensures why_creep_velocity: \result == SK_RULE_CREEP_VELOCITY ==> !sk_rule_creep_velocity(p);
  @ ensures why_angle_error: \result == SK_RULE_ANGLE_ERROR ==> !sk_rule_angle_error(p);
  @ ensures why_velocity_error: \result == SK_RULE_VELOCITY_ERROR ==> !sk_rule_velocity_error(p);
  @ ensures why_state_latency: \result == SK_RULE_STATE_LATENCY ==> !sk_rule_state_latency(p);
  @ ensures why_command_latency: \result == SK_RULE_COMMAND_LATENCY ==> !sk_rule_command_latency(p);
  @*/
static int32_t check_joints(const berm_parameters *p)
{
  if (!joint_ranges_ordered(p)) { return SK_RULE_JOINT_RANGE; }
  if (!joints_within(p->velocity_max_urad_s, 1000, 4000000)) { return SK_RULE_VELOCITY_MAX; }
  if (!joints_within(p->acceleration_max_urad_s2, 1000, 50000000)) { return SK_RULE_ACCELERATION_MAX; }
  if (!creep_within(p)) { return SK_RULE_CREEP_VELOCITY; }
  if (!joints_within(p->angle_error_urad, 200, 100000)) { return SK_RULE_ANGLE_ERROR; }
  if (!joints_within(p->velocity_error_urad_s, 100, 200000)) { return SK_RULE_VELOCITY_ERROR; }
  if (!sk_is_within(p->state_latency_us, 1000, 500000)) { return SK_RULE_STATE_LATENCY; }
  if (!sk_is_within(p->command_latency_us, 1000, 1000000)) { return SK_RULE_COMMAND_LATENCY; }
  return SK_RULE_NONE;
}

/*@ requires \valid_read(m);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_mount_position_ok(m);
  @*/
static bool mount_position_ok(const berm_scanner_mount *m)
{
  return sk_is_within(m->x_mm, -5000, 5000) && sk_is_within(m->y_mm, -5000, 5000) && sk_is_within(m->z_mm, 0, 8000);
}

/*@ requires \valid_read(m);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_mount_pan_ok(m);
  @*/
static bool mount_pan_ok(const berm_scanner_mount *m)
{
  return -3141593 <= m->pan_low_urad && m->pan_low_urad < m->pan_high_urad && m->pan_high_urad <= 3141593;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_SCANNER_POSITION <= \result <= SK_RULE_SELF_MARGIN;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_sensors_ok(p);
  @ ensures why_scanner_position: \result == SK_RULE_SCANNER_POSITION ==> !sk_rule_scanner_position(p);
  @ ensures why_scanner_pan: \result == SK_RULE_SCANNER_PAN ==> !sk_rule_scanner_pan(p);
  @ ensures why_scanner_pan_rate: \result == SK_RULE_SCANNER_PAN_RATE ==> !sk_rule_scanner_pan_rate(p);
  @ ensures why_scanner_silent: \result == SK_RULE_SCANNER_SILENT ==> !sk_rule_scanner_silent(p);
  @ ensures why_spurious_range: \result == SK_RULE_SPURIOUS_RANGE ==> !sk_rule_spurious_range(p);
  @ ensures why_range_limits: \result == SK_RULE_RANGE_LIMITS ==> !sk_rule_range_limits(p);
  @ ensures why_self_margin: \result == SK_RULE_SELF_MARGIN ==> !sk_rule_self_margin(p);
  @*/
static int32_t check_sensors(const berm_parameters *p)
{
  if (!mount_position_ok(&p->scanner[0]) || !mount_position_ok(&p->scanner[1])) { return SK_RULE_SCANNER_POSITION; }
  if (!mount_pan_ok(&p->scanner[0]) || !mount_pan_ok(&p->scanner[1])) { return SK_RULE_SCANNER_PAN; }
  if (!sk_is_within(p->scanner[0].pan_rate_max_urad_s, 1, 10000000)) { return SK_RULE_SCANNER_PAN_RATE; }
  if (!sk_is_within(p->scanner[1].pan_rate_max_urad_s, 1, 10000000)) { return SK_RULE_SCANNER_PAN_RATE; }
  if (!sk_is_within(p->scanner_silent_us, 1000, 5000000)) { return SK_RULE_SCANNER_SILENT; }
  if (!sk_is_within(p->spurious_range_mm, 1, 100000)) { return SK_RULE_SPURIOUS_RANGE; }
  if (p->range_min_mm < 0 || p->range_min_mm >= p->range_max_mm || p->range_max_mm > 262140) { return SK_RULE_RANGE_LIMITS; }
  if (!sk_is_within(p->self_margin_mm, 0, 2000)) { return SK_RULE_SELF_MARGIN; }
  return SK_RULE_NONE;
}

/*@ requires \valid_read(z);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_zone_bounds_ok(z);
  @*/
static bool zone_bounds_ok(const berm_dig_zone *z)
{
  return sk_is_rectangle(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm);
}

/*@ requires \valid_read(p) && sk_rule_dig_zone_count(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_dig_zone_bounds(p);
  @*/
static bool zones_bounds_ok(const berm_parameters *p)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->dig_zones;
    @ loop invariant \forall integer i; 0 <= i < k ==> sk_zone_bounds_ok(&p->dig_zone[i]);
    @ loop assigns k;
    @ loop variant p->dig_zones - k;
    @*/
  for (k = 0; k < p->dig_zones; k++) {
    if (!zone_bounds_ok(&p->dig_zone[k])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(z);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_zone_heights_ok(z);
  @*/
static bool zone_floor_below_ceiling(const berm_dig_zone *z)
{
  return -SK_HEIGHT_MAX_MM <= z->floor_mm && z->floor_mm < z->ceiling_mm && z->ceiling_mm <= SK_HEIGHT_MAX_MM;
}

/*@ requires \valid_read(p) && sk_rule_dig_zone_count(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_dig_zone_heights(p);
  @*/
static bool zone_heights_ok(const berm_parameters *p)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= p->dig_zones;
    @ loop invariant \forall integer i; 0 <= i < k ==> sk_zone_heights_ok(&p->dig_zone[i]);
    @ loop assigns k;
    @ loop variant p->dig_zones - k;
    @*/
  for (k = 0; k < p->dig_zones; k++) {
    if (!zone_floor_below_ceiling(&p->dig_zone[k])) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_MARGIN <= \result <= SK_RULE_DIG_ZONE_HEIGHTS;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_map_rules_ok(p);
  @ ensures why_margin: \result == SK_RULE_MARGIN ==> !sk_rule_margin(p);
  @ ensures why_fresh: \result == SK_RULE_FRESH ==> !sk_rule_fresh(p);
  @ ensures why_generation: \result == SK_RULE_GENERATION ==> !sk_rule_generation(p);
  @ ensures why_dig_swing_limit: \result == SK_RULE_DIG_SWING_LIMIT ==> !sk_rule_dig_swing_limit(p);
  @ ensures why_dig_zone_count: \result == SK_RULE_DIG_ZONE_COUNT ==> !sk_rule_dig_zone_count(p);
  @ ensures why_dig_zone_bounds: \result == SK_RULE_DIG_ZONE_BOUNDS ==> !sk_rule_dig_zone_bounds(p);
  @ ensures why_dig_zone_heights: \result == SK_RULE_DIG_ZONE_HEIGHTS ==> !sk_rule_dig_zone_heights(p);
  @*/
static int32_t check_map(const berm_parameters *p)
{
  if (!sk_is_within(p->margin_mm, 100, 3000)) { return SK_RULE_MARGIN; }
  if (!sk_is_within(p->fresh_us, 1, 600000000)) { return SK_RULE_FRESH; }
  if (!sk_is_within(p->generation_us, 1, p->fresh_us)) { return SK_RULE_GENERATION; }
  if (!sk_is_within(p->dig_swing_limit_urad_s, 0, p->velocity_max_urad_s[0])) { return SK_RULE_DIG_SWING_LIMIT; }
  if (p->dig_swing_limit_urad_s > SK_SLOW_MAX_URAD_S) { return SK_RULE_DIG_SWING_LIMIT; }
  if (!sk_is_within(p->dig_zones, 0, BERM_DIG_ZONES)) { return SK_RULE_DIG_ZONE_COUNT; }
  if (!zones_bounds_ok(p)) { return SK_RULE_DIG_ZONE_BOUNDS; }
  if (!zone_heights_ok(p)) { return SK_RULE_DIG_ZONE_HEIGHTS; }
  return SK_RULE_NONE;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_cycle(p);
  @*/
static bool cycle_ok(const berm_parameters *p)
{
  return sk_is_within(p->cycle_us, 1000, 20000) && p->cycle_us <= p->state_latency_us && p->cycle_us <= p->command_latency_us;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_REQUEST_AGE <= \result <= SK_RULE_STANDSTILL_TIME;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_times_ok(p);
  @ ensures why_request_age: \result == SK_RULE_REQUEST_AGE ==> !sk_rule_request_age(p);
  @ ensures why_request_hold: \result == SK_RULE_REQUEST_HOLD ==> !sk_rule_request_hold(p);
  @ ensures why_request_silent: \result == SK_RULE_REQUEST_SILENT ==> !sk_rule_request_silent(p);
  @ ensures why_state_frame_age: \result == SK_RULE_STATE_FRAME_AGE ==> !sk_rule_state_frame_age(p);
  @ ensures why_machine_state_age: \result == SK_RULE_MACHINE_STATE_AGE ==> !sk_rule_machine_state_age(p);
  @ ensures why_operator_age: \result == SK_RULE_OPERATOR_AGE ==> !sk_rule_operator_age(p);
  @ ensures why_cycle: \result == SK_RULE_CYCLE ==> !sk_rule_cycle(p);
  @ ensures why_standstill_speed: \result == SK_RULE_STANDSTILL_SPEED ==> !sk_rule_standstill_speed(p);
  @ ensures why_standstill_time: \result == SK_RULE_STANDSTILL_TIME ==> !sk_rule_standstill_time(p);
  @*/
static int32_t check_times(const berm_parameters *p)
{
  if (!sk_is_within(p->request_age_us, 1, 500000)) { return SK_RULE_REQUEST_AGE; }
  if (!sk_is_within(p->request_hold_us, 1, 50000)) { return SK_RULE_REQUEST_HOLD; }
  if (!sk_is_within(p->request_silent_us, p->request_hold_us, 500000)) { return SK_RULE_REQUEST_SILENT; }
  if (!sk_is_within(p->state_frame_age_us, 1, 500000)) { return SK_RULE_STATE_FRAME_AGE; }
  if (!sk_is_within(p->machine_state_age_us, 1, 1000000)) { return SK_RULE_MACHINE_STATE_AGE; }
  if (!sk_is_within(p->operator_age_us, 1, 1000000)) { return SK_RULE_OPERATOR_AGE; }
  if (!cycle_ok(p)) { return SK_RULE_CYCLE; }
  if (!sk_is_within(p->standstill_urad_s, 1, 100000)) { return SK_RULE_STANDSTILL_SPEED; }
  if (!sk_is_within(p->standstill_us, 1, 2000000)) { return SK_RULE_STANDSTILL_TIME; }
  return SK_RULE_NONE;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: \result == SK_RULE_NONE || SK_RULE_BASE_TILT <= \result <= SK_RULE_BASE_FRAME_AGE;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_base_ok(p);
  @ ensures why_base_tilt: \result == SK_RULE_BASE_TILT ==> !sk_rule_base_tilt(p);
  @ ensures why_base_tilt_hard: \result == SK_RULE_BASE_TILT_HARD ==> !sk_rule_base_tilt_hard(p);
  @ ensures why_base_azimuth: \result == SK_RULE_BASE_AZIMUTH ==> !sk_rule_base_azimuth(p);
  @ ensures why_base_frame_age: \result == SK_RULE_BASE_FRAME_AGE ==> !sk_rule_base_frame_age(p);
  @*/
static int32_t check_base(const berm_parameters *p)
{
  if (!sk_is_within(p->base_tilt_urad, 1000, 35000)) { return SK_RULE_BASE_TILT; }
  if (!sk_is_within(p->base_tilt_hard_urad, p->base_tilt_urad, 90000)) { return SK_RULE_BASE_TILT_HARD; }
  if (!sk_is_within(p->base_azimuth_urad, 1000, 35000)) { return SK_RULE_BASE_AZIMUTH; }
  if (!sk_is_within(p->base_frame_age_us, 1, 1000000)) { return SK_RULE_BASE_FRAME_AGE; }
  return SK_RULE_NONE;
}

int32_t sk_parameters_check(const berm_parameters *p)
{
  int32_t rule = check_head(p);
  if (rule == SK_RULE_NONE) { rule = check_kinematics(p); }
  if (rule == SK_RULE_NONE) { rule = check_joints(p); }
  if (rule == SK_RULE_NONE) { rule = sk_check_braking(p); }
  if (rule == SK_RULE_NONE) { rule = sk_check_parts(p); }
  if (rule == SK_RULE_NONE) { rule = check_sensors(p); }
  if (rule == SK_RULE_NONE) { rule = check_map(p); }
  if (rule == SK_RULE_NONE) { rule = check_times(p); }
  if (rule == SK_RULE_NONE) { rule = check_base(p); }
  if (rule == SK_RULE_NONE) { rule = sk_check_overpass(p); }
  if (rule == SK_RULE_NONE) { rule = sk_check_tail(p); }
  if (rule == SK_RULE_NONE) { rule = sk_check_lidars(p); }
  if (rule == SK_RULE_NONE) { rule = sk_check_workspace(p); }
  if (rule == SK_RULE_NONE) { rule = sk_check_sight(p); }
  if (rule == SK_RULE_NONE) { rule = sk_check_stops(p); }
  if (rule == SK_RULE_NONE && !sk_is_within(p->workspace_learn_speed_permille, 50, 1000)) { rule = SK_RULE_LEARN_SPEED; }
  return rule;
}
