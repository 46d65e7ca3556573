/* Frame guard: a guarded CAN message is used only if its guard frame came just before it, with the right data id, the next counter and the
 * right CRC over id, counter and payload; after the pattern of SAE J1939-76. One state for each guarded message. */
#ifndef SK_FRAME_GUARD_H
#define SK_FRAME_GUARD_H
#include "crc32.h"
SK_BEGIN

enum { SK_FRAME_OK = 0, SK_FRAME_UNGUARDED = 1, SK_FRAME_CRC = 2, SK_FRAME_COUNTER = 3, SK_FRAME_LENGTH = 4, SK_FRAME_LATE = 5 };

#define SK_GUARD_PAIR_US 20000 /* the guarded frame follows its guard within this */
#define SK_GUARD_GAP_MAX 3     /* two messages in a row may be lost */
#define SK_GUARD_COVERED 13    /* bytes under the CRC */

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

/*@ logic integer sk_guard_le32{L}(uint8_t *d, integer i) =
  @   \at(d[i], L) + 256 * \at(d[i + 1], L) + 65536 * \at(d[i + 2], L) + 16777216 * \at(d[i + 3], L);
  @ // what the CRC covers: the id (little endian), the counter, the payload
  @ logic integer sk_guard_byte{L}(integer id, integer counter, uint8_t *d, integer i) =
  @   i == 0 ? id % 256 : (i == 1 ? (id / 256) % 256 : (i == 2 ? (id / 65536) % 256 : (i == 3 ? id / 16777216 :
  @   (i == 4 ? counter : \at(d[i - 5], L)))));
  @ logic integer sk_guard_run{L}(integer id, integer counter, uint8_t *d, integer n) =
  @   n <= 0 ? 0xFFFFFFFF : sk_crc_bits(sk_guard_run{L}(id, counter, d, n - 1) ^ sk_guard_byte{L}(id, counter, d, n - 1), 8);
  @ logic integer sk_guard_crc_of{L}(integer id, integer counter, uint8_t *d) = sk_guard_run{L}(id, counter, d, SK_GUARD_COVERED) ^ 0xFFFFFFFF;
  @ predicate sk_guard_frame_ok{L}(integer id, uint8_t *d, integer length, integer now) =
  @   length == 8 && now >= 0 && \at(d[0], L) == (id / 256) % 256 && \at(d[2], L) == 255 && \at(d[3], L) == 255;
  @ predicate sk_pair_in_time(integer guard_us, integer now) = 0 <= guard_us <= now && now - guard_us <= SK_GUARD_PAIR_US;
  @ predicate sk_counter_next(integer last, integer counter) = 1 <= (counter - last + 256) % 256 <= SK_GUARD_GAP_MAX;
  @ predicate sk_counter_ok{L}(sk_guard_state *s) =
  @   \at(s->primed, L) == false || sk_counter_next(\at(s->last_counter, L), \at(s->guard_counter, L));
  @ predicate sk_crc_matches{L}(sk_guard_state *s, uint8_t *d) =
  @   \at(s->guard_crc, L) == sk_guard_crc_of{L}(\at(s->can_id, L), \at(s->guard_counter, L), d);
  @ predicate sk_guard_accepts{L}(sk_guard_state *s, uint8_t *d, integer length, integer now) =
  @   length == 8 && \at(s->armed, L) == true && sk_pair_in_time(\at(s->guard_us, L), now) &&
  @   sk_crc_matches{L}(s, d) && sk_counter_ok{L}(s);
  @*/

/*@ requires \valid(s);
  @ assigns *s;
  @ ensures s->can_id == can_id && s->armed == false && s->primed == false && s->last_us == -1;
  @*/
void sk_guard_init(sk_guard_state *s, uint32_t can_id);

/* A guard frame for this message (the caller has matched its source). A wrong length, data id, padding or time disarms. */
/*@ requires \valid(s) && \valid_read(data + (0 .. 7)) && \separated(s, data + (0 .. 7));
  @ assigns s->armed, s->guard_counter, s->guard_crc, s->guard_us;
  @ ensures arms: s->armed == true <==> sk_guard_frame_ok{Pre}(\old(s->can_id), data, length, now_us);
  @ ensures holds: s->armed == true ==> s->guard_counter == data[1] && s->guard_crc == sk_guard_le32(data, 4) && s->guard_us == now_us;
  @*/
void sk_guard_arm(sk_guard_state *s, const uint8_t data[8], int32_t length, int64_t now_us);

/* The guarded message itself. Always disarms. OK: counter is 1..SK_GUARD_GAP_MAX ahead of the last accepted (any, when not primed), CRC right,
 * pair in time. Anything else leaves last_* as they were. */
/*@ requires \valid(s) && \valid_read(data + (0 .. 7)) && \separated(s, data + (0 .. 7));
  @ assigns s->armed, s->primed, s->last_counter, s->last_us;
  @ ensures codes: 0 <= \result <= 5;
  @ ensures disarms: s->armed == false;
  @ ensures accepts: \result == SK_FRAME_OK <==> sk_guard_accepts{Pre}(s, data, length, now_us);
  @ ensures accepted: \result == SK_FRAME_OK ==> s->primed == true && s->last_counter == \old(s->guard_counter) && s->last_us == now_us;
  @ ensures refused: \result != SK_FRAME_OK ==>
  @   s->primed == \old(s->primed) && s->last_counter == \old(s->last_counter) && s->last_us == \old(s->last_us);
  @ ensures why_length: \result == SK_FRAME_LENGTH ==> length != 8;
  @ ensures why_unguarded: \result == SK_FRAME_UNGUARDED ==> \old(s->armed) == false;
  @ ensures why_late: \result == SK_FRAME_LATE ==> !sk_pair_in_time(\old(s->guard_us), now_us);
  @ ensures why_crc: \result == SK_FRAME_CRC ==> !sk_crc_matches{Pre}(s, data);
  @ ensures why_counter: \result == SK_FRAME_COUNTER ==> !sk_counter_ok{Pre}(s);
  @*/
int32_t sk_guard_accept(sk_guard_state *s, const uint8_t data[8], int32_t length, int64_t now_us);

/* Whether the newest accepted message is at most max_age_us old. A message from the future is not fresh. */
/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> (0 <= s->last_us <= now_us && now_us - s->last_us <= max_age_us);
  @*/
bool sk_guard_fresh(const sk_guard_state *s, int64_t now_us, int32_t max_age_us);

SK_END
#endif
