/* The Workspace Monitor (leger-1998, section 3): heights that rise in the safety region stop the machine until what rose has left. Points go in as they
 * are seen; every period_us the modified cells are compared with the accumulated map and merged into it. */
#ifndef SK_WORKSPACE_MONITOR_H
#define SK_WORKSPACE_MONITOR_H
#include "monitor_check.h"
#include "monitor_merge.h"
#include "monitor_region.h"
SK_BEGIN

/*@ predicate sk_cell_blank{L}(sk_monitor *m, integer iy, integer ix) =
  @   \at(m->temporary_flag[iy][ix], L) == SK_FLAG_EMPTY && \at(m->accumulated_flag[iy][ix], L) == SK_FLAG_EMPTY;
  @ predicate sk_heights_blank{L}(sk_monitor *m, integer iy, integer ix) = \at(m->height_mm[iy][ix], L) == -SK_HEIGHT_MAX_MM &&
  @   \at(m->obstacle_height_mm[iy][ix], L) == -SK_HEIGHT_MAX_MM;
  @ predicate sk_all_kept{A, B}(sk_monitor *m, integer iy, integer ix) = sk_temporary_kept{A, B}(m, iy, ix) && sk_accumulated_kept{A, B}(m, iy, ix);
  @ predicate sk_has_measured(integer flag) =
  @   flag != SK_FLAG_EMPTY && flag != SK_FLAG_INTERPOLATED && flag != SK_FLAG_INTERPOLATED_NOT_VISITED;
  @ // a point that counts: measured, or the first of the cell
  @ predicate sk_point_counts{L}(sk_monitor *m, integer iy, integer ix, integer interpolated) =
  @   interpolated == 0 || \at(m->temporary_flag[iy][ix], L) == SK_FLAG_EMPTY;
  @ // the two highest of those that the cell had and z
  @ predicate sk_joined(integer highest, integer second, integer z, integer new_highest, integer new_second) =
  @   (z >= highest ==> new_highest == z && new_second == highest) &&
  @   (z < highest ==> new_highest == highest && new_second == (z > second ? z : second));
  @ predicate sk_now_due{L}(sk_monitor *m, sk_monitor_rules *r, integer now) = \at(m->updated_us, L) < 0 || \at(m->updated_us, L) > now ||
  @   now - \at(m->updated_us, L) >= \at(r->period_us, L);
  @ predicate sk_dwelling(integer obstacle, integer dwell, integer now) = obstacle >= 0 && (obstacle > now || now - obstacle < dwell);
  @*/

/* Both maps EMPTY. What is then first seen of a cell is what later heights are compared with, so whoever calls this must know that nobody is in the
 * region, and the machine stands still. */
/*@ requires \valid(m);
  @ assigns m->temporary_flag[..][..], m->began_us[..][..], m->highest_mm[..][..], m->second_mm[..][..], m->accumulated_flag[..][..],
  @   m->height_mm[..][..], m->obstacle_height_mm[..][..], m->place[..][..], m->modified, m->overflowed, m->updated_us, m->obstacle_us;
  @ ensures valid: sk_monitor_valid(m);
  @ ensures blank: \forall integer iy, ix; sk_in_map(iy, ix) ==> sk_cell_blank(m, iy, ix);
  @ ensures times: m->updated_us == -1 && m->obstacle_us == -1 && m->modified == 0 && m->overflowed == false;
  @*/
void sk_monitor_begin(sk_monitor *m);

/* A point over cell (iy, ix) of the temporary map; its height is clamped to +-SK_HEIGHT_MAX_MM. A measured one counts always and overrides interpolated
 * ones, an interpolated one counts in an EMPTY cell only. Returns whether it counted. */
/*@ requires \valid(m) && sk_monitor_valid(m);
  @ assigns m->temporary_flag[..][..], m->began_us[..][..], m->highest_mm[..][..], m->second_mm[..][..], m->modified_iy[..], m->modified_ix[..],
  @   m->place[..][..], m->modified, m->overflowed;
  @ ensures valid: sk_monitor_valid(m);
  @ ensures counts: \result == true <==> sk_in_map(iy, ix) && sk_point_counts{Pre}(m, iy, ix, interpolated);
  @ ensures refused: \result == false ==> \forall integer j, i; sk_in_map(j, i) ==> sk_temporary_kept{Pre, Post}(m, j, i);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> m->temporary_flag[j][i] == \old(m->temporary_flag[j][i]);
  @ ensures others_began: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> m->began_us[j][i] == \old(m->began_us[j][i]);
  @ ensures others_highest: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> m->highest_mm[j][i] == \old(m->highest_mm[j][i]);
  @ ensures others_second: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> m->second_mm[j][i] == \old(m->second_mm[j][i]);
  @ ensures flag: \result == true ==> m->temporary_flag[iy][ix] == (interpolated == true ? SK_FLAG_INTERPOLATED : SK_FLAG_SET);
  @ ensures began: \result == true ==> m->began_us[iy][ix] ==
  @   (\old(m->temporary_flag[iy][ix]) == SK_FLAG_EMPTY ? now_us : \old(m->began_us[iy][ix]));
  @ ensures first: \result == true && !sk_has_measured(\old(m->temporary_flag[iy][ix])) ==>
  @   m->highest_mm[iy][ix] == sk_clamped(z_mm) && m->second_mm[iy][ix] == SK_NO_HEIGHT;
  @ ensures joined: \result == true && sk_has_measured(\old(m->temporary_flag[iy][ix])) ==>
  @   sk_joined(\old(m->highest_mm[iy][ix]), \old(m->second_mm[iy][ix]), sk_clamped(z_mm), m->highest_mm[iy][ix], m->second_mm[iy][ix]);
  @*/
