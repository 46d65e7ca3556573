/* What the Workspace Monitor is told: thresholds, version, safety region. */
#ifndef SK_MONITOR_RULES_H
#define SK_MONITOR_RULES_H
#include "monitor_map.h"
SK_BEGIN

#define SK_MONITOR_WAIT_MOST_US 60000000
#define SK_MONITOR_PERIOD_MOST_US 10000000
#define SK_MONITOR_DWELL_MOST_US 60000000

typedef struct sk_monitor_rules {
  int32_t height_threshold_mm;    /* a rise by more is a change (Figure 6) */
  int32_t neighbour_threshold_mm; /* a SET neighbour less than this below the new height explains a rise */
  int32_t slope_threshold_mm;     /* a SET neighbour higher by more than this over the cell explains a rise: an edge */
  int32_t wait_us;                /* a cell that gets data without end is judged when it is so old */
  int32_t period_us;              /* between updates */
  int32_t dwell_us;               /* the region is clear for so long before the stop ends */
  bool continuous;                /* Figure 7: the accumulated map follows what is seen; else Figure 8: it stays as it was first seen */
  uint8_t watched[SK_MAP_CELLS][SK_MAP_CELLS]; /* not 0: a cell of the safety region */
} sk_monitor_rules;

/*@ predicate sk_threshold_fits(integer v) = 1 <= v <= SK_HEIGHT_MAX_MM;
  @ predicate sk_monitor_rules_fit{L}(sk_monitor_rules *r) = sk_threshold_fits(\at(r->height_threshold_mm, L)) &&
  @   sk_threshold_fits(\at(r->neighbour_threshold_mm, L)) && sk_threshold_fits(\at(r->slope_threshold_mm, L)) &&
  @   0 <= \at(r->wait_us, L) <= SK_MONITOR_WAIT_MOST_US && 1 <= \at(r->period_us, L) <= SK_MONITOR_PERIOD_MOST_US &&
  @   0 <= \at(r->dwell_us, L) <= SK_MONITOR_DWELL_MOST_US;
  @ // an obstacle, or a flag that is none, in a cell of the safety region
  @ predicate sk_in_danger{L}(sk_monitor *m, sk_monitor_rules *r, integer iy, integer ix) =
  @   sk_holds_obstacle{L}(m, iy, ix) && \at(r->watched[iy][ix], L) != 0;
  @ predicate sk_obstacle_in_region{L}(sk_monitor *m, sk_monitor_rules *r) =
  @   \exists integer iy, ix; sk_in_map(iy, ix) && sk_in_danger{L}(m, r, iy, ix);
  @*/

SK_END
#endif
