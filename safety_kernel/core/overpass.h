/* Overpass rule: how high the ground, and what stands on it, may be for the implements to pass over it. What is higher may be a person or a
 * vehicle; nobody needs to tell which. */
#ifndef SK_OVERPASS_H
#define SK_OVERPASS_H
#include "clearance_rules.h"
#include "parameter_overpass.h"
SK_BEGIN

/*@ predicate sk_square_meets(integer x_low, integer y_low, integer x_high, integer y_high, integer iy, integer ix) =
  @   x_low <= sk_cell_low(ix) + SK_CELL_MM && sk_cell_low(ix) <= x_high && y_low <= sk_cell_low(iy) + SK_CELL_MM && sk_cell_low(iy) <= y_high;
  @ predicate sk_in_truck_zone{L}(berm_truck_zone *z, integer iy, integer ix) =
  @   sk_square_within(\at(z->x_low_mm, L), \at(z->y_low_mm, L), \at(z->x_high_mm, L), \at(z->y_high_mm, L), iy, ix);
  @ predicate sk_meets_ground_zone{L}(berm_ground_zone *z, integer iy, integer ix) =
  @   sk_square_meets(\at(z->x_low_mm, L), \at(z->y_low_mm, L), \at(z->x_high_mm, L), \at(z->y_high_mm, L), iy, ix);
  @
  @ // a top at z is no higher than the site's limit, nor that of any lower ground that the cell meets
  @ predicate sk_ground_passes{L}(berm_parameters *p, integer iy, integer ix, integer zones, integer z) = z <= \at(p->pass_over_mm, L) &&
  @   \forall integer i; 0 <= i < zones && sk_meets_ground_zone{L}(&p->ground_zone[i], iy, ix) ==> z <= \at(p->ground_zone[i].pass_over_mm, L);
  @ // the cell is wholly in a truck zone, and the top no higher than its ceiling
  @ predicate sk_truck_passes{L}(berm_parameters *p, integer iy, integer ix, integer zones, integer z) =
  @   \exists integer i; 0 <= i < zones && sk_in_truck_zone{L}(&p->truck_zone[i], iy, ix) && z <= \at(p->truck_zone[i].ceiling_mm, L);
  @ // the same of a dig zone: soil that may be dug
  @ predicate sk_dig_passes{L}(berm_parameters *p, integer iy, integer ix, integer zones, integer z) =
  @   \exists integer i; 0 <= i < zones && sk_cell_in_zone{L}(&p->dig_zone[i], iy, ix) && z <= \at(p->dig_zone[i].ceiling_mm, L);
  @ predicate sk_may_pass{L}(berm_parameters *p, integer truck, integer iy, integer ix, integer z) =
  @   sk_ground_passes{L}(p, iy, ix, \at(p->ground_zones, L), z) ||
  @   (truck != 0 && sk_truck_passes{L}(p, iy, ix, \at(p->truck_zones, L), z)) || sk_dig_passes{L}(p, iy, ix, \at(p->dig_zones, L), z);
  @ // the greatest top that may pass
  @ predicate sk_pass_limit{L}(berm_parameters *p, integer truck, integer iy, integer ix, integer limit) =
  @   sk_may_pass{L}(p, truck, iy, ix, limit) && \forall integer z; sk_may_pass{L}(p, truck, iy, ix, z) ==> z <= limit;
  @ predicate sk_dig_ceilings_fit(berm_parameters *p) = sk_within(p->dig_zones, 0, BERM_DIG_ZONES) &&
  @   \forall integer i; 0 <= i < p->dig_zones ==> sk_height_ok(p->dig_zone[i].ceiling_mm);
  @*/

/* Of each cell the greatest top that may be passed over, into out->pass_mm; no other rule is touched. truck_admitted: the spotter says that a truck
 * stands ready to be loaded. False, and nothing written, when the limits, or the zones' numbers or ceilings, break the rules of the parameter check. */
/*@ requires \valid_read(p) && \valid(out) && \separated(p, out);
  @ assigns out->pass_mm[..][..];
  @ ensures accepts: \result == true <==> sk_overpass_ok(p) && sk_dig_ceilings_fit(p);
  @ ensures refused: \result == false ==> \forall integer iy, ix; sk_in_map(iy, ix) ==> out->pass_mm[iy][ix] == \old(out->pass_mm[iy][ix]);
  @ ensures limits: \result == true ==> \forall integer iy, ix; sk_in_map(iy, ix) ==> sk_pass_limit(p, truck_admitted, iy, ix, out->pass_mm[iy][ix]);
  @*/
bool sk_pass_limits(const berm_parameters *p, bool truck_admitted, sk_clearance_rules *out);

SK_END
#endif
