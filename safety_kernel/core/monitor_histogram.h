/* A histogram of heights per cell (leger-1998, section 4.2, proposes it) in place of the accumulated map's single height. A point that is higher than
 * what has been seen of its cell departs from it; a lone one may be dust, and two a scanner's spurious returns, one after the other: three in a cell
 * and beside it are somebody. A cell where
 * now the one and now the other of two heights is hit (a truck's rim) knows both, so needs no neighbour to explain a rise. */
#ifndef SK_MONITOR_HISTOGRAM_H
#define SK_MONITOR_HISTOGRAM_H
#include "workspace_monitor.h"
SK_BEGIN

/* A bin is as high as half a cell is wide: several times the noise of a height, less than a third of the least rise that is worth a stop. */
#define SK_HISTOGRAM_BIN_MM 150
#define SK_HISTOGRAM_BINS 64
#define SK_HISTOGRAM_FLOOR_MM (-5100) /* low side of the lowest bin; what is lower is in it */
#define SK_HISTOGRAM_TOP_MM 4500      /* high side of the highest: what is there or higher is nobody, and counts for nothing */
#define SK_HISTOGRAM_ENOUGH 8         /* points after which a cell's histogram is believed */
#define SK_HISTOGRAM_WELL 255         /* points up to which they may be of one moment and one pose: what others saw as high explains a height too */
#define SK_HISTOGRAM_OTHERS 2         /* departing points, in a cell and beside it, that make somebody of the next: three in all */
#define SK_HISTOGRAM_FULL 255
#define SK_LINE_NEAR_MM 150 /* lines so near each other agree */
#define SK_LINES_ENOUGH 3   /* lines that agree, less those that do not, after which they are believed */
#define SK_LINES_MOST 8
#define SK_NO_GROUND 0xFFFFFFFFFFFFFFFFU /* later than any time */
#define SK_NOBODY_KNOWS (-1)             /* no bin: of a cell of which too little was seen */

/* Any two differ in four bits. What is none of them is like SOMEBODY. */
enum { SK_CELL_LEARNING = 0x0F, SK_CELL_CLEAR = 0x33, SK_CELL_SOMEBODY = 0x55 };

/* Each subject has an integer type of its own, as in sk_monitor. */
typedef struct sk_monitor_histogram {
  uint8_t seen[SK_MAP_CELLS][SK_MAP_CELLS][SK_HISTOGRAM_BINS]; /* points; when one is full all of the cell are halved, which keeps their proportion */
  uint16_t state[SK_MAP_CELLS][SK_MAP_CELLS];
  uint32_t observed[SK_MAP_CELLS][SK_MAP_CELLS];               /* points, as far as SK_HISTOGRAM_WELL */
  int32_t line_mm[SK_MAP_CELLS][SK_MAP_CELLS];                 /* what most interpolated heights agree on; the ground of a cell with too few points */
  int8_t lines[SK_MAP_CELLS][SK_MAP_CELLS];                    /* that agree, less the others: one to a spurious return crosses many cells */
  int16_t departed_mm[SK_MAP_CELLS][SK_MAP_CELLS];             /* of the newest departing point */
  int64_t departed_us[SK_MAP_CELLS][SK_MAP_CELLS][2];          /* when it came, and the one before it; -1 none */
  /* of a cell with somebody: when its ground was first seen again; of a clear one: when something higher than what is known was last counted */
  uint64_t ground_us[SK_MAP_CELLS][SK_MAP_CELLS];
  int64_t somebody_us;                                         /* newest step with somebody in the region; -1 none */
} sk_monitor_histogram;

