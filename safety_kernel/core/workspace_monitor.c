#include "workspace_monitor.h"
#include "monitor_list.h"

/*@ requires \valid(m) && sk_in_map(iy, ix);
  @ assigns m->temporary_flag[iy][ix], m->highest_mm[iy][ix], m->second_mm[iy][ix], m->accumulated_flag[iy][ix], m->height_mm[iy][ix],
  @   m->obstacle_height_mm[iy][ix];
  @ ensures sk_cell_blank(m, iy, ix) && sk_heights_blank(m, iy, ix);
  @*/
static void sk_blank_cell(sk_monitor *m, int32_t iy, int32_t ix)
{
  m->temporary_flag[iy][ix] = SK_FLAG_EMPTY;
  m->highest_mm[iy][ix] = SK_NO_HEIGHT;
  m->second_mm[iy][ix] = SK_NO_HEIGHT;
  m->accumulated_flag[iy][ix] = SK_FLAG_EMPTY;
  m->height_mm[iy][ix] = -SK_HEIGHT_MAX_MM;
  m->obstacle_height_mm[iy][ix] = -SK_HEIGHT_MAX_MM;
}

/*@ requires \valid(m) && 0 <= iy < SK_MAP_CELLS;
  @ assigns m->temporary_flag[iy][0 .. SK_MAP_CELLS - 1], m->began_us[iy][0 .. SK_MAP_CELLS - 1], m->highest_mm[iy][0 .. SK_MAP_CELLS - 1],
  @   m->second_mm[iy][0 .. SK_MAP_CELLS - 1], m->accumulated_flag[iy][0 .. SK_MAP_CELLS - 1], m->height_mm[iy][0 .. SK_MAP_CELLS - 1],
  @   m->obstacle_height_mm[iy][0 .. SK_MAP_CELLS - 1], m->place[iy][0 .. SK_MAP_CELLS - 1];
  @ ensures \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> m->temporary_flag[iy][ix] == SK_FLAG_EMPTY;
  @ ensures \forall integer ix; 0 <= ix < SK_MAP_CELLS ==> m->accumulated_flag[iy][ix] == SK_FLAG_EMPTY;
  @*/
static void sk_blank_row(sk_monitor *m, int32_t iy)
{
  int32_t ix;
  /*@ loop invariant 0 <= ix <= SK_MAP_CELLS;
    @ loop invariant \forall integer i; 0 <= i < ix ==> m->temporary_flag[iy][i] == SK_FLAG_EMPTY;
    @ loop invariant \forall integer i; 0 <= i < ix ==> m->accumulated_flag[iy][i] == SK_FLAG_EMPTY;
    @ loop assigns ix, m->temporary_flag[iy][0 .. SK_MAP_CELLS - 1], m->began_us[iy][0 .. SK_MAP_CELLS - 1], m->highest_mm[iy][0 .. SK_MAP_CELLS - 1],
    @   m->second_mm[iy][0 .. SK_MAP_CELLS - 1], m->accumulated_flag[iy][0 .. SK_MAP_CELLS - 1], m->height_mm[iy][0 .. SK_MAP_CELLS - 1],
    @   m->obstacle_height_mm[iy][0 .. SK_MAP_CELLS - 1], m->place[iy][0 .. SK_MAP_CELLS - 1];
    @ loop variant SK_MAP_CELLS - ix;
    @*/
  for (ix = 0; ix < SK_MAP_CELLS; ix++) {
    sk_blank_cell(m, iy, ix);
    m->began_us[iy][ix] = 0;
    m->place[iy][ix] = 0U;
  }
}

void sk_monitor_begin(sk_monitor *m)
{
  int32_t iy;
  /*@ loop invariant 0 <= iy <= SK_MAP_CELLS;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> m->temporary_flag[j][i] == SK_FLAG_EMPTY;
    @ loop invariant \forall integer j, i; 0 <= j < iy && 0 <= i < SK_MAP_CELLS ==> m->accumulated_flag[j][i] == SK_FLAG_EMPTY;
    @ loop assigns iy, m->temporary_flag[..][..], m->began_us[..][..], m->highest_mm[..][..], m->second_mm[..][..], m->accumulated_flag[..][..],
    @   m->height_mm[..][..], m->obstacle_height_mm[..][..], m->place[..][..];
    @ loop variant SK_MAP_CELLS - iy;
    @*/
  for (iy = 0; iy < SK_MAP_CELLS; iy++) { sk_blank_row(m, iy); }
  sk_list_clear(m);
  m->updated_us = -1;
  m->obstacle_us = -1;
}

/*@ assigns \nothing;
  @ ensures \result == sk_clamped(z_mm);
  @*/
static int16_t sk_clamp_point(int32_t z_mm)
{
  if (z_mm > SK_HEIGHT_MAX_MM) { return SK_HEIGHT_MAX_MM; }
  if (z_mm < -SK_HEIGHT_MAX_MM) { return -SK_HEIGHT_MAX_MM; }
  return (int16_t)z_mm;
}

/* The two highest points of those that the cell had and this. */
/*@ requires \valid(m) && sk_in_map(iy, ix);
  @ assigns m->highest_mm[iy][ix], m->second_mm[iy][ix];
  @ ensures sk_joined(\old(m->highest_mm[iy][ix]), \old(m->second_mm[iy][ix]), z_mm, m->highest_mm[iy][ix], m->second_mm[iy][ix]);
  @*/
static void sk_join_point(sk_monitor *m, int32_t iy, int32_t ix, int16_t z_mm)
{
  if (z_mm >= m->highest_mm[iy][ix]) {
    m->second_mm[iy][ix] = m->highest_mm[iy][ix];
    m->highest_mm[iy][ix] = z_mm;
  } else if (z_mm > m->second_mm[iy][ix]) {
    m->second_mm[iy][ix] = z_mm;
  }
}

