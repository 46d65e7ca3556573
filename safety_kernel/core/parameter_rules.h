/* The rules of the parameter block: their ordinals, and each as a predicate. A limit stands in its predicate and in the code; the proof holds
 * the two together. */
#ifndef SK_PARAMETER_RULES_H
#define SK_PARAMETER_RULES_H
#include "sk_common.h"
#include "config/parameter_block.h"
SK_BEGIN

/* The rules, in the order in which they are checked. The limits are the predicates below. */
enum {
  SK_RULE_NONE = 0,
  SK_RULE_MAGIC = 1, SK_RULE_VERSION = 2, SK_RULE_SIZE = 3, SK_RULE_CELL = 4,
  SK_RULE_BOOM_PIN_X = 5, SK_RULE_BOOM_PIN_Z = 6, SK_RULE_BOOM_LENGTH = 7, SK_RULE_STICK_LENGTH = 8, SK_RULE_BUCKET_LENGTH = 9,
  SK_RULE_TOTAL_REACH = 10, SK_RULE_OWN_BODY_RADIUS = 11,
  SK_RULE_JOINT_RANGE = 12, SK_RULE_VELOCITY_MAX = 13, SK_RULE_ACCELERATION_MAX = 14, SK_RULE_CREEP_VELOCITY = 15,
  SK_RULE_ANGLE_ERROR = 16, SK_RULE_VELOCITY_ERROR = 17, SK_RULE_STATE_LATENCY = 18, SK_RULE_COMMAND_LATENCY = 19,
  SK_RULE_BRAKE_REACH_ORDER = 20, SK_RULE_BRAKE_REACH_COVERS = 21,
  SK_RULE_BRAKE_ANGLE_RANGE = 22, SK_RULE_BRAKE_ANGLE_SPEED = 23, SK_RULE_BRAKE_ANGLE_REACH = 24,
  SK_RULE_BRAKE_TIME_RANGE = 25, SK_RULE_BRAKE_TIME_SPEED = 26, SK_RULE_BRAKE_TIME_REACH = 27,
  SK_RULE_PART_COUNT = 28, SK_RULE_PART_LINK = 29, SK_RULE_PART_WIDTH = 30, SK_RULE_PART_VERTEX_COUNT = 31,
  SK_RULE_PART_VERTEX_RANGE = 32, SK_RULE_PART_CONVEX = 33, SK_RULE_PART_EVERY_LINK = 34,
  SK_RULE_SCANNER_POSITION = 35, SK_RULE_SCANNER_PAN = 36, SK_RULE_SCANNER_PAN_RATE = 37, SK_RULE_SCANNER_SILENT = 38,
  SK_RULE_SPURIOUS_RANGE = 39, SK_RULE_RANGE_LIMITS = 40, SK_RULE_SELF_MARGIN = 41,
  SK_RULE_MARGIN = 42, SK_RULE_FRESH = 43, SK_RULE_GENERATION = 44, SK_RULE_DIG_SWING_LIMIT = 45,
  SK_RULE_DIG_ZONE_COUNT = 46, SK_RULE_DIG_ZONE_BOUNDS = 47, SK_RULE_DIG_ZONE_HEIGHTS = 48,
  SK_RULE_REQUEST_AGE = 49, SK_RULE_REQUEST_HOLD = 50, SK_RULE_REQUEST_SILENT = 51,
  SK_RULE_STATE_FRAME_AGE = 52, SK_RULE_MACHINE_STATE_AGE = 53, SK_RULE_OPERATOR_AGE = 54, SK_RULE_CYCLE = 55,
  SK_RULE_STANDSTILL_SPEED = 56, SK_RULE_STANDSTILL_TIME = 57,
  SK_RULE_BASE_TILT = 58, SK_RULE_BASE_TILT_HARD = 59, SK_RULE_BASE_AZIMUTH = 60, SK_RULE_BASE_FRAME_AGE = 61,
  SK_RULE_PASS_OVER = 62, SK_RULE_GROUND_ZONE_COUNT = 63, SK_RULE_GROUND_ZONE_BOUNDS = 64, SK_RULE_GROUND_ZONE_LIMIT = 65,
  SK_RULE_TRUCK_ZONE_COUNT = 66, SK_RULE_TRUCK_ZONE_BOUNDS = 67, SK_RULE_TRUCK_ZONE_CEILING = 68,
  SK_RULE_TAIL_WATCHED = 69, SK_RULE_TAIL_RADIUS = 70, SK_RULE_TAIL_WIDTH = 71, SK_RULE_TAIL_HEIGHTS = 72, SK_RULE_TAIL_CLEARANCE = 73,
  SK_RULE_TAIL_FRESH = 74,
  SK_RULE_LIDAR_COUNT = 75, SK_RULE_LIDAR_POSITION = 76, SK_RULE_LIDAR_ANGLES = 77,
  SK_RULE_WORKSPACE_WATCHED = 78, SK_RULE_WORKSPACE_RADIUS = 79, SK_RULE_WORKSPACE_HEIGHTS = 80, SK_RULE_WORKSPACE_TIMES = 81,
  SK_RULE_WORKSPACE_FOREIGN = 82, SK_RULE_WORKSPACE_FOLLOWS = 83, SK_RULE_LANE_COUNT = 84, SK_RULE_LANE_BOUNDS = 85,
  SK_RULE_SEPARATION_MODE = 86, SK_RULE_SEPARATION_APPROACH = 87, SK_RULE_SEPARATION_INTRUSION = 88, SK_RULE_WORKSPACE_LIDAR_TIMES = 89,
  SK_RULE_WORKSPACE_HISTOGRAM = 90,
  SK_RULE_SIGHT_BLIND = 91, SK_RULE_DUST_SLOW = 92, SK_RULE_DUST_STOP = 93, SK_RULE_DUST_SPEED = 94, SK_RULE_DUST_DWELL = 95,
  SK_RULE_STOP_ANGLE = 96, SK_RULE_STOP_TIME = 97,
  SK_RULE_LEARN_SPEED = 98,
  SK_RULES = 99
};

