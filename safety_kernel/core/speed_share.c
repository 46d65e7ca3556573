#include "speed_share.h"

int32_t sk_speed_share(const berm_parameters *p, bool dust, bool learns)
{
  int32_t share = SK_WHOLE_PERMILLE;
  if (dust && p->dust_speed_permille < share) { share = p->dust_speed_permille; }
  if (learns && p->workspace_learn_speed_permille < share) { share = p->workspace_learn_speed_permille; }
  return share;
}

/*@ requires \valid_read(s) && 0 <= axis <= 1 && 0 <= s->vertices <= SK_SLICE_VERTICES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_all_below(s, axis, low_mm);
  @*/
static bool sk_is_below(const sk_slice *s, int32_t axis, int64_t low_mm)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= s->vertices;
    @ loop invariant \forall integer k; 0 <= k < i ==> s->xyz_mm[axis][k] < low_mm;
    @ loop assigns i;
    @ loop variant s->vertices - i;
    @*/
  for (i = 0; i < s->vertices; i++) {
    if (s->xyz_mm[axis][i] >= low_mm) { return false; }
  }
  return true;
}

/*@ requires \valid_read(s) && 0 <= axis <= 1 && 0 <= s->vertices <= SK_SLICE_VERTICES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_all_above(s, axis, high_mm);
  @*/
static bool sk_is_above(const sk_slice *s, int32_t axis, int64_t high_mm)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= s->vertices;
    @ loop invariant \forall integer k; 0 <= k < i ==> high_mm < s->xyz_mm[axis][k];
    @ loop assigns i;
    @ loop variant s->vertices - i;
    @*/
  for (i = 0; i < s->vertices; i++) {
    if (s->xyz_mm[axis][i] <= high_mm) { return false; }
  }
  return true;
}

/*@ requires \valid_read(s) && \valid_read(z) && 0 <= s->vertices <= SK_SLICE_VERTICES;
  @ assigns \nothing;
  @ ensures \result == true <==> sk_away_from_lane(s, z);
  @*/
static bool sk_is_away(const sk_slice *s, const berm_lane *z)
{
  return sk_is_below(s, 0, (int64_t)z->x_low_mm - SK_LANE_BESIDE_MM) || sk_is_above(s, 0, (int64_t)z->x_high_mm + SK_LANE_BESIDE_MM) ||
         sk_is_below(s, 1, (int64_t)z->y_low_mm - SK_LANE_BESIDE_MM) || sk_is_above(s, 1, (int64_t)z->y_high_mm + SK_LANE_BESIDE_MM);
}

bool sk_away_from_lanes(const berm_parameters *p, const sk_slice *s)
{
  int32_t k;
  if (p->lanes < 0 || p->lanes > BERM_LANES || s->vertices < 1 || s->vertices > SK_SLICE_VERTICES) { return false; }
  /*@ loop invariant 0 <= k <= p->lanes;
    @ loop invariant \forall integer j; 0 <= j < k ==> sk_away_from_lane(s, &p->lane[j]);
    @ loop assigns k;
    @ loop variant p->lanes - k;
    @*/
  for (k = 0; k < p->lanes; k++) {
    if (!sk_is_away(s, &p->lane[k])) { return false; }
  }
  return true;
}
