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

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && 0 <= r < BERM_BRAKE_REACHES;
  @ assigns \nothing;
  @ ensures \result == true <==> (\forall integer c; 0 <= c < BERM_BRAKE_SPEEDS ==> sk_within(p->brake_angle_urad[j][r][c], 0, 6283186));
  @*/
static bool angle_row_within(const berm_parameters *p, int32_t j, int32_t r)
{
  int32_t c;
  /*@ loop invariant 0 <= c <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer k; 0 <= k < c ==> sk_within(p->brake_angle_urad[j][r][k], 0, 6283186);
    @ loop assigns c;
    @ loop variant BERM_BRAKE_SPEEDS - c;
    @*/
  for (c = 0; c < BERM_BRAKE_SPEEDS; c++) {
    if (!sk_is_within(p->brake_angle_urad[j][r][c], 0, 6283186)) { return false; }
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
    @ loop invariant \forall integer i, m, c; 0 <= i < j && 0 <= m < BERM_BRAKE_REACHES && 0 <= c < BERM_BRAKE_SPEEDS ==> sk_within(p->brake_angle_urad[i][m][c], 0, 6283186);
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m, c; 0 <= m < r && 0 <= c < BERM_BRAKE_SPEEDS ==> sk_within(p->brake_angle_urad[j][m][c], 0, 6283186);
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 0; r < BERM_BRAKE_REACHES; r++) {
      if (!angle_row_within(p, j, r)) { return false; }
    }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && 0 <= r < BERM_BRAKE_REACHES;
  @ assigns \nothing;
  @ ensures \result == true <==> (\forall integer c; 1 <= c < BERM_BRAKE_SPEEDS ==> p->brake_angle_urad[j][r][c - 1] <= p->brake_angle_urad[j][r][c]);
  @*/
static bool angle_row_rises_with_speed(const berm_parameters *p, int32_t j, int32_t r)
{
  int32_t c;
  /*@ loop invariant 1 <= c <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer k; 1 <= k < c ==> p->brake_angle_urad[j][r][k - 1] <= p->brake_angle_urad[j][r][k];
    @ loop assigns c;
    @ loop variant BERM_BRAKE_SPEEDS - c;
    @*/
  for (c = 1; c < BERM_BRAKE_SPEEDS; c++) {
    if (p->brake_angle_urad[j][r][c - 1] > p->brake_angle_urad[j][r][c]) { return false; }
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
    @ loop invariant \forall integer i, m, c; 0 <= i < j && 0 <= m < BERM_BRAKE_REACHES && 1 <= c < BERM_BRAKE_SPEEDS ==> p->brake_angle_urad[i][m][c - 1] <= p->brake_angle_urad[i][m][c];
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m, c; 0 <= m < r && 1 <= c < BERM_BRAKE_SPEEDS ==> p->brake_angle_urad[j][m][c - 1] <= p->brake_angle_urad[j][m][c];
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 0; r < BERM_BRAKE_REACHES; r++) {
      if (!angle_row_rises_with_speed(p, j, r)) { return false; }
    }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && 1 <= r < BERM_BRAKE_REACHES;
  @ assigns \nothing;
  @ ensures \result == true <==> (\forall integer c; 0 <= c < BERM_BRAKE_SPEEDS ==> p->brake_angle_urad[j][r - 1][c] <= p->brake_angle_urad[j][r][c]);
  @*/
static bool angle_row_rises_with_reach(const berm_parameters *p, int32_t j, int32_t r)
{
  int32_t c;
  /*@ loop invariant 0 <= c <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer k; 0 <= k < c ==> p->brake_angle_urad[j][r - 1][k] <= p->brake_angle_urad[j][r][k];
    @ loop assigns c;
    @ loop variant BERM_BRAKE_SPEEDS - c;
    @*/
  for (c = 0; c < BERM_BRAKE_SPEEDS; c++) {
    if (p->brake_angle_urad[j][r - 1][c] > p->brake_angle_urad[j][r][c]) { return false; }
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
    @ loop invariant \forall integer i, m, c; 0 <= i < j && 1 <= m < BERM_BRAKE_REACHES && 0 <= c < BERM_BRAKE_SPEEDS ==> p->brake_angle_urad[i][m - 1][c] <= p->brake_angle_urad[i][m][c];
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 1 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m, c; 1 <= m < r && 0 <= c < BERM_BRAKE_SPEEDS ==> p->brake_angle_urad[j][m - 1][c] <= p->brake_angle_urad[j][m][c];
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 1; r < BERM_BRAKE_REACHES; r++) {
      if (!angle_row_rises_with_reach(p, j, r)) { return false; }
    }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && 0 <= r < BERM_BRAKE_REACHES;
  @ assigns \nothing;
  @ ensures \result == true <==> (\forall integer c; 0 <= c < BERM_BRAKE_SPEEDS ==> sk_within(p->brake_time_us[j][r][c], 0, 30000000));
  @*/
static bool time_row_within(const berm_parameters *p, int32_t j, int32_t r)
{
  int32_t c;
  /*@ loop invariant 0 <= c <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer k; 0 <= k < c ==> sk_within(p->brake_time_us[j][r][k], 0, 30000000);
    @ loop assigns c;
    @ loop variant BERM_BRAKE_SPEEDS - c;
    @*/
  for (c = 0; c < BERM_BRAKE_SPEEDS; c++) {
    if (!sk_is_within(p->brake_time_us[j][r][c], 0, 30000000)) { return false; }
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
    @ loop invariant \forall integer i, m, c; 0 <= i < j && 0 <= m < BERM_BRAKE_REACHES && 0 <= c < BERM_BRAKE_SPEEDS ==> sk_within(p->brake_time_us[i][m][c], 0, 30000000);
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m, c; 0 <= m < r && 0 <= c < BERM_BRAKE_SPEEDS ==> sk_within(p->brake_time_us[j][m][c], 0, 30000000);
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 0; r < BERM_BRAKE_REACHES; r++) {
      if (!time_row_within(p, j, r)) { return false; }
    }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && 0 <= r < BERM_BRAKE_REACHES;
  @ assigns \nothing;
  @ ensures \result == true <==> (\forall integer c; 1 <= c < BERM_BRAKE_SPEEDS ==> p->brake_time_us[j][r][c - 1] <= p->brake_time_us[j][r][c]);
  @*/
static bool time_row_rises_with_speed(const berm_parameters *p, int32_t j, int32_t r)
{
  int32_t c;
  /*@ loop invariant 1 <= c <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer k; 1 <= k < c ==> p->brake_time_us[j][r][k - 1] <= p->brake_time_us[j][r][k];
    @ loop assigns c;
    @ loop variant BERM_BRAKE_SPEEDS - c;
    @*/
  for (c = 1; c < BERM_BRAKE_SPEEDS; c++) {
    if (p->brake_time_us[j][r][c - 1] > p->brake_time_us[j][r][c]) { return false; }
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
    @ loop invariant \forall integer i, m, c; 0 <= i < j && 0 <= m < BERM_BRAKE_REACHES && 1 <= c < BERM_BRAKE_SPEEDS ==> p->brake_time_us[i][m][c - 1] <= p->brake_time_us[i][m][c];
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 0 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m, c; 0 <= m < r && 1 <= c < BERM_BRAKE_SPEEDS ==> p->brake_time_us[j][m][c - 1] <= p->brake_time_us[j][m][c];
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 0; r < BERM_BRAKE_REACHES; r++) {
      if (!time_row_rises_with_speed(p, j, r)) { return false; }
    }
  }
  return true;
}

/*@ requires \valid_read(p) && 0 <= j < SK_JOINTS && 1 <= r < BERM_BRAKE_REACHES;
  @ assigns \nothing;
  @ ensures \result == true <==> (\forall integer c; 0 <= c < BERM_BRAKE_SPEEDS ==> p->brake_time_us[j][r - 1][c] <= p->brake_time_us[j][r][c]);
  @*/
static bool time_row_rises_with_reach(const berm_parameters *p, int32_t j, int32_t r)
{
  int32_t c;
  /*@ loop invariant 0 <= c <= BERM_BRAKE_SPEEDS;
    @ loop invariant \forall integer k; 0 <= k < c ==> p->brake_time_us[j][r - 1][k] <= p->brake_time_us[j][r][k];
    @ loop assigns c;
    @ loop variant BERM_BRAKE_SPEEDS - c;
    @*/
  for (c = 0; c < BERM_BRAKE_SPEEDS; c++) {
    if (p->brake_time_us[j][r - 1][c] > p->brake_time_us[j][r][c]) { return false; }
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
    @ loop invariant \forall integer i, m, c; 0 <= i < j && 1 <= m < BERM_BRAKE_REACHES && 0 <= c < BERM_BRAKE_SPEEDS ==> p->brake_time_us[i][m - 1][c] <= p->brake_time_us[i][m][c];
    @ loop assigns j, r;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    /*@ loop invariant 1 <= r <= BERM_BRAKE_REACHES;
      @ loop invariant \forall integer m, c; 1 <= m < r && 0 <= c < BERM_BRAKE_SPEEDS ==> p->brake_time_us[j][m - 1][c] <= p->brake_time_us[j][m][c];
      @ loop assigns r;
      @ loop variant BERM_BRAKE_REACHES - r;
      @*/
    for (r = 1; r < BERM_BRAKE_REACHES; r++) {
      if (!time_row_rises_with_reach(p, j, r)) { return false; }
    }
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
