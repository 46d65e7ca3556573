/* Parameter check: whether a parameter block may be used. */
#ifndef SK_PARAMETER_CHECK_H
#define SK_PARAMETER_CHECK_H
#include "parameter_rules.h"
SK_BEGIN

/* SK_RULE_NONE when every rule holds, else the first rule broken, for sk_parameter_rule_text() in io. The CRC is checked by the loader over the
 * file's bytes with sk_crc32. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures codes: 0 <= \result < SK_RULES;
  @ ensures whole: \result == SK_RULE_NONE <==> sk_parameters_ok(p);
  @ ensures why_magic: \result == SK_RULE_MAGIC ==> !sk_rule_magic(p);
  @ ensures why_version: \result == SK_RULE_VERSION ==> !sk_rule_version(p);
  @ ensures why_size: \result == SK_RULE_SIZE ==> !sk_rule_size(p);
  @ ensures why_cell: \result == SK_RULE_CELL ==> !sk_rule_cell(p);
  @ ensures why_boom_pin_x: \result == SK_RULE_BOOM_PIN_X ==> !sk_rule_boom_pin_x(p);
  @ ensures why_boom_pin_z: \result == SK_RULE_BOOM_PIN_Z ==> !sk_rule_boom_pin_z(p);
  @ ensures why_boom_length: \result == SK_RULE_BOOM_LENGTH ==> !sk_rule_boom_length(p);
  @ ensures why_stick_length: \result == SK_RULE_STICK_LENGTH ==> !sk_rule_stick_length(p);
  @ ensures why_bucket_length: \result == SK_RULE_BUCKET_LENGTH ==> !sk_rule_bucket_length(p);
  @ ensures why_total_reach: \result == SK_RULE_TOTAL_REACH ==> !sk_rule_total_reach(p);
  @ ensures why_own_body_radius: \result == SK_RULE_OWN_BODY_RADIUS ==> !sk_rule_own_body_radius(p);
  @ ensures why_joint_range: \result == SK_RULE_JOINT_RANGE ==> !sk_rule_joint_range(p);
  @ ensures why_velocity_max: \result == SK_RULE_VELOCITY_MAX ==> !sk_rule_velocity_max(p);
  @ ensures why_acceleration_max: \result == SK_RULE_ACCELERATION_MAX ==> !sk_rule_acceleration_max(p);
  @ ensures why_creep_velocity: \result == SK_RULE_CREEP_VELOCITY ==> !sk_rule_creep_velocity(p);
  @ ensures why_angle_error: \result == SK_RULE_ANGLE_ERROR ==> !sk_rule_angle_error(p);
  @ ensures why_velocity_error: \result == SK_RULE_VELOCITY_ERROR ==> !sk_rule_velocity_error(p);
  @ ensures why_state_latency: \result == SK_RULE_STATE_LATENCY ==> !sk_rule_state_latency(p);
  @ ensures why_command_latency: \result == SK_RULE_COMMAND_LATENCY ==> !sk_rule_command_latency(p);
  @ ensures why_brake_reach_order: \result == SK_RULE_BRAKE_REACH_ORDER ==> !sk_rule_brake_reach_order(p);
  @ ensures why_brake_reach_covers: \result == SK_RULE_BRAKE_REACH_COVERS ==> !sk_rule_brake_reach_covers(p);
  @ ensures why_brake_angle_range: \result == SK_RULE_BRAKE_ANGLE_RANGE ==> !sk_rule_brake_angle_range(p);
  @ ensures why_brake_angle_speed: \result == SK_RULE_BRAKE_ANGLE_SPEED ==> !sk_rule_brake_angle_speed(p);
  @ ensures why_brake_angle_reach: \result == SK_RULE_BRAKE_ANGLE_REACH ==> !sk_rule_brake_angle_reach(p);
  @ ensures why_brake_time_range: \result == SK_RULE_BRAKE_TIME_RANGE ==> !sk_rule_brake_time_range(p);
  @ ensures why_brake_time_speed: \result == SK_RULE_BRAKE_TIME_SPEED ==> !sk_rule_brake_time_speed(p);
  @ ensures why_brake_time_reach: \result == SK_RULE_BRAKE_TIME_REACH ==> !sk_rule_brake_time_reach(p);
  @ ensures why_part_count: \result == SK_RULE_PART_COUNT ==> !sk_rule_part_count(p);
  @ ensures why_part_link: \result == SK_RULE_PART_LINK ==> !sk_rule_part_link(p);
  @ ensures why_part_width: \result == SK_RULE_PART_WIDTH ==> !sk_rule_part_width(p);
  @ ensures why_part_vertex_count: \result == SK_RULE_PART_VERTEX_COUNT ==> !sk_rule_part_vertex_count(p);
  @ ensures why_part_vertex_range: \result == SK_RULE_PART_VERTEX_RANGE ==> !sk_rule_part_vertex_range(p);
  @ ensures why_part_convex: \result == SK_RULE_PART_CONVEX ==> !sk_rule_part_convex(p);
  @ ensures why_part_every_link: \result == SK_RULE_PART_EVERY_LINK ==> !sk_rule_part_every_link(p);
  @ ensures why_scanner_position: \result == SK_RULE_SCANNER_POSITION ==> !sk_rule_scanner_position(p);
  @ ensures why_scanner_pan: \result == SK_RULE_SCANNER_PAN ==> !sk_rule_scanner_pan(p);
  @ ensures why_scanner_pan_rate: \result == SK_RULE_SCANNER_PAN_RATE ==> !sk_rule_scanner_pan_rate(p);
  @ ensures why_scanner_silent: \result == SK_RULE_SCANNER_SILENT ==> !sk_rule_scanner_silent(p);
  @ ensures why_spurious_range: \result == SK_RULE_SPURIOUS_RANGE ==> !sk_rule_spurious_range(p);
  @ ensures why_range_limits: \result == SK_RULE_RANGE_LIMITS ==> !sk_rule_range_limits(p);
  @ ensures why_self_margin: \result == SK_RULE_SELF_MARGIN ==> !sk_rule_self_margin(p);
  @ ensures why_margin: \result == SK_RULE_MARGIN ==> !sk_rule_margin(p);
  @ ensures why_fresh: \result == SK_RULE_FRESH ==> !sk_rule_fresh(p);
  @ ensures why_generation: \result == SK_RULE_GENERATION ==> !sk_rule_generation(p);
  @ ensures why_dig_swing_limit: \result == SK_RULE_DIG_SWING_LIMIT ==> !sk_rule_dig_swing_limit(p);
  @ ensures why_dig_zone_count: \result == SK_RULE_DIG_ZONE_COUNT ==> !sk_rule_dig_zone_count(p);
  @ ensures why_dig_zone_bounds: \result == SK_RULE_DIG_ZONE_BOUNDS ==> !sk_rule_dig_zone_bounds(p);
  @ ensures why_dig_zone_heights: \result == SK_RULE_DIG_ZONE_HEIGHTS ==> !sk_rule_dig_zone_heights(p);
  @ ensures why_request_age: \result == SK_RULE_REQUEST_AGE ==> !sk_rule_request_age(p);
  @ ensures why_request_hold: \result == SK_RULE_REQUEST_HOLD ==> !sk_rule_request_hold(p);
  @ ensures why_request_silent: \result == SK_RULE_REQUEST_SILENT ==> !sk_rule_request_silent(p);
  @ ensures why_state_frame_age: \result == SK_RULE_STATE_FRAME_AGE ==> !sk_rule_state_frame_age(p);
  @ ensures why_machine_state_age: \result == SK_RULE_MACHINE_STATE_AGE ==> !sk_rule_machine_state_age(p);
  @ ensures why_operator_age: \result == SK_RULE_OPERATOR_AGE ==> !sk_rule_operator_age(p);
  @ ensures why_cycle: \result == SK_RULE_CYCLE ==> !sk_rule_cycle(p);
  @ ensures why_standstill_speed: \result == SK_RULE_STANDSTILL_SPEED ==> !sk_rule_standstill_speed(p);
  @ ensures why_standstill_time: \result == SK_RULE_STANDSTILL_TIME ==> !sk_rule_standstill_time(p);
  @ ensures why_base_tilt: \result == SK_RULE_BASE_TILT ==> !sk_rule_base_tilt(p);
  @ ensures why_base_tilt_hard: \result == SK_RULE_BASE_TILT_HARD ==> !sk_rule_base_tilt_hard(p);
  @ ensures why_base_azimuth: \result == SK_RULE_BASE_AZIMUTH ==> !sk_rule_base_azimuth(p);
  @ ensures why_base_frame_age: \result == SK_RULE_BASE_FRAME_AGE ==> !sk_rule_base_frame_age(p);
  @ ensures why_pass_over: \result == SK_RULE_PASS_OVER ==> !sk_rule_pass_over(p);
  @ ensures why_ground_zone_count: \result == SK_RULE_GROUND_ZONE_COUNT ==> !sk_rule_ground_zone_count(p);
  @ ensures why_ground_zone_bounds: \result == SK_RULE_GROUND_ZONE_BOUNDS ==> !sk_rule_ground_zone_bounds(p);
  @ ensures why_ground_zone_limit: \result == SK_RULE_GROUND_ZONE_LIMIT ==> !sk_rule_ground_zone_limit(p);
  @ ensures why_truck_zone_count: \result == SK_RULE_TRUCK_ZONE_COUNT ==> !sk_rule_truck_zone_count(p);
  @ ensures why_truck_zone_bounds: \result == SK_RULE_TRUCK_ZONE_BOUNDS ==> !sk_rule_truck_zone_bounds(p);
  @ ensures why_truck_zone_ceiling: \result == SK_RULE_TRUCK_ZONE_CEILING ==> !sk_rule_truck_zone_ceiling(p);
  @ ensures why_tail_watched: \result == SK_RULE_TAIL_WATCHED ==> !sk_rule_tail_watched(p);
  @ ensures why_tail_radius: \result == SK_RULE_TAIL_RADIUS ==> !sk_rule_tail_radius(p);
  @ ensures why_tail_width: \result == SK_RULE_TAIL_WIDTH ==> !sk_rule_tail_width(p);
  @ ensures why_tail_heights: \result == SK_RULE_TAIL_HEIGHTS ==> !sk_rule_tail_heights(p);
  @ ensures why_tail_clearance: \result == SK_RULE_TAIL_CLEARANCE ==> !sk_rule_tail_clearance(p);
  @ ensures why_tail_fresh: \result == SK_RULE_TAIL_FRESH ==> !sk_rule_tail_fresh(p);
  @ ensures why_lidar_count: \result == SK_RULE_LIDAR_COUNT ==> !sk_rule_lidar_count(p);
  @ ensures why_lidar_position: \result == SK_RULE_LIDAR_POSITION ==> !sk_rule_lidar_position(p);
  @ ensures why_lidar_angles: \result == SK_RULE_LIDAR_ANGLES ==> !sk_rule_lidar_angles(p);
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
  @ ensures why_sight_blind: \result == SK_RULE_SIGHT_BLIND ==> !sk_rule_sight_blind(p);
  @ ensures why_dust_slow: \result == SK_RULE_DUST_SLOW ==> !sk_rule_dust_slow(p);
  @ ensures why_dust_stop: \result == SK_RULE_DUST_STOP ==> !sk_rule_dust_stop(p);
  @ ensures why_dust_speed: \result == SK_RULE_DUST_SPEED ==> !sk_rule_dust_speed(p);
  @ ensures why_dust_dwell: \result == SK_RULE_DUST_DWELL ==> !sk_rule_dust_dwell(p);
  @ ensures why_stop_angle: \result == SK_RULE_STOP_ANGLE ==> !sk_rule_stop_angle(p);
  @ ensures why_stop_time: \result == SK_RULE_STOP_TIME ==> !sk_rule_stop_time(p);
  @ ensures why_learn_speed: \result == SK_RULE_LEARN_SPEED ==> !sk_rule_learn_speed(p);
  @*/
int32_t sk_parameters_check(const berm_parameters *p);

SK_END
#endif