/*@ predicate sk_in_bins(integer b) = 0 <= b < SK_HISTOGRAM_BINS;
  @ logic integer sk_bin_low(integer b) = SK_HISTOGRAM_BIN_MM * b + SK_HISTOGRAM_FLOOR_MM;
  @ predicate sk_is_bin(integer b, integer z) = sk_in_bins(b) && (b > 0 ==> sk_bin_low(b) <= z) &&
  @   (b < SK_HISTOGRAM_BINS - 1 ==> z < sk_bin_low(b + 1));
  @ // so high that it explains a height z: less than `rise` lower. Its own bin and those above it do
  @ predicate sk_bin_explains(integer b, integer z, integer rise) = sk_bin_low(b) >= z - rise || sk_bin_low(b + 1) > z || b == SK_HISTOGRAM_BINS - 1;
  @ predicate sk_seen_in{L}(sk_monitor_histogram *h, integer iy, integer ix, integer low, integer high) =
  @   \exists integer b; low <= b < high && \at(h->seen[iy][ix][b], L) > 0;
  @ predicate sk_seen_twice_in{L}(sk_monitor_histogram *h, integer iy, integer ix, integer low, integer high) =
  @   (\exists integer b; low <= b < high && \at(h->seen[iy][ix][b], L) > 1) ||
  @   (\exists integer b, c; low <= b < c < high && \at(h->seen[iy][ix][b], L) > 0 && \at(h->seen[iy][ix][c], L) > 0);
  @ predicate sk_believed{L}(sk_monitor_histogram *h, integer iy, integer ix) =
  @   \at(h->state[iy][ix], L) != SK_CELL_LEARNING && \at(h->observed[iy][ix], L) >= SK_HISTOGRAM_ENOUGH;
  @ // `known`: the highest bin from which on those who saw enough of the cell saw two points, or SK_NOBODY_KNOWS
  @ predicate sk_known_lower(integer known, integer low) = 0 <= known < low;
  @ predicate sk_known_as_high(integer known, integer low) = known >= 0 && known >= low;
  @ // by bins from `low` on: a stray point counts where so few were seen that the ground is known by lines or from others alone; and where many
  @ // were not yet seen, what others know explains. `over_lines`: that outweighs lines
  @ predicate sk_departs_from{L}(sk_monitor_histogram *h, integer known, integer over_lines, integer iy, integer ix, integer z, integer rise, integer low) =
  @   \at(h->state[iy][ix], L) != SK_CELL_LEARNING &&
  @   (\at(h->observed[iy][ix], L) >= SK_HISTOGRAM_ENOUGH ==> !sk_seen_twice_in{L}(h, iy, ix, low, SK_HISTOGRAM_BINS) &&
  @     (\at(h->observed[iy][ix], L) < SK_HISTOGRAM_WELL ==> !sk_known_as_high(known, low))) &&
  @   (\at(h->observed[iy][ix], L) < SK_HISTOGRAM_ENOUGH ==> !sk_seen_in{L}(h, iy, ix, low, SK_HISTOGRAM_BINS) &&
  @     ((\at(h->lines[iy][ix], L) >= SK_LINES_ENOUGH && z - \at(h->line_mm[iy][ix], L) > rise &&
  @       !(over_lines != 0 && sk_known_as_high(known, low))) ||
  @      sk_known_lower(known, low)));
  @ // `low` is the lowest bin that explains z
  @ predicate sk_lowest_bin(integer low, integer z, integer rise) = sk_in_bins(low) &&
  @   \forall integer b; sk_in_bins(b) ==> (b >= low <==> sk_bin_explains(b, z, rise));
  @ predicate sk_departs{L}(sk_monitor_histogram *h, integer known, integer over_lines, sk_monitor_rules *r, integer iy, integer ix, integer z) =
  @   \exists integer low; sk_lowest_bin(low, z, \at(r->height_threshold_mm, L)) &&
  @     sk_departs_from{L}(h, known, over_lines, iy, ix, z, \at(r->height_threshold_mm, L), low);
  @
  @ // as long as a lone point waits in the temporary map to be joined by another
  @ logic integer sk_window{L}(sk_monitor_rules *r) = 2 * \at(r->period_us, L);
  @ logic integer sk_recent_time(integer departed, integer window, integer now) = departed < 0 ? 0 : (now - departed <= window ? 1 : 0);
  @ // points, up to two, that departed from a cell within a window
  @ logic integer sk_recent_at{L}(sk_monitor_histogram *h, integer window, integer now, integer j, integer i) =
  @   j < 0 ? 0 : (j >= SK_MAP_CELLS ? 0 : (i < 0 ? 0 : (i >= SK_MAP_CELLS ? 0 :
  @   sk_recent_time(\at(h->departed_us[j][i][0], L), window, now) + sk_recent_time(\at(h->departed_us[j][i][1], L), window, now))));
  @ logic integer sk_recent_in_row{L}(sk_monitor_histogram *h, integer window, integer now, integer j, integer ix) =
  @   sk_recent_at{L}(h, window, now, j, ix - 1) + sk_recent_at{L}(h, window, now, j, ix) + sk_recent_at{L}(h, window, now, j, ix + 1);
  @ logic integer sk_recent_beside{L}(sk_monitor_histogram *h, integer window, integer now, integer iy, integer ix) =
  @   sk_recent_in_row{L}(h, window, now, iy - 1, ix) + sk_recent_in_row{L}(h, window, now, iy + 1, ix) +
  @   sk_recent_at{L}(h, window, now, iy, ix - 1) + sk_recent_at{L}(h, window, now, iy, ix + 1);
  @ // with one that departs now there are enough
  @ predicate sk_joined_by_others{L}(sk_monitor_histogram *h, sk_monitor_rules *r, integer now, integer iy, integer ix) =
  @   sk_recent_at{L}(h, sk_window{L}(r), now, iy, ix) + sk_recent_beside{L}(h, sk_window{L}(r), now, iy, ix) >= SK_HISTOGRAM_OTHERS;
  @ predicate sk_somebody_flag(integer state) = state != SK_CELL_LEARNING && state != SK_CELL_CLEAR;
  @ predicate sk_somebody_at{L}(sk_monitor_histogram *h, integer iy, integer ix) = sk_somebody_flag(\at(h->state[iy][ix], L));
  @ predicate sk_somebody_watched{L}(sk_monitor_histogram *h, sk_monitor_rules *r, integer iy, integer ix) =
  @   sk_somebody_at{L}(h, iy, ix) && \at(r->watched[iy][ix], L) != 0;
  @ predicate sk_somebody_in_region{L}(sk_monitor_histogram *h, sk_monitor_rules *r) =
  @   \exists integer iy, ix; sk_in_map(iy, ix) && sk_somebody_watched{L}(h, r, iy, ix);
  @ // nothing departs here or beside, and the ground was seen so long before too, with nothing that departed since
  @ predicate sk_ground_is_back{L}(sk_monitor_histogram *h, sk_monitor_rules *r, integer now, integer iy, integer ix) =
  @   sk_recent_at{L}(h, sk_window{L}(r), now, iy, ix) == 0 && sk_recent_beside{L}(h, sk_window{L}(r), now, iy, ix) == 0 &&
  @   \at(h->ground_us[iy][ix], L) <= now && now - \at(h->ground_us[iy][ix], L) >= \at(r->wait_us, L);
  @
  @ // where too little was seen, a bin wholly above the lines, or above what others know: nothing there is counted, or who stands there would be
  @ // his own ground
  @ predicate sk_above_ground{L}(sk_monitor_histogram *h, integer known, integer iy, integer ix, integer b) =
  @   \at(h->state[iy][ix], L) != SK_CELL_LEARNING && \at(h->observed[iy][ix], L) < SK_HISTOGRAM_ENOUGH &&
  @   ((\at(h->lines[iy][ix], L) >= SK_LINES_ENOUGH && sk_bin_low(b) > \at(h->line_mm[iy][ix], L)) || sk_known_lower(known, b));
  @ // higher than what has been seen twice, if not by so much that it departs. Within a window one such point is counted: somebody who is scanned
  @ // from the feet upwards would else be his own ground
  @ predicate sk_raises{L}(sk_monitor_histogram *h, integer iy, integer ix, integer b) = \at(h->state[iy][ix], L) != SK_CELL_LEARNING &&
  @   \at(h->observed[iy][ix], L) >= SK_HISTOGRAM_ENOUGH && !sk_seen_twice_in{L}(h, iy, ix, b, SK_HISTOGRAM_BINS);
  @ predicate sk_may_raise{L}(sk_monitor_histogram *h, sk_monitor_rules *r, integer now, integer iy, integer ix) =
  @   \at(h->state[iy][ix], L) == SK_CELL_CLEAR && (\at(h->ground_us[iy][ix], L) > now || now - \at(h->ground_us[iy][ix], L) > sk_window{L}(r));
  @ predicate sk_counts{L}(sk_monitor_histogram *h, integer known, sk_monitor_rules *r, integer now, integer iy, integer ix, integer b) =
  @   !sk_above_ground{L}(h, known, iy, ix, b) && (sk_raises{L}(h, iy, ix, b) ==> sk_may_raise{L}(h, r, now, iy, ix));
  @
  @ predicate sk_bins_kept{A, B}(sk_monitor_histogram *h, integer iy, integer ix) =
  @   \forall integer b; sk_in_bins(b) ==> \at(h->seen[iy][ix][b], A) == \at(h->seen[iy][ix][b], B);
  @ predicate sk_times_kept{A, B}(sk_monitor_histogram *h, integer iy, integer ix) =
  @   \at(h->departed_us[iy][ix][0], A) == \at(h->departed_us[iy][ix][0], B) &&
  @   \at(h->departed_us[iy][ix][1], A) == \at(h->departed_us[iy][ix][1], B) && \at(h->ground_us[iy][ix], A) == \at(h->ground_us[iy][ix], B) &&
  @   \at(h->departed_mm[iy][ix], A) == \at(h->departed_mm[iy][ix], B);
  @ predicate sk_ground_kept{A, B}(sk_monitor_histogram *h, integer iy, integer ix) = sk_bins_kept{A, B}(h, iy, ix) &&
  @   \at(h->observed[iy][ix], A) == \at(h->observed[iy][ix], B) && \at(h->line_mm[iy][ix], A) == \at(h->line_mm[iy][ix], B) &&
  @   \at(h->lines[iy][ix], A) == \at(h->lines[iy][ix], B);
  @ predicate sk_cell_kept{A, B}(sk_monitor_histogram *h, integer iy, integer ix) = sk_ground_kept{A, B}(h, iy, ix) &&
  @   sk_times_kept{A, B}(h, iy, ix) && \at(h->state[iy][ix], A) == \at(h->state[iy][ix], B);
  @ // one point more in bin b
  @ predicate sk_counted{A, B}(sk_monitor_histogram *h, integer iy, integer ix, integer b) =
  @   (\at(h->seen[iy][ix][b], A) < SK_HISTOGRAM_FULL ==> \at(h->seen[iy][ix][b], B) == \at(h->seen[iy][ix][b], A) + 1 &&
  @     \forall integer c; sk_in_bins(c) && c != b ==> \at(h->seen[iy][ix][c], B) == \at(h->seen[iy][ix][c], A)) &&
  @   (\at(h->seen[iy][ix][b], A) == SK_HISTOGRAM_FULL ==> \at(h->seen[iy][ix][b], B) == SK_HISTOGRAM_FULL / 2 + 1 &&
  @     \forall integer c; sk_in_bins(c) && c != b ==> \at(h->seen[iy][ix][c], B) == \at(h->seen[iy][ix][c], A) / 2);
  @ predicate sk_observed{A, B}(sk_monitor_histogram *h, integer iy, integer ix) =
  @   (\at(h->observed[iy][ix], A) < SK_HISTOGRAM_WELL ==> \at(h->observed[iy][ix], B) == \at(h->observed[iy][ix], A) + 1) &&
  @   (\at(h->observed[iy][ix], A) >= SK_HISTOGRAM_WELL ==> \at(h->observed[iy][ix], B) == \at(h->observed[iy][ix], A));
  @ // the height that more lines than not agree on outlives those that do not, and follows those that do
  @ predicate sk_lines_agree(integer line, integer z) = -SK_LINE_NEAR_MM <= z - line <= SK_LINE_NEAR_MM;
  @ predicate sk_line_taken(integer line, integer lines, integer z, integer line2, integer lines2) =
  @   (lines <= 0 ==> line2 == z && lines2 == 1) &&
  @   (lines > 0 && sk_lines_agree(line, z) ==> line2 == z && lines2 == (lines < SK_LINES_MOST ? lines + 1 : lines)) &&
  @   (lines > 0 && !sk_lines_agree(line, z) ==> line2 == line && lines2 == lines - 1);
  @ predicate sk_bins_blank{L}(sk_monitor_histogram *h, integer iy, integer ix) =
  @   \forall integer b; sk_in_bins(b) ==> \at(h->seen[iy][ix][b], L) == 0;
  @ predicate sk_histogram_blank{L}(sk_monitor_histogram *h, integer iy, integer ix) = sk_bins_blank{L}(h, iy, ix) &&
  @   \at(h->state[iy][ix], L) == SK_CELL_LEARNING && \at(h->observed[iy][ix], L) == 0 && \at(h->lines[iy][ix], L) == 0 &&
  @   \at(h->departed_us[iy][ix][0], L) == -1 && \at(h->departed_us[iy][ix][1], L) == -1 && \at(h->ground_us[iy][ix], L) == SK_NO_GROUND;
  @*/

