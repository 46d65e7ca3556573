/* How fast the machine may be asked to move while its sensors know less than usual: in dust, and while the Workspace Monitor learns the ground, so that by heights
 * nobody is watched: everywhere, or where the implements come near the lane of a truck that has just parked. Shares of each joint's largest speed, in
 * per mille. */
#ifndef SK_SPEED_SHARE_H
#define SK_SPEED_SHARE_H
#include "slice.h"
#include "config/parameter_block.h"
SK_BEGIN

#define SK_WHOLE_PERMILLE 1000
#define SK_LANE_BESIDE_MM 1000 /* so near counts as in the lane: of who steps out of it the monitor tells some tenths of a second later */

/*@ logic integer sk_share_if(integer slowed, integer permille) = slowed == 0 ? SK_WHOLE_PERMILLE : permille;
  @ predicate sk_vertex_count_fits{L}(sk_slice *s) = 1 <= \at(s->vertices, L) <= SK_SLICE_VERTICES;
  @ // all vertices lie beyond one side of low..high, both ends counted as between
  @ predicate sk_all_below{L}(sk_slice *s, integer axis, integer low) = \forall integer i; 0 <= i < \at(s->vertices, L) ==> \at(s->xyz_mm[axis][i], L) < low;
  @ predicate sk_all_above{L}(sk_slice *s, integer axis, integer high) = \forall integer i; 0 <= i < \at(s->vertices, L) ==> high < \at(s->xyz_mm[axis][i], L);
  @ predicate sk_beyond{L}(sk_slice *s, integer axis, integer low, integer high) = sk_all_below{L}(s, axis, low) || sk_all_above{L}(s, axis, high);
  @ // one of the lane's four sides, moved out by SK_LANE_BESIDE_MM, has the whole slice beyond it: so no point of its hull is nearer to the lane than that
  @ predicate sk_away_from_lane{L}(sk_slice *s, berm_lane *z) =
  @   sk_beyond{L}(s, 0, \at(z->x_low_mm, L) - SK_LANE_BESIDE_MM, \at(z->x_high_mm, L) + SK_LANE_BESIDE_MM) ||
  @   sk_beyond{L}(s, 1, \at(z->y_low_mm, L) - SK_LANE_BESIDE_MM, \at(z->y_high_mm, L) + SK_LANE_BESIDE_MM);
  @*/

/* The least of the shares that apply. */
/*@ requires \valid_read(p);
  @ assigns \nothing;
  @ ensures dust: \result <= sk_share_if(dust ? 1 : 0, p->dust_speed_permille);
  @ ensures learns: \result <= sk_share_if(learns ? 1 : 0, p->workspace_learn_speed_permille);
  @ ensures one: \result == SK_WHOLE_PERMILLE || (dust == true && \result == p->dust_speed_permille) ||
  @   (learns == true && \result == p->workspace_learn_speed_permille);
  @*/
int32_t sk_speed_share(const berm_parameters *p, bool dust, bool learns);

/* Whether the slice is away from every lane of the block; so false also where the number of vertices or lanes is out of range. */
/*@ requires \valid_read(p) && \valid_read(s);
  @ assigns \nothing;
  @ ensures fits: \result == true ==> sk_vertex_count_fits(s) && 0 <= p->lanes <= BERM_LANES;
  @ ensures whole: sk_vertex_count_fits(s) && 0 <= p->lanes <= BERM_LANES ==>
  @   (\result == true <==> \forall integer k; 0 <= k < p->lanes ==> sk_away_from_lane(s, &p->lane[k]));
  @*/
bool sk_away_from_lanes(const berm_parameters *p, const sk_slice *s);

SK_END
#endif
