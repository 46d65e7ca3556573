/* Frame guard: a guarded CAN message is used only if its guard frame came just before it, with the right data id, the next counter and the
 * right CRC over id, counter and payload; after the pattern of SAE J1939-76. One state for each guarded message. */
#ifndef SK_FRAME_GUARD_H
#define SK_FRAME_GUARD_H
#include "sk_common.h"
SK_BEGIN

enum { SK_FRAME_OK = 0, SK_FRAME_UNGUARDED = 1, SK_FRAME_CRC = 2, SK_FRAME_COUNTER = 3, SK_FRAME_LENGTH = 4, SK_FRAME_LATE = 5 };

#define SK_GUARD_PAIR_US 20000 /* the guarded frame follows its guard within this */

typedef struct sk_guard_state {
  uint32_t can_id;        /* of the guarded message */
  bool armed;             /* a guard frame waits for its message */
  uint8_t guard_counter;
  uint32_t guard_crc;
  int64_t guard_us;
  bool primed;            /* a message has been accepted */
  uint8_t last_counter;
  int64_t last_us;        /* when the last message was accepted; -1 never */
} sk_guard_state;

void sk_guard_init(sk_guard_state *s, uint32_t can_id);
/* A guard frame for this message (the caller has matched source and data id). A wrong length disarms. */
void sk_guard_arm(sk_guard_state *s, const uint8_t data[8], int32_t length, int64_t now_us);
/* The guarded message itself. Always disarms. OK: counter is 1..3 ahead of the last accepted (any, when not primed), CRC right, pair in time. Anything else leaves last_* as they were. */
int32_t sk_guard_accept(sk_guard_state *s, const uint8_t data[8], int32_t length, int64_t now_us);
/* Whether the newest accepted message is at most max_age_us old. */
bool sk_guard_fresh(const sk_guard_state *s, int64_t now_us, int32_t max_age_us);

SK_END
#endif
