/* The reach box: for each joint the interval that holds every position it can take if a command is obeyed for one more cycle and a stop
 * is issued then, from measured angle and speed with their error bounds, largest acceleration, latencies and the braking table. */
#ifndef SK_REACH_BOX_H
#define SK_REACH_BOX_H
#include "sk_common.h"
#include "config/parameter_block.h"
SK_BEGIN

typedef struct sk_reach_box {
  int32_t low_urad[SK_JOINTS];
  int32_t high_urad[SK_JOINTS];
  int32_t speed_urad_s[SK_JOINTS]; /* bound of the joint's absolute speed until it stands */
} sk_reach_box;

/* How the next cycle's command enters. */
enum {
  SK_REACH_ANY = 0,      /* any command whatever may be obeyed */
  SK_REACH_COMMANDED = 1 /* only commands within command_low..command_high (all that are still under way and the next); for creep recovery */
};

/* Row of the braking table for a reach: the first with brake_reach_mm[row] >= reach_mm, or -1 when there is none. */
int32_t sk_brake_row(const berm_parameters *p, int32_t reach_mm);

/* Worst-case stop angle of joint for |speed|, row: the first column at or above the speed (rounded up, never interpolated down); -1 when the
 * speed is above the table. */
int32_t sk_brake_angle(const berm_parameters *p, int32_t joint, int32_t row, int32_t speed_urad_s);

/* Interval of one joint into out->low/high/speed[joint]. Returns false, and changes nothing, when the speed bound exceeds the braking table
 * or an input is out of its range (|angle| <= 10 rad, |velocity| <= 5 rad/s). Parameters must have passed sk_parameters_check. */
bool sk_reach_joint(const berm_parameters *p, int32_t joint, int32_t row, int32_t angle_urad, int32_t velocity_urad_s, int32_t mode,
                    int32_t command_low_urad_s, int32_t command_high_urad_s, sk_reach_box *out);

SK_END
#endif
