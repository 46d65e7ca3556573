/* The list of the temporary map's modified cells: a set with a place for each cell, so that none is listed twice. For the files of the core only. */
#ifndef SK_MONITOR_LIST_H
#define SK_MONITOR_LIST_H
#include "monitor_map.h"
SK_BEGIN

/*@ requires \valid(m);
  @ assigns m->modified, m->overflowed;
  @ ensures sk_list_ok(m) && m->modified == 0 && m->overflowed == false;
  @*/
void sk_list_clear(sk_monitor *m);

/* Lists the cell unless it is. When the list is full, or was, the cell may be missing and `overflowed` says so. */
/*@ requires \valid(m) && sk_in_map(iy, ix) && sk_list_ok(m);
  @ assigns m->modified_iy[0 .. SK_MODIFIED_MOST - 1], m->modified_ix[0 .. SK_MODIFIED_MOST - 1], m->place[iy][ix], m->modified, m->overflowed;
  @ ensures ok: sk_list_ok(m);
  @ ensures listed: m->overflowed == true || sk_listed(m, iy, ix);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && sk_listed{Pre}(m, j, i) ==> sk_listed{Post}(m, j, i);
  @ ensures lasting: \old(m->overflowed) == true ==> m->overflowed == true;
  @ ensures only_full: m->overflowed == true ==> \old(m->overflowed) == true || \old(m->modified) == SK_MODIFIED_MOST;
  @*/
void sk_list_add(sk_monitor *m, int32_t iy, int32_t ix);

/* Takes out entry k; the last entry takes its place, all others keep theirs. */
/*@ requires \valid(m) && sk_list_ok(m) && 0 <= k < m->modified;
  @ assigns m->modified_iy[k], m->modified_ix[k], m->place[0 .. SK_MAP_CELLS - 1][0 .. SK_MAP_CELLS - 1], m->modified;
  @ ensures ok: sk_list_ok(m) && m->modified == \old(m->modified) - 1;
  @ ensures below: \forall integer j, i; sk_in_map(j, i) && sk_listed{Pre}(m, j, i) && \old(m->place[j][i]) < k ==>
  @   sk_listed{Post}(m, j, i) && m->place[j][i] == \old(m->place[j][i]);
  @ ensures above: \forall integer j, i; sk_in_map(j, i) && sk_listed{Pre}(m, j, i) && \old(m->place[j][i]) > k ==>
  @   sk_listed{Post}(m, j, i) && m->place[j][i] >= k;
  @ ensures none: \forall integer j, i; sk_in_map(j, i) && sk_listed{Post}(m, j, i) && m->place[j][i] < k ==>
  @   sk_listed{Pre}(m, j, i) && m->place[j][i] == \old(m->place[j][i]);
  @*/
void sk_list_remove(sk_monitor *m, int64_t k);

SK_END
#endif
