/* What the Workspace Monitor holds (leger-1998, section 3): the temporary map of what was seen since a cell was last merged, the accumulated map
 * that it is compared with, and the list of the temporary map's modified cells. */
#ifndef SK_MONITOR_MAP_H
#define SK_MONITOR_MAP_H
#include "height_map.h"
SK_BEGIN

/* Status flags, Table 1. Any two differ in four bits: fewer flipped bits make a flag that is none of them, and counts as an obstacle. */
enum {
  SK_FLAG_EMPTY = 0x0F,                    /* no range data lies within the cell */
  SK_FLAG_SET = 0x33,                      /* one or more data points lie within the cell */
  SK_FLAG_INTERPOLATED = 0x3C,             /* only interpolated data points are in the cell */
  SK_FLAG_NOT_VISITED = 0x55,              /* no further data since the last update */
  SK_FLAG_INTERPOLATED_NOT_VISITED = 0x5A, /* the same, of a cell with interpolated data */
  SK_FLAG_CHANGED = 0x66,                  /* the height has changed significantly */
  SK_FLAG_OBSTACLE = 0x69                  /* the cell contains a moving object */
};

#define SK_NO_HEIGHT (-32767 - 1) /* in place of the second highest point of a cell that has only one */
#define SK_MODIFIED_MOST 4096          /* cells of the list; when more are modified the next update walks the whole map */

/* Each subject has an integer type of its own, so that the proof sees at once that writing the one leaves the others. */
typedef struct sk_monitor {
  /* temporary map, [iy][ix] */
  uint8_t temporary_flag[SK_MAP_CELLS][SK_MAP_CELLS];
  int64_t began_us[SK_MAP_CELLS][SK_MAP_CELLS];       /* when the first of its points came; of an EMPTY cell of no meaning */
  int16_t highest_mm[SK_MAP_CELLS][SK_MAP_CELLS];     /* the two highest points; the highest is discarded */
  int16_t second_mm[SK_MAP_CELLS][SK_MAP_CELLS];
  /* accumulated map: EMPTY, SET, INTERPOLATED, CHANGED, OBSTACLE */
  uint16_t accumulated_flag[SK_MAP_CELLS][SK_MAP_CELLS];
  int32_t height_mm[SK_MAP_CELLS][SK_MAP_CELLS];          /* what new heights are compared with; of an OBSTACLE the height before it came */
  int32_t obstacle_height_mm[SK_MAP_CELLS][SK_MAP_CELLS]; /* of a CHANGED or OBSTACLE cell: what stands there now */
  /* modified cells of the temporary map */
  uint64_t modified_iy[SK_MODIFIED_MOST];
  uint64_t modified_ix[SK_MODIFIED_MOST];
  uint32_t place[SK_MAP_CELLS][SK_MAP_CELLS];             /* of a listed cell: where in the list */
  int64_t modified;
  bool overflowed;                                        /* cells may be modified that are not listed */
  int64_t updated_us;                                     /* newest update; -1 none */
  int64_t obstacle_us;                                    /* newest time at which an obstacle was in the safety region; -1 never */
} sk_monitor;