#define SK_SLOW_MAX_URAD_S 261799 /* 15 deg/s: recovery motion, and the swing in contact with soil */
#define SK_BRAKE_SHARE 4          /* no joint brakes harder than with so many times its largest acceleration */

/*@ predicate sk_within(integer v, integer low, integer high) = low <= v <= high;
  @
  @ // head
  @ predicate sk_rule_magic(berm_parameters *p) = p->magic == BERM_PARAMETERS_MAGIC;
  @ predicate sk_rule_version(berm_parameters *p) = p->version == BERM_PARAMETERS_VERSION;
  @ predicate sk_rule_size(berm_parameters *p) = p->size == sizeof(berm_parameters);
  @ predicate sk_rule_cell(berm_parameters *p) = p->cell_mm == SK_CELL_MM;
  @ predicate sk_head_ok(berm_parameters *p) = sk_rule_magic(p) && sk_rule_version(p) && sk_rule_size(p) && sk_rule_cell(p);
  @
  @ // kinematics
  @ predicate sk_rule_boom_pin_x(berm_parameters *p) = sk_within(p->boom_pin_x_mm, -3000, 3000);
  @ predicate sk_rule_boom_pin_z(berm_parameters *p) = sk_within(p->boom_pin_z_mm, 0, 5000);
  @ predicate sk_rule_boom_length(berm_parameters *p) = sk_within(p->boom_length_mm, 1000, 12000);
  @ predicate sk_rule_stick_length(berm_parameters *p) = sk_within(p->stick_length_mm, 500, 8000);
  @ predicate sk_rule_bucket_length(berm_parameters *p) = sk_within(p->bucket_length_mm, 300, 4000);
  @ logic integer sk_total_reach(berm_parameters *p) = p->boom_pin_x_mm + p->boom_length_mm + p->stick_length_mm + p->bucket_length_mm;
  @ predicate sk_rule_total_reach(berm_parameters *p) = sk_total_reach(p) <= 15000;
  @ predicate sk_rule_own_body_radius(berm_parameters *p) = sk_within(p->own_body_radius_mm, 500, 6000);
  @ predicate sk_kinematics_ok(berm_parameters *p) =
  @   sk_rule_boom_pin_x(p) && sk_rule_boom_pin_z(p) && sk_rule_boom_length(p) && sk_rule_stick_length(p) && sk_rule_bucket_length(p) &&
  @   sk_rule_total_reach(p) && sk_rule_own_body_radius(p);
  @
  @ // joints; what the frames round alone is an error of half a step: 200 urad, 100 urad/s (berm_can.h)
  @ logic integer sk_joint_limit(integer j) = j == 0 ? 6283186 : 3141593;
  @ predicate sk_rule_joint_range(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==>
  @   -sk_joint_limit(j) <= p->joint_low_urad[j] < p->joint_high_urad[j] <= sk_joint_limit(j);
  @ predicate sk_rule_velocity_max(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_within(p->velocity_max_urad_s[j], 1000, 4000000);
  @ predicate sk_rule_acceleration_max(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==>
  @   sk_within(p->acceleration_max_urad_s2[j], 1000, 50000000);
  @ predicate sk_rule_creep_velocity(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==>
  @   sk_within(p->creep_velocity_urad_s[j], 0, p->velocity_max_urad_s[j]) && p->creep_velocity_urad_s[j] <= SK_SLOW_MAX_URAD_S;
  @ predicate sk_rule_angle_error(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_within(p->angle_error_urad[j], 200, 100000);
  @ predicate sk_rule_velocity_error(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_within(p->velocity_error_urad_s[j], 100, 200000);
  @ predicate sk_rule_state_latency(berm_parameters *p) = sk_within(p->state_latency_us, 1000, 500000);
  @ predicate sk_rule_command_latency(berm_parameters *p) = sk_within(p->command_latency_us, 1000, 1000000);
  @ predicate sk_joints_ok(berm_parameters *p) =
  @   sk_rule_joint_range(p) && sk_rule_velocity_max(p) && sk_rule_acceleration_max(p) && sk_rule_creep_velocity(p) &&
  @   sk_rule_angle_error(p) && sk_rule_velocity_error(p) && sk_rule_state_latency(p) && sk_rule_command_latency(p);
  @
  @ // braking table; the columns reach velocity_max by their definition
  @ predicate sk_rule_brake_reach_order(berm_parameters *p) =
  @   0 < p->brake_reach_mm[0] < p->brake_reach_mm[1] && p->brake_reach_mm[1] < p->brake_reach_mm[2] < p->brake_reach_mm[3] &&
  @   p->brake_reach_mm[3] <= SK_COORD_MAX_MM;
  @ predicate sk_rule_brake_reach_covers(berm_parameters *p) = sk_total_reach(p) <= p->brake_reach_mm[BERM_BRAKE_REACHES - 1];
  @ predicate sk_row_within(int32_t *row, integer high) = \forall integer c; 0 <= c < BERM_BRAKE_SPEEDS ==> sk_within(row[c], 0, high);
  @ predicate sk_row_rises(int32_t *row) = \forall integer c; 1 <= c < BERM_BRAKE_SPEEDS ==> row[c - 1] <= row[c];
  @ predicate sk_row_under(int32_t *row, int32_t *above) = \forall integer c; 0 <= c < BERM_BRAKE_SPEEDS ==> row[c] <= above[c];
  @ predicate sk_joint_angle_range(berm_parameters *p, integer j) = \forall integer r; 0 <= r < BERM_BRAKE_REACHES ==>
  @   sk_row_within(&p->brake_angle_urad[j][r][0], 6283186);
  @ predicate sk_rule_brake_angle_range(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_joint_angle_range(p, j);
  @ predicate sk_joint_angle_speed(berm_parameters *p, integer j) = \forall integer r; 0 <= r < BERM_BRAKE_REACHES ==>
  @   sk_row_rises(&p->brake_angle_urad[j][r][0]);
  @ predicate sk_rule_brake_angle_speed(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_joint_angle_speed(p, j);
  @ predicate sk_joint_angle_reach(berm_parameters *p, integer j) = \forall integer r; 1 <= r < BERM_BRAKE_REACHES ==>
  @   sk_row_under(&p->brake_angle_urad[j][r - 1][0], &p->brake_angle_urad[j][r][0]);
  @ predicate sk_rule_brake_angle_reach(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_joint_angle_reach(p, j);
  @ predicate sk_joint_time_range(berm_parameters *p, integer j) = \forall integer r; 0 <= r < BERM_BRAKE_REACHES ==>
  @   sk_row_within(&p->brake_time_us[j][r][0], 30000000);
  @ predicate sk_rule_brake_time_range(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_joint_time_range(p, j);
  @ predicate sk_joint_time_speed(berm_parameters *p, integer j) = \forall integer r; 0 <= r < BERM_BRAKE_REACHES ==>
  @   sk_row_rises(&p->brake_time_us[j][r][0]);
  @ predicate sk_rule_brake_time_speed(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_joint_time_speed(p, j);
  @ predicate sk_joint_time_reach(berm_parameters *p, integer j) = \forall integer r; 1 <= r < BERM_BRAKE_REACHES ==>
  @   sk_row_under(&p->brake_time_us[j][r - 1][0], &p->brake_time_us[j][r][0]);
  @ predicate sk_rule_brake_time_reach(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_joint_time_reach(p, j);
  @ predicate sk_braking_ok(berm_parameters *p) =
  @   sk_rule_brake_reach_order(p) && sk_rule_brake_reach_covers(p) && sk_rule_brake_angle_range(p) && sk_rule_brake_angle_speed(p) &&
  @   sk_rule_brake_angle_reach(p) && sk_rule_brake_time_range(p) && sk_rule_brake_time_speed(p) && sk_rule_brake_time_reach(p);
  @
  @ // parts: each edge of an outline has every other vertex strictly on its left
  @ logic integer sk_cross(integer ax, integer az, integer bx, integer bz, integer cx, integer cz) = (bx - ax) * (cz - az) - (bz - az) * (cx - ax);
  @ predicate sk_left_of(berm_part *q, integer a, integer b, integer c) =
  @   sk_cross(q->vertex_mm[a][0], q->vertex_mm[a][1], q->vertex_mm[b][0], q->vertex_mm[b][1], q->vertex_mm[c][0], q->vertex_mm[c][1]) > 0;
  @ predicate sk_edge_ok(berm_part *q, integer a, integer b) = \forall integer k; 0 <= k < q->vertices && k != a && k != b ==> sk_left_of(q, a, b, k);
  @ predicate sk_turn_ok(berm_part *q, integer a) = sk_edge_ok(q, a, a + 1);
  @ predicate sk_part_link_ok(berm_part *q) = 1 <= q->link <= 3;
  @ predicate sk_part_width_ok(berm_part *q) = sk_within(q->half_width_mm, 1, 3000);
  @ predicate sk_part_vertex_count_ok(berm_part *q) = 3 <= q->vertices <= BERM_PART_VERTICES;
  @ predicate sk_vertex_ok(berm_part *q, integer k) = sk_within(q->vertex_mm[k][0], -15000, 15000) && sk_within(q->vertex_mm[k][1], -15000, 15000);
  @ predicate sk_part_vertices_ok(berm_part *q) = \forall integer k; 0 <= k < q->vertices ==> sk_vertex_ok(q, k);
  @ predicate sk_part_convex(berm_part *q) =
  @   (\forall integer a; 0 <= a < q->vertices - 1 ==> sk_turn_ok(q, a)) && sk_edge_ok(q, q->vertices - 1, 0);
  @ predicate sk_rule_part_count(berm_parameters *p) = 1 <= p->parts <= BERM_PARTS;
  @ predicate sk_rule_part_link(berm_parameters *p) = \forall integer i; 0 <= i < p->parts ==> sk_part_link_ok(&p->part[i]);
  @ predicate sk_rule_part_width(berm_parameters *p) = \forall integer i; 0 <= i < p->parts ==> sk_part_width_ok(&p->part[i]);
  @ predicate sk_rule_part_vertex_count(berm_parameters *p) = \forall integer i; 0 <= i < p->parts ==> sk_part_vertex_count_ok(&p->part[i]);
  @ predicate sk_rule_part_vertex_range(berm_parameters *p) = \forall integer i; 0 <= i < p->parts ==> sk_part_vertices_ok(&p->part[i]);
  @ predicate sk_rule_part_convex(berm_parameters *p) = \forall integer i; 0 <= i < p->parts ==> sk_part_convex(&p->part[i]);
  @ predicate sk_link_covered(berm_parameters *p, integer link) = \exists integer i; 0 <= i < p->parts && p->part[i].link == link;
  @ predicate sk_rule_part_every_link(berm_parameters *p) = sk_link_covered(p, 1) && sk_link_covered(p, 2) && sk_link_covered(p, 3);
  @ predicate sk_parts_ok(berm_parameters *p) =
  @   sk_rule_part_count(p) && sk_rule_part_link(p) && sk_rule_part_width(p) && sk_rule_part_vertex_count(p) && sk_rule_part_vertex_range(p) &&
  @   sk_rule_part_convex(p) && sk_rule_part_every_link(p);
  @
  @ // sensors
  @ predicate sk_mount_position_ok(berm_scanner_mount *m) = sk_within(m->x_mm, -5000, 5000) && sk_within(m->y_mm, -5000, 5000) && sk_within(m->z_mm, 0, 8000);
  @ predicate sk_mount_pan_ok(berm_scanner_mount *m) = -3141593 <= m->pan_low_urad < m->pan_high_urad <= 3141593;
  @ predicate sk_rule_scanner_position(berm_parameters *p) = sk_mount_position_ok(&p->scanner[0]) && sk_mount_position_ok(&p->scanner[1]);
  @ predicate sk_rule_scanner_pan(berm_parameters *p) = sk_mount_pan_ok(&p->scanner[0]) && sk_mount_pan_ok(&p->scanner[1]);
  @ predicate sk_rule_scanner_pan_rate(berm_parameters *p) =
  @   sk_within(p->scanner[0].pan_rate_max_urad_s, 1, 10000000) && sk_within(p->scanner[1].pan_rate_max_urad_s, 1, 10000000);
  @ predicate sk_rule_scanner_silent(berm_parameters *p) = sk_within(p->scanner_silent_us, 1000, 5000000);
  @ predicate sk_rule_spurious_range(berm_parameters *p) = sk_within(p->spurious_range_mm, 1, 100000);
  @ predicate sk_rule_range_limits(berm_parameters *p) = 0 <= p->range_min_mm < p->range_max_mm <= 262140;
  @ predicate sk_rule_self_margin(berm_parameters *p) = sk_within(p->self_margin_mm, 0, 2000);
  @ predicate sk_sensors_ok(berm_parameters *p) =
  @   sk_rule_scanner_position(p) && sk_rule_scanner_pan(p) && sk_rule_scanner_pan_rate(p) && sk_rule_scanner_silent(p) &&
  @   sk_rule_spurious_range(p) && sk_rule_range_limits(p) && sk_rule_self_margin(p);
  @
  @ // map and clearance
  @ predicate sk_rectangle_ok(integer x_low, integer y_low, integer x_high, integer y_high) =
  @   -15000 <= x_low < x_high <= 15000 && -15000 <= y_low < y_high <= 15000;
  @ predicate sk_zone_bounds_ok(berm_dig_zone *z) = sk_rectangle_ok(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm);
  @ predicate sk_zone_heights_ok(berm_dig_zone *z) = -SK_HEIGHT_MAX_MM <= z->floor_mm < z->ceiling_mm <= SK_HEIGHT_MAX_MM;
  @ predicate sk_rule_margin(berm_parameters *p) = sk_within(p->margin_mm, 100, 3000);
  @ predicate sk_rule_fresh(berm_parameters *p) = sk_within(p->fresh_us, 1, 600000000);
  @ predicate sk_rule_generation(berm_parameters *p) = sk_within(p->generation_us, 1, p->fresh_us);
  @ predicate sk_rule_dig_swing_limit(berm_parameters *p) =
  @   sk_within(p->dig_swing_limit_urad_s, 0, p->velocity_max_urad_s[0]) && p->dig_swing_limit_urad_s <= SK_SLOW_MAX_URAD_S;
  @ predicate sk_rule_dig_zone_count(berm_parameters *p) = sk_within(p->dig_zones, 0, BERM_DIG_ZONES);
  @ predicate sk_rule_dig_zone_bounds(berm_parameters *p) = \forall integer i; 0 <= i < p->dig_zones ==> sk_zone_bounds_ok(&p->dig_zone[i]);
  @ predicate sk_rule_dig_zone_heights(berm_parameters *p) = \forall integer i; 0 <= i < p->dig_zones ==> sk_zone_heights_ok(&p->dig_zone[i]);
  @ predicate sk_map_rules_ok(berm_parameters *p) =
  @   sk_rule_margin(p) && sk_rule_fresh(p) && sk_rule_generation(p) && sk_rule_dig_swing_limit(p) && sk_rule_dig_zone_count(p) &&
  @   sk_rule_dig_zone_bounds(p) && sk_rule_dig_zone_heights(p);
  @
  @ // times; hold within 50 ms and latched stop within 500 ms are promised, so nobody may configure more; a cycle 20 ms after the last counts as late,
  @ // and neither latency is shorter than a cycle
  @ predicate sk_rule_request_age(berm_parameters *p) = sk_within(p->request_age_us, 1, 500000);
  @ predicate sk_rule_request_hold(berm_parameters *p) = sk_within(p->request_hold_us, 1, 50000);
  @ predicate sk_rule_request_silent(berm_parameters *p) = sk_within(p->request_silent_us, p->request_hold_us, 500000);
  @ predicate sk_rule_state_frame_age(berm_parameters *p) = sk_within(p->state_frame_age_us, 1, 500000);
  @ predicate sk_rule_machine_state_age(berm_parameters *p) = sk_within(p->machine_state_age_us, 1, 1000000);
  @ predicate sk_rule_operator_age(berm_parameters *p) = sk_within(p->operator_age_us, 1, 1000000);
  @ predicate sk_rule_cycle(berm_parameters *p) =
  @   sk_within(p->cycle_us, 1000, 20000) && p->cycle_us <= p->state_latency_us && p->cycle_us <= p->command_latency_us;
  @ predicate sk_rule_standstill_speed(berm_parameters *p) = sk_within(p->standstill_urad_s, 1, 100000);
  @ predicate sk_rule_standstill_time(berm_parameters *p) = sk_within(p->standstill_us, 1, 2000000);
  @ predicate sk_times_ok(berm_parameters *p) =
  @   sk_rule_request_age(p) && sk_rule_request_hold(p) && sk_rule_request_silent(p) && sk_rule_state_frame_age(p) && sk_rule_machine_state_age(p) &&
  @   sk_rule_operator_age(p) && sk_rule_cycle(p) && sk_rule_standstill_speed(p) && sk_rule_standstill_time(p);
  @
  @ // motion of the base
  @ predicate sk_rule_base_tilt(berm_parameters *p) = sk_within(p->base_tilt_urad, 1000, 35000);
  @ predicate sk_rule_base_tilt_hard(berm_parameters *p) = sk_within(p->base_tilt_hard_urad, p->base_tilt_urad, 90000);
  @ predicate sk_rule_base_azimuth(berm_parameters *p) = sk_within(p->base_azimuth_urad, 1000, 35000);
  @ predicate sk_rule_base_frame_age(berm_parameters *p) = sk_within(p->base_frame_age_us, 1, 1000000);
  @ predicate sk_base_ok(berm_parameters *p) =
  @   sk_rule_base_tilt(p) && sk_rule_base_tilt_hard(p) && sk_rule_base_azimuth(p) && sk_rule_base_frame_age(p);
  @
  @ // overpass rule
  @ predicate sk_height_ok(integer z) = sk_within(z, -SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM);
  @ predicate sk_ground_bounds_ok(berm_ground_zone *z) = sk_rectangle_ok(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm);
  @ predicate sk_truck_bounds_ok(berm_truck_zone *z) = sk_rectangle_ok(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm);
  @ predicate sk_rule_pass_over(berm_parameters *p) = sk_height_ok(p->pass_over_mm);
  @ predicate sk_rule_ground_zone_count(berm_parameters *p) = sk_within(p->ground_zones, 0, BERM_GROUND_ZONES);
  @ predicate sk_rule_ground_zone_bounds(berm_parameters *p) = \forall integer i; 0 <= i < p->ground_zones ==> sk_ground_bounds_ok(&p->ground_zone[i]);
  @ predicate sk_rule_ground_zone_limit(berm_parameters *p) = \forall integer i; 0 <= i < p->ground_zones ==> sk_height_ok(p->ground_zone[i].pass_over_mm);
  @ predicate sk_rule_truck_zone_count(berm_parameters *p) = sk_within(p->truck_zones, 0, BERM_TRUCK_ZONES);
  @ predicate sk_rule_truck_zone_bounds(berm_parameters *p) = \forall integer i; 0 <= i < p->truck_zones ==> sk_truck_bounds_ok(&p->truck_zone[i]);
  @ predicate sk_rule_truck_zone_ceiling(berm_parameters *p) = \forall integer i; 0 <= i < p->truck_zones ==> sk_height_ok(p->truck_zone[i].ceiling_mm);
  @ predicate sk_overpass_ok(berm_parameters *p) =
  @   sk_rule_pass_over(p) && sk_rule_ground_zone_count(p) && sk_rule_ground_zone_bounds(p) && sk_rule_ground_zone_limit(p) &&
  @   sk_rule_truck_zone_count(p) && sk_rule_truck_zone_bounds(p) && sk_rule_truck_zone_ceiling(p);
  @
  @ // the upper body's tail: no larger than the own body, or its own returns would block it; and what is to be free reaches beyond the cells of the own
  @ // body's rim, of which no sensor tells
  @ predicate sk_rule_tail_watched(berm_parameters *p) = sk_within(p->tail_watched, 0, 1);
  @ predicate sk_rule_tail_radius(berm_parameters *p) = sk_within(p->tail_radius_mm, 500, p->own_body_radius_mm);
  @ predicate sk_rule_tail_width(berm_parameters *p) = sk_within(p->tail_half_width_mm, 100, p->tail_radius_mm);
  @ predicate sk_rule_tail_heights(berm_parameters *p) = 0 <= p->tail_low_mm < p->tail_high_mm <= 10000;
  @ predicate sk_rule_tail_clearance(berm_parameters *p) = sk_within(p->tail_clearance_mm, 500, 3000);
  @ predicate sk_rule_tail_fresh(berm_parameters *p) = sk_within(p->tail_fresh_us, 1, p->fresh_us);
  @ predicate sk_tail_ok(berm_parameters *p) =
  @   sk_rule_tail_watched(p) && sk_rule_tail_radius(p) && sk_rule_tail_width(p) && sk_rule_tail_heights(p) && sk_rule_tail_clearance(p) &&
  @   sk_rule_tail_fresh(p);
  @
  @ // lidars on the upper body
  @ predicate sk_lidar_position_ok(berm_lidar_mount *m) = sk_within(m->x_mm, -5000, 5000) && sk_within(m->y_mm, -5000, 5000) && sk_within(m->z_mm, 0, 8000);
  @ predicate sk_lidar_angles_ok(berm_lidar_mount *m) =
  @   sk_within(m->roll_urad, -3141593, 3141593) && sk_within(m->pitch_urad, -3141593, 3141593) && sk_within(m->yaw_urad, -3141593, 3141593);
  @ predicate sk_rule_lidar_count(berm_parameters *p) = sk_within(p->lidars, 0, BERM_LIDARS);
  @ predicate sk_rule_lidar_position(berm_parameters *p) = \forall integer i; 0 <= i < p->lidars ==> sk_lidar_position_ok(&p->lidar[i]);
  @ predicate sk_rule_lidar_angles(berm_parameters *p) = \forall integer i; 0 <= i < p->lidars ==> sk_lidar_angles_ok(&p->lidar[i]);
  @ predicate sk_lidars_ok(berm_parameters *p) = sk_rule_lidar_count(p) && sk_rule_lidar_position(p) && sk_rule_lidar_angles(p);
  @
  @ // the Workspace Monitor
  @ predicate sk_lane_ok(berm_lane *z) = sk_rectangle_ok(z->x_low_mm, z->y_low_mm, z->x_high_mm, z->y_high_mm);
  @ predicate sk_rule_workspace_watched(berm_parameters *p) = sk_within(p->workspace_watched, 0, 1);
  @ predicate sk_rule_workspace_radius(berm_parameters *p) = sk_within(p->workspace_radius_mm, p->own_body_radius_mm, 15000);
  @ predicate sk_rule_workspace_heights(berm_parameters *p) = sk_within(p->workspace_rise_mm, 100, 2000) &&
  @   sk_within(p->workspace_neighbour_mm, 100, 2000) && sk_within(p->workspace_slope_mm, 100, 5000);
  @ predicate sk_rule_workspace_times(berm_parameters *p) = sk_within(p->workspace_wait_us, 0, 10000000) &&
  @   sk_within(p->workspace_period_us, 1, 1000000) && sk_within(p->workspace_dwell_us, 0, 60000000) &&
  @   sk_within(p->workspace_learn_us, 0, 120000000);
  @ predicate sk_rule_workspace_foreign(berm_parameters *p) = sk_within(p->workspace_foreign, 0, 100);
  @ predicate sk_rule_workspace_lidar_times(berm_parameters *p) = sk_within(p->workspace_lidar_wait_us, 0, 10000000) &&
  @   sk_within(p->workspace_lidar_period_us, 1, 1000000);
  @ predicate sk_rule_workspace_follows(berm_parameters *p) = sk_within(p->workspace_follows, 0, 1);
  @ predicate sk_rule_workspace_histogram(berm_parameters *p) = sk_within(p->workspace_histogram, 0, 1);
  @ predicate sk_rule_lane_count(berm_parameters *p) = sk_within(p->lanes, 0, BERM_LANES);
  @ predicate sk_rule_lane_bounds(berm_parameters *p) = \forall integer i; 0 <= i < p->lanes ==> sk_lane_ok(&p->lane[i]);
  @ predicate sk_rule_separation_mode(berm_parameters *p) = sk_within(p->workspace_separation, BERM_SEPARATION_NONE, BERM_SEPARATION_ENFORCED);
  @ predicate sk_rule_separation_approach(berm_parameters *p) = sk_within(p->workspace_approach_mm_s, 500, 5000);
  @ predicate sk_rule_separation_intrusion(berm_parameters *p) = sk_within(p->workspace_intrusion_mm, 0, 3000);
  @ predicate sk_workspace_ok(berm_parameters *p) =
  @   sk_rule_workspace_watched(p) && sk_rule_workspace_radius(p) && sk_rule_workspace_heights(p) && sk_rule_workspace_times(p) &&
  @   sk_rule_workspace_foreign(p) && sk_rule_workspace_follows(p) && sk_rule_lane_count(p) && sk_rule_lane_bounds(p) &&
  @   sk_rule_separation_mode(p) && sk_rule_separation_approach(p) && sk_rule_separation_intrusion(p) && sk_rule_workspace_lidar_times(p) &&
  @   sk_rule_workspace_histogram(p);
  @
  @ // what the sensors can see
  @ predicate sk_rule_sight_blind(berm_parameters *p) = sk_within(p->sight_blind_permille, 50, 1000);
  @ predicate sk_rule_dust_slow(berm_parameters *p) = sk_within(p->dust_slow_permille, 1, 1000);
  @ predicate sk_rule_dust_stop(berm_parameters *p) = sk_within(p->dust_stop_permille, p->dust_slow_permille, 1000);
  @ predicate sk_rule_dust_speed(berm_parameters *p) = sk_within(p->dust_speed_permille, 50, 1000);
  @ predicate sk_rule_dust_dwell(berm_parameters *p) = sk_within(p->dust_dwell_us, 0, 60000000);
  @ predicate sk_sight_ok(berm_parameters *p) =
  @   sk_rule_sight_blind(p) && sk_rule_dust_slow(p) && sk_rule_dust_stop(p) && sk_rule_dust_speed(p) && sk_rule_dust_dwell(p);
  @
  @ // the shortest stops: a column's speed is k/7 of the largest, and no joint brakes harder than with SK_BRAKE_SHARE times its largest acceleration a, so
  @ // way >= speed^2 / (2 SK_BRAKE_SHARE a) and time >= speed / (SK_BRAKE_SHARE a); both are above 0 in every column but the first
  @ predicate sk_way_possible(integer k, integer velocity, integer a, integer angle) =
  @   (k * velocity) * (k * velocity) <= (98 * SK_BRAKE_SHARE) * (a * angle);
  @ predicate sk_time_possible(integer k, integer velocity, integer a, integer time) = 1000000 * (k * velocity) <= (7 * SK_BRAKE_SHARE) * (a * time);
  @ predicate sk_row_ways(int32_t *row, integer velocity, integer a) = \forall integer c; 0 <= c < BERM_BRAKE_SPEEDS ==>
  @   sk_way_possible(c, velocity, a, row[c]);
  @ predicate sk_row_times(int32_t *row, integer velocity, integer a) = \forall integer c; 0 <= c < BERM_BRAKE_SPEEDS ==>
  @   sk_time_possible(c, velocity, a, row[c]);
  @ predicate sk_joint_ways(berm_parameters *p, integer j) = \forall integer r; 0 <= r < BERM_BRAKE_REACHES ==>
  @   sk_row_ways(&p->brake_angle_urad[j][r][0], p->velocity_max_urad_s[j], p->acceleration_max_urad_s2[j]);
  @ predicate sk_joint_times(berm_parameters *p, integer j) = \forall integer r; 0 <= r < BERM_BRAKE_REACHES ==>
  @   sk_row_times(&p->brake_time_us[j][r][0], p->velocity_max_urad_s[j], p->acceleration_max_urad_s2[j]);
  @ predicate sk_rule_stop_angle(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_joint_ways(p, j);
  @ predicate sk_rule_stop_time(berm_parameters *p) = \forall integer j; 0 <= j < SK_JOINTS ==> sk_joint_times(p, j);
  @ predicate sk_stops_ok(berm_parameters *p) = sk_rule_stop_angle(p) && sk_rule_stop_time(p);
  @
  @ // while the ground is learned
  @ predicate sk_rule_learn_speed(berm_parameters *p) = sk_within(p->workspace_learn_speed_permille, 50, 1000);
  @
  @ predicate sk_parameters_ok(berm_parameters *p) =
  @   sk_head_ok(p) && sk_kinematics_ok(p) && sk_joints_ok(p) && sk_braking_ok(p) && sk_parts_ok(p) && sk_sensors_ok(p) && sk_map_rules_ok(p) &&
  @   sk_times_ok(p) && sk_base_ok(p) && sk_overpass_ok(p) && sk_tail_ok(p) && sk_lidars_ok(p) && sk_workspace_ok(p) && sk_sight_ok(p) &&
  @   sk_stops_ok(p) && sk_rule_learn_speed(p);
  @*/

SK_END
#endif
