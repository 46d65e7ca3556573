/* Request check: whether a motion request may be used at all. Works on a private copy of the bytes. */
#ifndef SK_REQUEST_CHECK_H
#define SK_REQUEST_CHECK_H
#include "crc32.h"
#include "config/parameter_block.h"
#include "contract/berm_contract.h"
SK_BEGIN

#define SK_REQUEST_BYTES 64
#define SK_REQUEST_CRC_AT 60
#define SK_REQUEST_GAP_MAX 1000 /* sequence numbers a request may be ahead of the last accepted */

typedef struct sk_request {
  uint16_t phase;
  uint32_t flags;          /* BERM_REQUEST_FLAG_* */
  uint32_t sequence;
  int64_t stamp_us;
  int32_t joint_velocity_urad_s[4];
  int32_t pan_goal_urad[2];
  int32_t pan_rate_urad_s[2];
} sk_request;

typedef struct sk_request_state {
  bool primed;             /* a request has been accepted since the app connected */
  uint32_t last_sequence;
  int64_t last_accept_us;
} sk_request_state;

/*@ logic integer sk_le16{L}(uint8_t *b, integer i) = \at(b[i], L) + 256 * \at(b[i + 1], L);
  @ logic integer sk_le32{L}(uint8_t *b, integer i) = sk_le16{L}(b, i) + 65536 * sk_le16{L}(b, i + 2);
  @ logic integer sk_signed32(integer u) = u >= 2147483648 ? u - 4294967296 : u;
  @ logic integer sk_les32{L}(uint8_t *b, integer i) = sk_signed32(sk_le32{L}(b, i));
  @ logic integer sk_les64{L}(uint8_t *b, integer i) = sk_le32{L}(b, i) + 4294967296 * sk_les32{L}(b, i + 4);
  @
  @ predicate sk_request_magic{L}(uint8_t *b) = sk_le32{L}(b, 0) == BERM_CONTRACT_MAGIC;
  @ predicate sk_request_version{L}(uint8_t *b) = sk_le16{L}(b, 4) == BERM_CONTRACT_VERSION;
  @ predicate sk_request_crc{L}(uint8_t *b) = sk_crc_of{L}(b, SK_REQUEST_CRC_AT) == sk_le32{L}(b, SK_REQUEST_CRC_AT);
  @ predicate sk_sequence_next(integer last, integer sequence) = 1 <= (sequence - last + 4294967296) % 4294967296 <= SK_REQUEST_GAP_MAX;
  @ predicate sk_request_sequence{L}(sk_request_state *s, uint8_t *b) =
  @   \at(s->primed, L) == false || sk_sequence_next(\at(s->last_sequence, L), sk_le32{L}(b, 8));
  @ predicate sk_request_again{L}(sk_request_state *s, uint8_t *b) =
  @   \at(s->primed, L) == true && \at(s->last_sequence, L) == sk_le32{L}(b, 8);
  @ predicate sk_age_ok(integer stamp, integer now, integer limit) = 0 <= stamp <= now && now - stamp <= limit;
  @ predicate sk_request_age{L}(uint8_t *b, berm_parameters *p, integer now) = sk_age_ok(sk_les64{L}(b, 16), now, \at(p->request_age_us, L));
  @ predicate sk_velocity_in_range{L}(uint8_t *b, berm_parameters *p, integer j) =
  @   -\at(p->velocity_max_urad_s[j], L) <= sk_les32{L}(b, 24 + 4 * j) <= \at(p->velocity_max_urad_s[j], L);
  @ predicate sk_pan_in_range{L}(uint8_t *b, berm_parameters *p, integer i) =
  @   \at(p->scanner[i].pan_low_urad, L) <= sk_les32{L}(b, 40 + 4 * i) <= \at(p->scanner[i].pan_high_urad, L) &&
  @   0 <= sk_les32{L}(b, 48 + 4 * i) <= \at(p->scanner[i].pan_rate_max_urad_s, L);
  @ predicate sk_velocities_in_range{L}(uint8_t *b, berm_parameters *p) =
  @   \forall integer j; 0 <= j < SK_JOINTS ==> sk_velocity_in_range{L}(b, p, j);
  @ predicate sk_pans_in_range{L}(uint8_t *b, berm_parameters *p) =
  @   \forall integer i; 0 <= i < BERM_SCANNER_MOUNTS ==> sk_pan_in_range{L}(b, p, i);
  @ predicate sk_request_fields{L}(uint8_t *b) =
  @   sk_le16{L}(b, 6) < BERM_PHASE_COUNT && sk_le32{L}(b, 12) <= BERM_REQUEST_FLAG_HORN && sk_le32{L}(b, 56) == 0;
  @ predicate sk_request_ranges{L}(uint8_t *b, berm_parameters *p) =
  @   sk_request_fields{L}(b) && sk_velocities_in_range{L}(b, p) && sk_pans_in_range{L}(b, p);
  @ predicate sk_request_acceptable{L}(sk_request_state *s, uint8_t *b, berm_parameters *p, integer now) =
  @   sk_request_magic{L}(b) && sk_request_version{L}(b) && sk_request_crc{L}(b) && sk_request_sequence{L}(s, b) &&
  @   sk_request_age{L}(b, p, now) && sk_request_ranges{L}(b, p);
  @
  @ predicate sk_request_head_decoded{L}(uint8_t *b, sk_request *r) =
  @   \at(r->phase, L) == sk_le16{L}(b, 6) && \at(r->sequence, L) == sk_le32{L}(b, 8) && \at(r->flags, L) == sk_le32{L}(b, 12) &&
  @   \at(r->stamp_us, L) == sk_les64{L}(b, 16);
  @ predicate sk_velocities_decoded{L}(uint8_t *b, sk_request *r) =
  @   \forall integer j; 0 <= j < SK_JOINTS ==> \at(r->joint_velocity_urad_s[j], L) == sk_les32{L}(b, 24 + 4 * j);
  @ predicate sk_pan_goals_decoded{L}(uint8_t *b, sk_request *r) =
  @   \forall integer i; 0 <= i < BERM_SCANNER_MOUNTS ==> \at(r->pan_goal_urad[i], L) == sk_les32{L}(b, 40 + 4 * i);
  @ predicate sk_pan_rates_decoded{L}(uint8_t *b, sk_request *r) =
  @   \forall integer i; 0 <= i < BERM_SCANNER_MOUNTS ==> \at(r->pan_rate_urad_s[i], L) == sk_les32{L}(b, 48 + 4 * i);
  @*/