/*@ // none of the flags that an accumulated cell without an obstacle has
  @ predicate sk_is_obstacle(integer flag) =
  @   flag != SK_FLAG_EMPTY && flag != SK_FLAG_SET && flag != SK_FLAG_INTERPOLATED && flag != SK_FLAG_CHANGED;
  @ predicate sk_holds_obstacle{L}(sk_monitor *m, integer iy, integer ix) = sk_is_obstacle(\at(m->accumulated_flag[iy][ix], L));
  @ // the height of a temporary cell: the highest point but one; that of its only point
  @ logic integer sk_new_height{L}(sk_monitor *m, integer iy, integer ix) =
  @   \at(m->second_mm[iy][ix], L) == SK_NO_HEIGHT ? \at(m->highest_mm[iy][ix], L) : \at(m->second_mm[iy][ix], L);
  @ predicate sk_lone{L}(sk_monitor *m, integer iy, integer ix) = \at(m->second_mm[iy][ix], L) == SK_NO_HEIGHT;
  @ predicate sk_points_kept{A, B}(sk_monitor *m, integer iy, integer ix) =
  @   \at(m->highest_mm[iy][ix], A) == \at(m->highest_mm[iy][ix], B) && \at(m->second_mm[iy][ix], A) == \at(m->second_mm[iy][ix], B);
  @ predicate sk_temporary_kept{A, B}(sk_monitor *m, integer iy, integer ix) = sk_points_kept{A, B}(m, iy, ix) &&
  @   \at(m->temporary_flag[iy][ix], A) == \at(m->temporary_flag[iy][ix], B) && \at(m->began_us[iy][ix], A) == \at(m->began_us[iy][ix], B);
  @ predicate sk_accumulated_kept{A, B}(sk_monitor *m, integer iy, integer ix) =
  @   \at(m->accumulated_flag[iy][ix], A) == \at(m->accumulated_flag[iy][ix], B) &&
  @   \at(m->height_mm[iy][ix], A) == \at(m->height_mm[iy][ix], B) &&
  @   \at(m->obstacle_height_mm[iy][ix], A) == \at(m->obstacle_height_mm[iy][ix], B);
  @
  @ // among the first n entries of the list
  @ predicate sk_listed_of{L}(sk_monitor *m, integer n, integer iy, integer ix) = \at(m->place[iy][ix], L) < n &&
  @   \at(m->modified_iy[\at(m->place[iy][ix], L)], L) == iy && \at(m->modified_ix[\at(m->place[iy][ix], L)], L) == ix;
  @ predicate sk_listed{L}(sk_monitor *m, integer iy, integer ix) = sk_listed_of{L}(m, \at(m->modified, L), iy, ix);
  @ // each entry is a cell of the map and its place points back, so no cell is listed twice
  @ predicate sk_entry_ok{L}(sk_monitor *m, integer k) = sk_in_map(\at(m->modified_iy[k], L), \at(m->modified_ix[k], L)) &&
  @   \at(m->place[\at(m->modified_iy[k], L)][\at(m->modified_ix[k], L)], L) == k;
  @ predicate sk_list_ok_of{L}(sk_monitor *m, integer n) = 0 <= n <= SK_MODIFIED_MOST &&
  @   (\forall integer k; 0 <= k < n ==> sk_in_map(\at(m->modified_iy[k], L), \at(m->modified_ix[k], L))) &&
  @   (\forall integer k; 0 <= k < n ==> \at(m->place[\at(m->modified_iy[k], L)][\at(m->modified_ix[k], L)], L) == k);
  @ predicate sk_list_ok{L}(sk_monitor *m) = sk_list_ok_of{L}(m, \at(m->modified, L));
  @ // nothing that was seen can be lost
  @ predicate sk_list_complete_of{L}(sk_monitor *m, integer n) = \at(m->overflowed, L) == true || \forall integer iy, ix;
  @   sk_in_map(iy, ix) && \at(m->temporary_flag[iy][ix], L) != SK_FLAG_EMPTY ==> sk_listed_of{L}(m, n, iy, ix);
  @ predicate sk_list_complete{L}(sk_monitor *m) = sk_list_complete_of{L}(m, \at(m->modified, L));
  @ predicate sk_monitor_valid{L}(sk_monitor *m) = sk_list_ok{L}(m) && sk_list_complete{L}(m);
  @*/

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_is_obstacle(flag);
  @*/
static inline bool sk_flag_is_obstacle(uint16_t flag)
{
  return flag != SK_FLAG_EMPTY && flag != SK_FLAG_SET && flag != SK_FLAG_INTERPOLATED && flag != SK_FLAG_CHANGED;
}

/*@ requires \valid_read(m) && sk_in_map(iy, ix);
  @ assigns \nothing;
  @ ensures \result == sk_new_height(m, iy, ix);
  @*/
static inline int32_t sk_new_height_mm(const sk_monitor *m, int32_t iy, int32_t ix)
{
  return m->second_mm[iy][ix] == SK_NO_HEIGHT ? m->highest_mm[iy][ix] : m->second_mm[iy][ix];
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_in_map(iy, ix);
  @*/
static inline bool sk_is_in_map(int32_t iy, int32_t ix)
{
  return iy >= 0 && iy < SK_MAP_CELLS && ix >= 0 && ix < SK_MAP_CELLS;
}

SK_END
#endif
