#include "parameter_braking.h"
#include "parameter_range.h"

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_brake_reach_order(p);
  @*/
static bool reach_ordered(const berm_parameters *p)
{
  const int32_t *v = p->brake_reach_mm;
  return 0 < v[0] && v[0] < v[1] && v[1] < v[2] && v[2] < v[3] && v[3] <= SK_COORD_MAX_MM;
}

/*@ requires \valid_read(row + (0 .. BERM_BRAKE_SPEEDS - 1));
  @ assigns \nothing;
  @ ensures \result == true <==> sk_row_within(row, high);
  @*/
static bool row_within(const int32_t *row, int32_t high)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer c; 0 <= c < k ==> sk_within(row[c], 0, high);
    @ loop assigns k;
    @ loop variant BERM_BRAKE_SPEEDS - k;
    @*/
  for (k = 0; k < BERM_BRAKE_SPEEDS; k++) {
    if (!sk_is_within(row[k], 0, high)) { return false; }
  }
  return true;
}

/*@ requires \valid_read(row + (0 .. BERM_BRAKE_SPEEDS - 1));
  @ assigns \nothing;
  @ ensures \result == true <==> sk_row_rises(row);
  @*/
static bool row_rises(const int32_t *row)
{
  int32_t k;
  /*@ loop invariant 1 <= k <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer c; 1 <= c < k ==> row[c - 1] <= row[c];
    @ loop assigns k;
    @ loop variant BERM_BRAKE_SPEEDS - k;
    @*/
  for (k = 1; k < BERM_BRAKE_SPEEDS; k++) {
    if (row[k - 1] > row[k]) { return false; }
  }
  return true;
}

/*@ requires \valid_read(row + (0 .. BERM_BRAKE_SPEEDS - 1)) && \valid_read(above + (0 .. BERM_BRAKE_SPEEDS - 1));
  @ assigns \nothing;
  @ ensures \result == true <==> sk_row_under(row, above);
  @*/
static bool row_under(const int32_t *row, const int32_t *above)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer c; 0 <= c < k ==> row[c] <= above[c];
    @ loop assigns k;
    @ loop variant BERM_BRAKE_SPEEDS - k;
    @*/
  for (k = 0; k < BERM_BRAKE_SPEEDS; k++) {
    if (row[k] > above[k]) { return false; }
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_brake_angle_range(p);
  @*/
static bool angles_within(const berm_parameters *p)
{
  int32_t j, r;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_joint_angle_range(p, i);
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m; 0 <= m < r ==> sk_row_within(&p->brake_angle_urad[j][m][0], 6283186);
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 0; r < BERM_BRAKE_REACHES; r++) {
      if (!row_within(p->brake_angle_urad[j][r], 6283186)) {
        /*@ assert !sk_joint_angle_range(p, j); */
        return false;
      }
    }
    /*@ assert sk_joint_angle_range(p, j); */
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_brake_angle_speed(p);
  @*/
static bool angles_rise_with_speed(const berm_parameters *p)
{
  int32_t j, r;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_joint_angle_speed(p, i);
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m; 0 <= m < r ==> sk_row_rises(&p->brake_angle_urad[j][m][0]);
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 0; r < BERM_BRAKE_REACHES; r++) {
      if (!row_rises(p->brake_angle_urad[j][r])) {
        /*@ assert !sk_joint_angle_speed(p, j); */
        return false;
      }
    }
    /*@ assert sk_joint_angle_speed(p, j); */
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_brake_angle_reach(p);
  @*/
static bool angles_rise_with_reach(const berm_parameters *p)
{
  int32_t j, r;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_joint_angle_reach(p, i);
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 1 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m; 1 <= m < r ==> sk_row_under(&p->brake_angle_urad[j][m - 1][0], &p->brake_angle_urad[j][m][0]);
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 1; r < BERM_BRAKE_REACHES; r++) {
      if (!row_under(p->brake_angle_urad[j][r - 1], p->brake_angle_urad[j][r])) {
        /*@ assert !sk_joint_angle_reach(p, j); */
        return false;
      }
    }
    /*@ assert sk_joint_angle_reach(p, j); */
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_brake_time_range(p);
  @*/
static bool times_within(const berm_parameters *p)
{
  int32_t j, r;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_joint_time_range(p, i);
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m; 0 <= m < r ==> sk_row_within(&p->brake_time_us[j][m][0], 30000000);
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 0; r < BERM_BRAKE_REACHES; r++) {
      if (!row_within(p->brake_time_us[j][r], 30000000)) {
        /*@ assert !sk_joint_time_range(p, j); */
        return false;
      }
    }
    /*@ assert sk_joint_time_range(p, j); */
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_brake_time_speed(p);
  @*/
static bool times_rise_with_speed(const berm_parameters *p)
{
  int32_t j, r;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_joint_time_speed(p, i);
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m; 0 <= m < r ==> sk_row_rises(&p->brake_time_us[j][m][0]);
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 0; r < BERM_BRAKE_REACHES; r++) {
      if (!row_rises(p->brake_time_us[j][r])) {
        /*@ assert !sk_joint_time_speed(p, j); */
        return false;
      }
    }
    /*@ assert sk_joint_time_speed(p, j); */
  }
  return true;
}

/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_rule_brake_time_reach(p);
  @*/
static bool times_rise_with_reach(const berm_parameters *p)
{
  int32_t j, r;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_joint_time_reach(p, i);
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 1 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m; 1 <= m < r ==> sk_row_under(&p->brake_time_us[j][m - 1][0], &p->brake_time_us[j][m][0]);
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 1; r < BERM_BRAKE_REACHES; r++) {
      if (!row_under(p->brake_time_us[j][r - 1], p->brake_time_us[j][r])) {
        /*@ assert !sk_joint_time_reach(p, j); */
        return false;
      }
    }
    /*@ assert sk_joint_time_reach(p, j); */
  }
  return true;
}

int32_t sk_check_braking(const berm_parameters *p)
{
  if (!reach_ordered(p)) { return SK_RULE_BRAKE_REACH_ORDER; }
  if (sk_reach_total(p) > (int64_t)p->brake_reach_mm[BERM_BRAKE_REACHES - 1]) { return SK_RULE_BRAKE_REACH_COVERS; }
  if (!angles_within(p)) { return SK_RULE_BRAKE_ANGLE_RANGE; }
  if (!angles_rise_with_speed(p)) { return SK_RULE_BRAKE_ANGLE_SPEED; }
  if (!angles_rise_with_reach(p)) { return SK_RULE_BRAKE_ANGLE_REACH; }
  if (!times_within(p)) { return SK_RULE_BRAKE_TIME_RANGE; }
  if (!times_rise_with_speed(p)) { return SK_RULE_BRAKE_TIME_SPEED; }
  if (!times_rise_with_reach(p)) { return SK_RULE_BRAKE_TIME_REACH; }
  return SK_RULE_NONE;
}
