/* Occlusion interpolation (leger-1998 section 2.1, Figure 3): every cell that the segment between two neighbouring returns crosses is
 * raised to an upper bound of the segment's height inside it. */
#ifndef SK_SCANLINE_RASTER_H
#define SK_SCANLINE_RASTER_H
#include "height_map.h"
SK_BEGIN

typedef struct sk_point { int32_t x_mm, y_mm, z_mm; } sk_point;

/* All coordinates are clamped to +-SK_COORD_MAX_MM (z to +-SK_HEIGHT_MAX_MM) by the caller; a point outside is refused: returns -1 and changes nothing.
 * Otherwise returns the number of cells raised. Equal points: the one cell. */
int32_t sk_raster_segment(sk_height_map *m, const sk_point *p, const sk_point *q, int64_t now_us, int32_t generation_us);

SK_END
#endif