bool sk_monitor_insert(sk_monitor *m, int32_t iy, int32_t ix, int32_t z_mm, bool interpolated, int64_t now_us);

/* Empties the cell in both maps, and with it an obstacle there: what is seen of it next is its ground. For cells of which the ground is known to have
 * become another one (a truck came or went, the base moved), and nobody to be in them. An entry in the list may stay, and leaves at the next update.
 * False, and nothing changed, outside the map. */
/*@ requires \valid(m) && sk_monitor_valid(m);
  @ assigns m->temporary_flag[..][..], m->highest_mm[..][..], m->second_mm[..][..], m->accumulated_flag[..][..], m->height_mm[..][..],
  @   m->obstacle_height_mm[..][..];
  @ ensures valid: sk_monitor_valid(m);
  @ ensures accepts: \result == true <==> sk_in_map(iy, ix);
  @ ensures refused: \result == false ==> \forall integer j, i; sk_in_map(j, i) ==> sk_all_kept{Pre, Post}(m, j, i);
  @ ensures forgotten: \result == true ==> sk_cell_blank(m, iy, ix) && sk_heights_blank(m, iy, ix);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_all_kept{Pre, Post}(m, j, i);
  @*/
bool sk_monitor_forget(sk_monitor *m, int32_t iy, int32_t ix);

/* Compares and merges now. */
/*@ requires \valid(m) && \valid_read(r) && \separated(m, r) && sk_monitor_valid(m);
  @ assigns m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..],
  @   m->modified_iy[..], m->modified_ix[..], m->place[..][..], m->modified, m->overflowed;
  @ ensures valid: sk_monitor_valid(m);
  @ ensures appears: \forall integer iy, ix; sk_in_map(iy, ix) && sk_seen_obstacle{Pre}(m, r, now_us, iy, ix) ==> sk_holds_obstacle(m, iy, ix);
  @ ensures stays: \forall integer iy, ix; sk_in_map(iy, ix) && sk_holds_obstacle{Pre}(m, iy, ix) ==>
  @   sk_holds_obstacle(m, iy, ix) || sk_has_left{Pre}(m, r, iy, ix);
  @ ensures unseen: \forall integer iy, ix; sk_in_map(iy, ix) && \old(m->temporary_flag[iy][ix]) == SK_FLAG_EMPTY ==>
  @   m->temporary_flag[iy][ix] == SK_FLAG_EMPTY;
  @ ensures unseen_flag: \forall integer iy, ix; sk_in_map(iy, ix) && \old(m->temporary_flag[iy][ix]) == SK_FLAG_EMPTY ==>
  @   m->accumulated_flag[iy][ix] == \old(m->accumulated_flag[iy][ix]);
  @ ensures unseen_height: \forall integer iy, ix; sk_in_map(iy, ix) && \old(m->temporary_flag[iy][ix]) == SK_FLAG_EMPTY ==>
  @   m->height_mm[iy][ix] == \old(m->height_mm[iy][ix]) && m->obstacle_height_mm[iy][ix] == \old(m->obstacle_height_mm[iy][ix]);
  @*/
void sk_monitor_update(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us);

/* For every cycle: updates when it is due, and says whether the machine must stop. *where: a cell of the region that holds an obstacle, or -1, -1. With
 * rules that do not fit, or now_us < 0, it must stop and nothing but *where changes. */
/*@ requires \valid(m) && \valid_read(r) && \valid(where) && \separated(m, r, where) && sk_monitor_valid(m);
  @ assigns m->temporary_flag[..][..], m->accumulated_flag[..][..], m->height_mm[..][..], m->obstacle_height_mm[..][..],
  @   m->modified_iy[..], m->modified_ix[..], m->place[..][..], m->modified, m->overflowed, m->updated_us, m->obstacle_us, *where;
  @ ensures valid: sk_monitor_valid(m);
  @ ensures region: sk_obstacle_in_region(m, r) ==> \result == true;
  @ ensures appears: sk_monitor_rules_fit{Pre}(r) && now_us >= 0 && sk_now_due{Pre}(m, r, now_us) ==> \forall integer iy, ix; sk_in_map(iy, ix) &&
  @   sk_seen_obstacle{Pre}(m, r, now_us, iy, ix) && r->watched[iy][ix] != 0 ==> \result == true;
  @ ensures misfit: !sk_monitor_rules_fit{Pre}(r) || now_us < 0 ==> \result == true;
  @ ensures dwells: sk_dwelling(\old(m->obstacle_us), \old(r->dwell_us), now_us) ==> \result == true;
  @ ensures goes: \result == false ==> !sk_obstacle_in_region(m, r) && !sk_dwelling(m->obstacle_us, \old(r->dwell_us), now_us);
  @ ensures needless: \result == true && sk_monitor_rules_fit{Pre}(r) && now_us >= 0 ==> sk_obstacle_in_region(m, r) || sk_dwelling(\old(m->obstacle_us), \old(r->dwell_us), now_us);
  @ ensures where: where->iy >= 0 ==> sk_in_map(where->iy, where->ix) && sk_in_danger(m, r, where->iy, where->ix);
  @*/
bool sk_monitor_step(sk_monitor *m, const sk_monitor_rules *r, int64_t now_us, sk_monitor_cell *where);

/*@ requires \valid_read(r);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_monitor_rules_fit(r);
  @*/
bool sk_do_monitor_rules_fit(const sk_monitor_rules *r);

/* Whether the region has not been clear for dwell_us since obstacle_us. */
/*@ requires now_us >= 0;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_dwelling(obstacle_us, dwell_us, now_us);
  @*/
bool sk_is_monitor_dwelling(int64_t obstacle_us, int32_t dwell_us, int64_t now_us);

SK_END
#endif
