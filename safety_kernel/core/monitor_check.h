/* CheckCell (leger-1998, Figure 6): whether a cell of the temporary map is higher than the accumulated map by a moving object. Where this differs from
 * the figure, and why: requirements/workspace_monitor.md. */
#ifndef SK_MONITOR_CHECK_H
#define SK_MONITOR_CHECK_H
#include "monitor_rules.h"
SK_BEGIN

/*@ // no longer in the middle of being scanned, or so for too long
  @ predicate sk_overdue(integer began, integer wait, integer now) = now < 0 || wait < 0 || began > now || began <= now - wait;
  @ predicate sk_due{L}(sk_monitor *m, sk_monitor_rules *r, integer now, integer iy, integer ix, integer flag) = flag == SK_FLAG_NOT_VISITED ||
  @   (flag == SK_FLAG_SET && sk_overdue(\at(m->began_us[iy][ix], L), \at(r->wait_us, L), now));
  @ predicate sk_rises{L}(sk_monitor *m, sk_monitor_rules *r, integer iy, integer ix) =
  @   \at(m->accumulated_flag[iy][ix], L) != SK_FLAG_EMPTY &&
  @   sk_new_height{L}(m, iy, ix) - \at(m->height_mm[iy][ix], L) > \at(r->height_threshold_mm, L);
  @ // by more than one point: a lone one may be spurious, and of two the higher is discarded
  @ predicate sk_stands_out{L}(sk_monitor *m, sk_monitor_rules *r, integer iy, integer ix) = sk_rises{L}(m, r, iy, ix) && !sk_lone{L}(m, iy, ix);
  @
  @ // a neighbour (j, i) of (iy, ix) that is SET, and nearly as high as what is new, or much higher than the cell was
  @ predicate sk_explains{L}(sk_monitor *m, sk_monitor_rules *r, integer iy, integer ix, integer j, integer i) = sk_in_map(j, i) &&
  @   \at(m->accumulated_flag[j][i], L) == SK_FLAG_SET &&
  @   (\at(m->height_mm[j][i], L) > sk_new_height{L}(m, iy, ix) - \at(r->neighbour_threshold_mm, L) ||
  @    \at(m->height_mm[j][i], L) - \at(m->height_mm[iy][ix], L) > \at(r->slope_threshold_mm, L));
  @ predicate sk_explained_in_row{L}(sk_monitor *m, sk_monitor_rules *r, integer iy, integer ix, integer j) =
  @   sk_explains{L}(m, r, iy, ix, j, ix - 1) || sk_explains{L}(m, r, iy, ix, j, ix) || sk_explains{L}(m, r, iy, ix, j, ix + 1);
  @ predicate sk_explained{L}(sk_monitor *m, sk_monitor_rules *r, integer iy, integer ix) =
  @   sk_explained_in_row{L}(m, r, iy, ix, iy - 1) || sk_explained_in_row{L}(m, r, iy, ix, iy + 1) ||
  @   sk_explains{L}(m, r, iy, ix, iy, ix - 1) || sk_explains{L}(m, r, iy, ix, iy, ix + 1);
  @ // beyond the map there is no neighbour, so none that is EMPTY
  @ logic integer sk_empty_at{L}(sk_monitor *m, integer j, integer i) = j < 0 ? 0 : (j >= SK_MAP_CELLS ? 0 : (i < 0 ? 0 :
  @   (i >= SK_MAP_CELLS ? 0 : (\at(m->accumulated_flag[j][i], L) == SK_FLAG_EMPTY ? 1 : 0))));
  @ logic integer sk_empty_in_row{L}(sk_monitor *m, integer j, integer ix) =
  @   sk_empty_at{L}(m, j, ix - 1) + sk_empty_at{L}(m, j, ix) + sk_empty_at{L}(m, j, ix + 1);
  @ logic integer sk_empty_beside{L}(sk_monitor *m, integer iy, integer ix) = sk_empty_in_row{L}(m, iy - 1, ix) +
  @   sk_empty_in_row{L}(m, iy + 1, ix) + sk_empty_at{L}(m, iy, ix - 1) + sk_empty_at{L}(m, iy, ix + 1);
  @ // a rise that sampling errors may have made
  @ predicate sk_excused{L}(sk_monitor *m, sk_monitor_rules *r, integer iy, integer ix) =
  @   sk_explained{L}(m, r, iy, ix) || sk_empty_beside{L}(m, iy, ix) >= 2;
  @ // the flag that CheckCell gives a cell of the temporary map that had `flag`
  @ predicate sk_verdict{L}(sk_monitor *m, sk_monitor_rules *r, integer now, integer iy, integer ix, integer flag, integer verdict) =
  @   (!sk_due{L}(m, r, now, iy, ix, flag) ==> verdict == flag) &&
  @   (sk_due{L}(m, r, now, iy, ix, flag) && !sk_rises{L}(m, r, iy, ix) ==> verdict == SK_FLAG_NOT_VISITED) &&
  @   (sk_due{L}(m, r, now, iy, ix, flag) && sk_rises{L}(m, r, iy, ix) && sk_lone{L}(m, iy, ix) ==> verdict == SK_FLAG_INTERPOLATED_NOT_VISITED) &&
  @   (sk_due{L}(m, r, now, iy, ix, flag) && sk_stands_out{L}(m, r, iy, ix) && sk_excused{L}(m, r, iy, ix) ==> verdict == SK_FLAG_CHANGED) &&
  @   (sk_due{L}(m, r, now, iy, ix, flag) && sk_stands_out{L}(m, r, iy, ix) && !sk_excused{L}(m, r, iy, ix) ==> verdict == SK_FLAG_OBSTACLE);
  @ predicate sk_seen_obstacle{L}(sk_monitor *m, sk_monitor_rules *r, integer now, integer iy, integer ix) =
  @   sk_due{L}(m, r, now, iy, ix, \at(m->temporary_flag[iy][ix], L)) && sk_stands_out{L}(m, r, iy, ix) && !sk_excused{L}(m, r, iy, ix);
  @*/

/* Judges one cell of the temporary map, whatever it, the accumulated map and the rules hold. False, and nothing changed, outside the map. */
/*@ requires \valid(m) && \valid_read(r) && \separated(m, r);
  @ assigns m->temporary_flag[..][..];
  @ ensures accepts: \result == true <==> sk_in_map(iy, ix);
  @ ensures refused: \result == false ==> \forall integer j, i; sk_in_map(j, i) ==> m->temporary_flag[j][i] == \old(m->temporary_flag[j][i]);
  @ ensures checked: \result == true ==> sk_verdict{Pre}(m, r, now_us, iy, ix, \old(m->temporary_flag[iy][ix]), m->temporary_flag[iy][ix]);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> m->temporary_flag[j][i] == \old(m->temporary_flag[j][i]);
  @*/
bool sk_check_cell(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us, int32_t iy, int32_t ix);

/* Judges every modified cell. None is merged yet, so that the order of the list decides nothing. */
/*@ requires \valid(m) && \valid_read(r) && \separated(m, r) && sk_monitor_valid(m);
  @ assigns m->temporary_flag[..][..];
  @ ensures valid: sk_monitor_valid(m);
  @ ensures checked: \forall integer iy, ix; sk_in_map(iy, ix) ==>
  @   sk_verdict{Pre}(m, r, now_us, iy, ix, \old(m->temporary_flag[iy][ix]), m->temporary_flag[iy][ix]);
  @*/
void sk_check_modified(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us);

SK_END
#endif