/* Nothing is known of any cell, and every one is learning. */
/*@ requires \valid(h);
  @ assigns h->seen[..][..][..], h->state[..][..], h->observed[..][..], h->line_mm[..][..], h->lines[..][..], h->departed_mm[..][..],
  @   h->departed_us[..][..][..], h->ground_us[..][..], h->somebody_us;
  @ ensures blank: \forall integer iy, ix; sk_in_map(iy, ix) ==> sk_histogram_blank(h, iy, ix);
  @ ensures times: h->somebody_us == -1;
  @*/
void sk_histogram_begin(sk_monitor_histogram *h);

/* The highest bin from which on two points were counted of a cell, be they so few that they are not believed; SK_NOBODY_KNOWS outside the map, and where
 * there are none. */
/*@ requires \valid_read(h);
  @ assigns \nothing;
  @ ensures range: SK_NOBODY_KNOWS <= \result < SK_HISTOGRAM_BINS;
  @ ensures met: \result >= 0 ==> sk_in_map(iy, ix) && sk_seen_twice_in(h, iy, ix, \result, SK_HISTOGRAM_BINS) &&
  @   !sk_seen_twice_in(h, iy, ix, \result + 1, SK_HISTOGRAM_BINS);
  @ ensures none: \result < 0 ==> !sk_in_map(iy, ix) || !sk_seen_twice_in(h, iy, ix, 0, SK_HISTOGRAM_BINS);
  @*/
