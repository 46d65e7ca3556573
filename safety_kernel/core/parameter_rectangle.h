/* The sides of a zone: in the map with room to spare, low below high. For the files of the parameter check. */
#ifndef SK_PARAMETER_RECTANGLE_H
#define SK_PARAMETER_RECTANGLE_H
#include "parameter_rules.h"
SK_BEGIN

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_rectangle_ok(x_low_mm, y_low_mm, x_high_mm, y_high_mm);
  @*/
static inline bool sk_is_rectangle(int32_t x_low_mm, int32_t y_low_mm, int32_t x_high_mm, int32_t y_high_mm)
{
  return -15000 <= x_low_mm && x_low_mm < x_high_mm && x_high_mm <= 15000 && -15000 <= y_low_mm && y_low_mm < y_high_mm && y_high_mm <= 15000;
}

SK_END
#endif