/*@ requires \valid(m) && sk_in_map(iy, ix);
  @ assigns m->highest_mm[iy][ix], m->second_mm[iy][ix];
  @ ensures first: !sk_has_measured(\old(m->temporary_flag[iy][ix])) ==> m->highest_mm[iy][ix] == z_mm && m->second_mm[iy][ix] == SK_NO_HEIGHT;
  @ ensures joined: sk_has_measured(\old(m->temporary_flag[iy][ix])) ==>
  @   sk_joined(\old(m->highest_mm[iy][ix]), \old(m->second_mm[iy][ix]), z_mm, m->highest_mm[iy][ix], m->second_mm[iy][ix]);
  @*/
static void sk_take_point(sk_monitor *m, int32_t iy, int32_t ix, int16_t z_mm)
{
  uint8_t flag = m->temporary_flag[iy][ix];
  if (flag == SK_FLAG_EMPTY || flag == SK_FLAG_INTERPOLATED || flag == SK_FLAG_INTERPOLATED_NOT_VISITED) {
    m->highest_mm[iy][ix] = z_mm;
    m->second_mm[iy][ix] = SK_NO_HEIGHT;
    return;
  }
  sk_join_point(m, iy, ix, z_mm);
}

bool sk_monitor_insert(sk_monitor *m, int32_t iy, int32_t ix, int32_t z_mm, bool interpolated, int64_t now_us)
{
  if (!sk_is_in_map(iy, ix)) { return false; }
  if (interpolated && m->temporary_flag[iy][ix] != SK_FLAG_EMPTY) { return false; }
  sk_take_point(m, iy, ix, sk_clamp_point(z_mm));
  if (m->temporary_flag[iy][ix] == SK_FLAG_EMPTY) { m->began_us[iy][ix] = now_us; }
  /*@ assert valid: sk_monitor_valid(m); */
  sk_list_add(m, iy, ix);
  m->temporary_flag[iy][ix] = interpolated ? SK_FLAG_INTERPOLATED : SK_FLAG_SET;
  return true;
}

bool sk_monitor_forget(sk_monitor *m, int32_t iy, int32_t ix)
{
  if (!sk_is_in_map(iy, ix)) { return false; }
  sk_blank_cell(m, iy, ix);
  return true;
}

void sk_monitor_update(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us)
{
  sk_check_modified(m, r, now_us);
  /*@ assert unseen: \forall integer iy, ix; sk_in_map(iy, ix) && \at(m->temporary_flag[iy][ix], Pre) == SK_FLAG_EMPTY ==>
    @   m->temporary_flag[iy][ix] == SK_FLAG_EMPTY; */
  sk_merge_modified(m, r);
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_threshold_fits(v_mm);
  @*/
static bool sk_is_threshold(int32_t v_mm)
{
  return v_mm >= 1 && v_mm <= SK_HEIGHT_MAX_MM;
}

bool sk_do_monitor_rules_fit(const sk_monitor_rules *r)
{
  if (!sk_is_threshold(r->height_threshold_mm) || !sk_is_threshold(r->neighbour_threshold_mm) || !sk_is_threshold(r->slope_threshold_mm)) { return false; }
  if (r->wait_us < 0 || r->wait_us > SK_MONITOR_WAIT_MOST_US || r->period_us < 1 || r->period_us > SK_MONITOR_PERIOD_MOST_US) { return false; }
  return r->dwell_us >= 0 && r->dwell_us <= SK_MONITOR_DWELL_MOST_US;
}

/*@ requires \valid_read(m) && \valid_read(r) && now_us >= 0;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_now_due(m, r, now_us);
  @*/
static bool sk_is_update_due(const sk_monitor *m, const sk_monitor_rules *r, int64_t now_us)
{
  if (m->updated_us < 0 || m->updated_us > now_us) { return true; }
  return now_us - m->updated_us >= r->period_us;
}

bool sk_is_monitor_dwelling(int64_t obstacle_us, int32_t dwell_us, int64_t now_us)
{
  if (obstacle_us < 0) { return false; }
  return obstacle_us > now_us || now_us - obstacle_us < dwell_us;
}

/*@ requires \valid(m) && \valid_read(r) && \separated(m, r) && sk_monitor_valid(m) && now_us >= 0;
  @ assigns m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..],
  @   m->modified_iy[..], m->modified_ix[..], m->place[..][..], m->modified, m->overflowed, m->updated_us;
  @ ensures valid: sk_monitor_valid(m);
  @ ensures appears: sk_now_due{Pre}(m, r, now_us) ==> \forall integer iy, ix; sk_in_map(iy, ix) && sk_seen_obstacle{Pre}(m, r, now_us, iy, ix) ==>
  @   sk_holds_obstacle(m, iy, ix);
  @*/
static void sk_update_when_due(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us)
{
  if (!sk_is_update_due(m, r, now_us)) { return; }
  sk_monitor_update(m, r, now_us);
  m->updated_us = now_us;
}

bool sk_monitor_step(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us, sk_monitor_cell *where)
{
  int32_t dwell_us = r->dwell_us;
  if (now_us < 0 || !sk_do_monitor_rules_fit(r)) {
    where->iy = -1;
    where->ix = -1;
    return true;
  }
  sk_update_when_due(m, r, now_us);
  if (sk_find_obstacle(m, r, where)) {
    m->obstacle_us = now_us;
    return true;
  }
  return sk_is_monitor_dwelling(m->obstacle_us, dwell_us, now_us);
}