int32_t sk_histogram_met(const sk_monitor_histogram *h, int32_t iy, int32_t ix);

/* What is known of a cell: sk_histogram_met, or SK_NOBODY_KNOWS outside the map, while it is learning, and where
 * too little was seen. */
/*@ requires \valid_read(h);
  @ assigns \nothing;
  @ ensures range: SK_NOBODY_KNOWS <= \result < SK_HISTOGRAM_BINS;
  @ ensures known: \result >= 0 ==> sk_in_map(iy, ix) && sk_believed(h, iy, ix) && sk_seen_twice_in(h, iy, ix, \result, SK_HISTOGRAM_BINS) &&
  @   !sk_seen_twice_in(h, iy, ix, \result + 1, SK_HISTOGRAM_BINS);
  @ ensures unknown: \result < 0 ==> !sk_in_map(iy, ix) || !sk_believed(h, iy, ix) || !sk_seen_twice_in(h, iy, ix, 0, SK_HISTOGRAM_BINS);
  @*/
int32_t sk_histogram_known(const sk_monitor_histogram *h, int32_t iy, int32_t ix);

/* A measured point over cell (iy, ix). Returns whether it departs from what was seen there: such a point is never counted, so that nobody becomes the
 * ground by standing. `known`: of the other sensors' sk_histogram_known the highest. Where too little was seen of the cell that counts in its place; where
 * so little that it may all be of one moment, what is as high departs from nothing. `over_lines`: that is worth more than lines,
 * too. Outside the map, too high, or with now_us < 0, nothing changes. */
