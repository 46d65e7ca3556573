/* What the horn says. The app sounds it with BERM_REQUEST_FLAG_HORN; whoever hears it knows no more of the app than these signals. Text: CONTRACT.md.
 * Seconds. */
#ifndef BERM_HORN_SIGNALS_H
#define BERM_HORN_SIGNALS_H

#define BERM_HORN_LONG_S 0.5          /* a blast of at least so long: the truck is full */
#define BERM_HORN_SHORT_S 0.3         /* a short blast ... */
#define BERM_HORN_GAP_S 0.3           /* ... and the silence before the next of its group */
#define BERM_HORN_GROUP_GAP_S 1.0     /* silence between the groups of a signal */
#define BERM_HORN_GROUP_END_S 0.7     /* silence that ends a group */
#define BERM_HORN_MOVE_BACK_BLASTS 3  /* first group of "move the machine back"; the second has a blast for each step */
#define BERM_HORN_MOVE_BACK_STEP_M 0.5
#define BERM_HORN_MOVE_BACK_STEPS 8   /* at most */

#endif
