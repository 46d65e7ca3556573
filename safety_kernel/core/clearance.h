/* Clearance: every cell under a convex slice of the swept volume must be observed, fresh, and separated from the slice by a plane
 * with integer coefficients; the dig-zone rule excepts contact with soil that is to be dug. */
#ifndef SK_CLEARANCE_H
#define SK_CLEARANCE_H
#include "height_map.h"
#include "config/parameter_block.h"
SK_BEGIN

#define SK_SLICE_VERTICES 24
#define SK_SLICE_PLANES 24
#define SK_NORMAL_MAX 1048576 /* bound of each component of a plane's normal */

typedef struct sk_plane { int32_t nx, ny, nz; int64_t d; } sk_plane;

typedef struct sk_slice {
  int32_t link;                              /* joint index of the link: 1 boom, 2 stick, 3 bucket */
  int32_t vertices;                          /* 1..SK_SLICE_VERTICES */
  int32_t vertex_mm[SK_SLICE_VERTICES][3];   /* base frame; their convex hull covers the slice */
  int32_t planes;                            /* 1..SK_SLICE_PLANES */
  sk_plane plane[SK_SLICE_PLANES];           /* claimed: n . vertex > d for every vertex */
} sk_slice;

/* For each cell under the slice's bounding rectangle the plane that is claimed to separate it: n . corner <= d for the column. */
typedef struct sk_choice { uint8_t plane_of[SK_MAP_CELLS][SK_MAP_CELLS]; } sk_choice;

typedef struct sk_clearance_rules {
  int64_t now_us;
  int32_t fresh_us;
  int32_t margin_mm;
  int32_t own_body_radius_mm;  /* cells wholly nearer the origin are the machine's own: nothing to check for the boom, blocked for stick and bucket */
  bool dig_allowed;            /* swing speed bound is under the dig limit (decided by the caller from the reach box) */
  int32_t dig_zones;
  berm_dig_zone dig_zone[BERM_DIG_ZONES];
} sk_clearance_rules;

enum {
  SK_CLEAR = 0, SK_BLOCKED_COLLISION = 1, SK_BLOCKED_UNKNOWN = 2, SK_BLOCKED_STALE = 3, SK_BLOCKED_FLOOR = 4, SK_BLOCKED_INVALID = 5
};

typedef struct sk_clearance_result { int32_t verdict; int32_t iy, ix; int32_t cells; } sk_clearance_result;

/* A column is the cell's square, from below everything up to the effective height plus margin. A cell never observed or stale is a column
 * without a top: only a vertical plane (nz == 0) separates it. nz < 0 is never accepted. A slice with any vertex outside the map is BLOCKED_UNKNOWN.
 * Dig-zone rule: a cell whose square lies wholly inside a dig zone needs no separation when dig_allowed and every vertex of the slice is at or above the
 * zone's floor; below the floor it is BLOCKED_FLOOR.
 * out->verdict is SK_CLEAR only if every plane that is used has every vertex strictly on its positive side and every cell of the bounding rectangle passes.
 * On anything malformed (counts, ranges, link) the verdict is SK_BLOCKED_INVALID. */
void sk_clear_slice(const sk_height_map *m, const sk_slice *s, const sk_choice *choice, const sk_clearance_rules *rules, sk_clearance_result *out);

SK_END
#endif