/*@ requires \valid(h) && \valid_read(r) && \separated(h, r);
  @ assigns h->seen[..][..][..], h->state[..][..], h->observed[..][..], h->departed_mm[..][..], h->departed_us[..][..][..], h->ground_us[..][..];
  @ ensures departs: \result == true <==> sk_in_map(iy, ix) && now_us >= 0 && z_mm < SK_HISTOGRAM_TOP_MM &&
  @   sk_departs{Pre}(h, known, over_lines, r, iy, ix, z_mm);
  @ ensures appears: \result == true && sk_joined_by_others{Pre}(h, r, now_us, iy, ix) ==> sk_somebody_at(h, iy, ix);
  @ ensures nobody: sk_in_map(iy, ix) && sk_somebody_at(h, iy, ix) ==>
  @   sk_somebody_at{Pre}(h, iy, ix) || (\result == true && sk_joined_by_others{Pre}(h, r, now_us, iy, ix));
  @ ensures stays: sk_in_map(iy, ix) && sk_somebody_at{Pre}(h, iy, ix) ==>
  @   sk_somebody_at(h, iy, ix) || (\result == false && now_us >= 0 && sk_ground_is_back{Pre}(h, r, now_us, iy, ix));
  @ ensures time: \result == true ==> h->departed_us[iy][ix][0] == now_us && h->departed_us[iy][ix][1] == \old(h->departed_us[iy][ix][0]) &&
  @   h->ground_us[iy][ix] == SK_NO_GROUND &&
  @   sk_ground_kept{Pre, Post}(h, iy, ix);
  @ ensures counted: \result == false && sk_in_map(iy, ix) && now_us >= 0 && z_mm < SK_HISTOGRAM_TOP_MM ==>
  @   \exists integer b; sk_is_bin(b, z_mm) && (sk_counts{Pre}(h, known, r, now_us, iy, ix, b) ==> sk_counted{Pre, Post}(h, iy, ix, b)) &&
  @     (!sk_counts{Pre}(h, known, r, now_us, iy, ix, b) ==> sk_bins_kept{Pre, Post}(h, iy, ix));
  @ ensures observed: \result == false && sk_in_map(iy, ix) && now_us >= 0 && z_mm < SK_HISTOGRAM_TOP_MM ==>
  @   h->departed_us[iy][ix][0] == \old(h->departed_us[iy][ix][0]) && h->departed_us[iy][ix][1] == \old(h->departed_us[iy][ix][1]) &&
  @   \exists integer b; sk_is_bin(b, z_mm) && (sk_counts{Pre}(h, known, r, now_us, iy, ix, b) ==> sk_observed{Pre, Post}(h, iy, ix)) &&
  @     (!sk_counts{Pre}(h, known, r, now_us, iy, ix, b) ==> h->observed[iy][ix] == \old(h->observed[iy][ix]));
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && (now_us < 0 || z_mm >= SK_HISTOGRAM_TOP_MM || !(j == iy && i == ix)) ==>
  @   sk_cell_kept{Pre, Post}(h, j, i);
  @*/