/* Returns BERM_REQUEST_* (contract header). The same sequence as last accepted is BERM_REQUEST_NONE. Anything but ACCEPTED leaves *state and *out as they were.
 * Sequence: 1..SK_REQUEST_GAP_MAX ahead of the last, wrapping. Age: 0 <= now - stamp <= request_age_us, stamp not negative. Ranges: velocities within
 * velocity_max, pan goals within the pan limits, rates 0..pan_rate_max; reserved fields and unknown flags zero; phase below BERM_PHASE_COUNT.
 * Checked in the order of the codes MAGIC, VERSION, CRC, SEQUENCE (NONE), AGE, RANGE: the first that fails is returned. */
/*@ requires \valid(state) && \valid(out) && \valid_read(p) && \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1));
  @ requires \separated(state, out, p, raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns *state, *out;
  @ ensures codes: 0 <= \result < BERM_REQUEST_RESULTS;
  @ ensures accepts: \result == BERM_REQUEST_ACCEPTED <==> sk_request_acceptable{Pre}(state, raw, p, now_us);
  @ ensures head: \result == BERM_REQUEST_ACCEPTED ==> sk_request_head_decoded(raw, out);
  @ ensures velocities: \result == BERM_REQUEST_ACCEPTED ==> sk_velocities_decoded(raw, out);
  @ ensures pan_goals: \result == BERM_REQUEST_ACCEPTED ==> sk_pan_goals_decoded(raw, out);
  @ ensures pan_rates: \result == BERM_REQUEST_ACCEPTED ==> sk_pan_rates_decoded(raw, out);
  @ ensures primes: \result == BERM_REQUEST_ACCEPTED ==> state->primed == true;
  @ ensures remembers: \result == BERM_REQUEST_ACCEPTED ==> state->last_sequence == sk_le32{Pre}(raw, 8);
  @ ensures stamps: \result == BERM_REQUEST_ACCEPTED ==> state->last_accept_us == now_us;
  @ ensures refused_keeps_state: \result != BERM_REQUEST_ACCEPTED ==> *state == \old(*state);
  @ ensures refused_keeps_out: \result != BERM_REQUEST_ACCEPTED ==> *out == \old(*out);
  @ ensures why_magic: \result == BERM_REQUEST_MAGIC ==> !sk_request_magic(raw);
  @ ensures why_version: \result == BERM_REQUEST_VERSION ==> !sk_request_version(raw);
  @ ensures why_crc: \result == BERM_REQUEST_CRC ==> !sk_request_crc(raw);
  @ ensures why_none: \result == BERM_REQUEST_NONE ==> sk_request_again{Pre}(state, raw);
  @ ensures why_sequence: \result == BERM_REQUEST_SEQUENCE ==> !sk_request_sequence{Pre}(state, raw) && !sk_request_again{Pre}(state, raw);
  @ ensures why_age: \result == BERM_REQUEST_AGE ==> !sk_request_age(raw, p, now_us);
  @ ensures why_range: \result == BERM_REQUEST_RANGE ==> !sk_request_ranges(raw, p);
  @*/
int32_t sk_request_check(sk_request_state *state, const uint8_t raw[SK_REQUEST_BYTES], const berm_parameters *p, int64_t now_us, sk_request *out);

SK_END
#endif