bool sk_histogram_insert(sk_monitor_histogram *h, int32_t known, bool over_lines, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us);

/* A point at z_mm that was measured beside cell (iy, ix): while that is learning its height is taken for one of the cell's, too, but the cell itself has
 * not been seen by it. Of a cell that is not learning, outside the map, or too high, nothing changes. */
/*@ requires \valid(h);
  @ assigns h->seen[..][..][..];
  @ ensures counted: sk_in_map(iy, ix) && h->state[iy][ix] == SK_CELL_LEARNING && z_mm < SK_HISTOGRAM_TOP_MM ==>
  @   \exists integer b; sk_is_bin(b, z_mm) && sk_counted{Pre, Post}(h, iy, ix, b);
  @ ensures kept: sk_in_map(iy, ix) && !(h->state[iy][ix] == SK_CELL_LEARNING && z_mm < SK_HISTOGRAM_TOP_MM) ==> sk_bins_kept{Pre, Post}(h, iy, ix);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_bins_kept{Pre, Post}(h, j, i);
  @*/
void sk_histogram_beside(sk_monitor_histogram *h, int32_t iy, int32_t ix, int32_t z_mm);

/* Whether a point at z_mm over cell (iy, ix) would depart from what was seen there; outside the map none does. `known`: as of sk_histogram_insert, and
 * nothing is worth more than lines. */
/*@ requires \valid_read(h) && \valid_read(r);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_in_map(iy, ix) && sk_departs(h, known, 0, r, iy, ix, z_mm);
  @*/
bool sk_histogram_departs(const sk_monitor_histogram *h, int32_t known, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm);

/* A ray has passed over cell (iy, ix), no higher than z_mm, and met something beyond. Where a point so high would not depart, somebody in its way would have
 * been met: that is a sight of the ground, for somebody who was there; nothing is counted. `known`: as of sk_histogram_insert. */
/*@ requires \valid(h) && \valid_read(r) && \separated(h, r);
  @ assigns h->state[..][..], h->ground_us[..][..];
  @ ensures stays: \forall integer j, i; sk_in_map(j, i) && sk_somebody_at{Pre}(h, j, i) ==> sk_somebody_at(h, j, i) ||
  @   (j == iy && i == ix && now_us >= 0 && !sk_departs{Pre}(h, known, 0, r, iy, ix, z_mm) && sk_ground_is_back{Pre}(h, r, now_us, iy, ix));
  @ ensures leaves: sk_in_map(iy, ix) && now_us >= 0 && z_mm < SK_HISTOGRAM_TOP_MM && !sk_departs{Pre}(h, known, 0, r, iy, ix, z_mm) &&
  @   sk_ground_is_back{Pre}(h, r, now_us, iy, ix) ==> !sk_somebody_at(h, iy, ix);
  @ ensures nobody: \forall integer j, i; sk_in_map(j, i) && !sk_somebody_at{Pre}(h, j, i) ==> h->state[j][i] == \old(h->state[j][i]);
  @ ensures time: \forall integer j, i; sk_in_map(j, i) ==> h->ground_us[j][i] == \old(h->ground_us[j][i]) ||
  @   (j == iy && i == ix && sk_somebody_at{Pre}(h, j, i) && h->ground_us[j][i] == now_us);
  @*/
void sk_histogram_pass(sk_monitor_histogram *h, int32_t known, const sk_monitor_rules *r, int32_t iy, int32_t ix, int32_t z_mm, int64_t now_us);

/* An interpolated height over cell (iy, ix). It is no observation; while those are too few, what most lines agree on is taken for the ground. */
/*@ requires \valid(h);
  @ assigns h->line_mm[..][..], h->lines[..][..];
  @ ensures line: sk_in_map(iy, ix) ==>
  @   sk_line_taken(\old(h->line_mm[iy][ix]), \old(h->lines[iy][ix]), z_mm, h->line_mm[iy][ix], h->lines[iy][ix]);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> h->line_mm[j][i] == \old(h->line_mm[j][i]);
  @ ensures other_lines: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> h->lines[j][i] == \old(h->lines[j][i]);
  @*/
void sk_histogram_line(sk_monitor_histogram *h, int32_t iy, int32_t ix, int32_t z_mm);

/* Nothing is known any more of the cells that touch the rectangle, and they are learning. Whoever calls this must know that nobody is in it. */
/*@ requires \valid(h);
  @ assigns h->seen[..][..][..], h->state[..][..], h->observed[..][..], h->line_mm[..][..], h->lines[..][..], h->departed_mm[..][..],
  @   h->departed_us[..][..][..], h->ground_us[..][..];
  @ ensures forgotten: \forall integer iy, ix; sk_in_map(iy, ix) && sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
  @   sk_histogram_blank(h, iy, ix);
  @ ensures others: \forall integer iy, ix; sk_in_map(iy, ix) && !sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) ==>
  @   sk_cell_kept{Pre, Post}(h, iy, ix);
  @*/
void sk_histogram_forget(sk_monitor_histogram *h, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm);

/* The cells that touch the rectangle are learning no longer. */
/*@ requires \valid(h);
  @ assigns h->state[..][..];
  @ ensures settled: \forall integer iy, ix; sk_in_map(iy, ix) && sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) &&
  @   \old(h->state[iy][ix]) == SK_CELL_LEARNING ==> h->state[iy][ix] == SK_CELL_CLEAR;
  @ ensures others: \forall integer iy, ix; sk_in_map(iy, ix) && !(sk_touches(iy, ix, x_low_mm, y_low_mm, x_high_mm, y_high_mm) &&
  @   \old(h->state[iy][ix]) == SK_CELL_LEARNING) ==> h->state[iy][ix] == \old(h->state[iy][ix]);
  @*/
void sk_histogram_settle(sk_monitor_histogram *h, int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm);

/* The two for cell (iy, ix) alone; outside the map nothing changes. */
/*@ requires \valid(h);
  @ assigns h->seen[..][..][..], h->state[..][..], h->observed[..][..], h->line_mm[..][..], h->lines[..][..], h->departed_mm[..][..],
  @   h->departed_us[..][..][..], h->ground_us[..][..];
  @ ensures forgotten: sk_in_map(iy, ix) ==> sk_histogram_blank(h, iy, ix);
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix) ==> sk_cell_kept{Pre, Post}(h, j, i);
  @*/
void sk_histogram_forget_cell(sk_monitor_histogram *h, int32_t iy, int32_t ix);

/*@ requires \valid(h);
  @ assigns h->state[..][..];
  @ ensures settled: sk_in_map(iy, ix) && \old(h->state[iy][ix]) == SK_CELL_LEARNING ==> h->state[iy][ix] == SK_CELL_CLEAR;
  @ ensures others: \forall integer j, i; sk_in_map(j, i) && !(j == iy && i == ix && \old(h->state[j][i]) == SK_CELL_LEARNING) ==>
  @   h->state[j][i] == \old(h->state[j][i]);
  @*/
void sk_histogram_settle_cell(sk_monitor_histogram *h, int32_t iy, int32_t ix);

/* For every cycle: whether the machine must stop. *where: a cell of the region with somebody in it, or -1, -1. With rules that do not fit, or
 * now_us < 0, it must stop and nothing but *where changes. */
/*@ requires \valid(h) && \valid_read(r) && \valid(where) && \separated(h, r, where);
  @ assigns h->somebody_us, *where;
  @ ensures region: sk_somebody_in_region(h, r) ==> \result == true;
  @ ensures misfit: !sk_monitor_rules_fit{Pre}(r) || now_us < 0 ==> \result == true && h->somebody_us == \old(h->somebody_us);
  @ ensures dwells: sk_dwelling(\old(h->somebody_us), \old(r->dwell_us), now_us) ==> \result == true;
  @ ensures stamped: sk_monitor_rules_fit{Pre}(r) && now_us >= 0 ==>
  @   h->somebody_us == (where->iy >= 0 ? now_us : \old(h->somebody_us)) && (where->iy >= 0 <==> sk_somebody_in_region(h, r));
  @ ensures goes: \result == false ==> !sk_somebody_in_region(h, r) && !sk_dwelling(h->somebody_us, \old(r->dwell_us), now_us);
  @ ensures needless: \result == true && sk_monitor_rules_fit{Pre}(r) && now_us >= 0 ==>
  @   sk_somebody_in_region(h, r) || sk_dwelling(\old(h->somebody_us), \old(r->dwell_us), now_us);
  @ ensures where: where->iy >= 0 ==> sk_in_map(where->iy, where->ix) && sk_somebody_watched(h, r, where->iy, where->ix);
  @*/
bool sk_histogram_step(sk_monitor_histogram *h, const sk_monitor_rules *r, int64_t now_us, sk_monitor_cell *where);

SK_END
#endif
