#include "request_check.h"

BERM_STATIC_ASSERT(sizeof(berm_request) == SK_REQUEST_BYTES, "size of a request");
BERM_STATIC_ASSERT(offsetof(berm_request, magic) == 0, "magic");
BERM_STATIC_ASSERT(offsetof(berm_request, version) == 4, "version");
BERM_STATIC_ASSERT(offsetof(berm_request, phase) == 6, "phase");
BERM_STATIC_ASSERT(offsetof(berm_request, sequence) == 8, "sequence");
BERM_STATIC_ASSERT(offsetof(berm_request, flags) == 12, "flags");
BERM_STATIC_ASSERT(offsetof(berm_request, stamp_us) == 16, "stamp");
BERM_STATIC_ASSERT(offsetof(berm_request, joint_velocity_urad_s) == 24, "joint velocities");
BERM_STATIC_ASSERT(offsetof(berm_request, pan_goal_urad) == 40, "pan goals");
BERM_STATIC_ASSERT(offsetof(berm_request, pan_rate_urad_s) == 48, "pan rates");
BERM_STATIC_ASSERT(offsetof(berm_request, reserved_tail) == 56, "reserved tail");
BERM_STATIC_ASSERT(offsetof(berm_request, crc32) == SK_REQUEST_CRC_AT, "CRC");
BERM_STATIC_ASSERT(BERM_JOINTS == SK_JOINTS && BERM_SCANNERS == BERM_SCANNER_MOUNTS, "counts");

/*@ requires 0 <= at <= SK_REQUEST_BYTES - 2 && \valid_read(b + (at .. at + 1));
  @ assigns \nothing;
  @ ensures \result == sk_le16(b, at);
  @*/
static uint16_t read_u16(const uint8_t *b, int32_t at)
{
  return (uint16_t)((uint32_t)b[at] + 256U * (uint32_t)b[at + 1]);
}

/*@ requires 0 <= at <= SK_REQUEST_BYTES - 4 && \valid_read(b + (at .. at + 3));
  @ assigns \nothing;
  @ ensures \result == sk_le32(b, at);
  @*/
static uint32_t read_u32(const uint8_t *b, int32_t at)
{
  return (uint32_t)read_u16(b, at) + 65536U * (uint32_t)read_u16(b, at + 2);
}

/*@ requires 0 <= at <= SK_REQUEST_BYTES - 4 && \valid_read(b + (at .. at + 3));
  @ assigns \nothing;
  @ ensures \result == sk_les32(b, at);
  @*/
static int32_t read_s32(const uint8_t *b, int32_t at)
{
  int64_t v = (int64_t)read_u32(b, at);
  if (v >= 2147483648) { v = v - 4294967296; }
  return (int32_t)v;
}

/*@ requires 0 <= at <= SK_REQUEST_BYTES - 8 && \valid_read(b + (at .. at + 7));
  @ assigns \nothing;
  @ ensures \result == sk_les64(b, at);
  @*/
static int64_t read_s64(const uint8_t *b, int32_t at)
{
  return (int64_t)read_u32(b, at) + 4294967296 * (int64_t)read_s32(b, at + 4);
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_sequence_next(last, sequence);
  @*/
static bool sequence_next(uint32_t last, uint32_t sequence)
{
  int64_t gap = (int64_t)sequence - (int64_t)last;
  if (gap < 0) { gap = gap + 4294967296; }
  return gap >= 1 && gap <= SK_REQUEST_GAP_MAX;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_age_ok(stamp_us, now_us, limit_us);
  @*/
static bool age_ok(int64_t stamp_us, int64_t now_us, int32_t limit_us)
{
  return stamp_us >= 0 && stamp_us <= now_us && now_us - stamp_us <= limit_us;
}

/*@ requires \valid_read(p) && \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns \nothing;
  @ ensures \result == true <==> sk_velocities_in_range(raw, p);
  @*/
static bool velocities_in_range(const uint8_t *raw, const berm_parameters *p)
{
  int32_t j;
  /*@ loop invariant 0 <= j <= SK_JOINTS;
    @ loop invariant \forall integer i; 0 <= i < j ==> sk_velocity_in_range(raw, p, i);
    @ loop assigns j;
    @ loop variant SK_JOINTS - j;
    @*/
  for (j = 0; j < SK_JOINTS; j++) {
    int64_t v = (int64_t)read_s32(raw, 24 + 4 * j);
    int64_t limit = (int64_t)p->velocity_max_urad_s[j];
    if (v < -limit || v > limit) {
      /*@ assert !sk_velocity_in_range(raw, p, j); */
      return false;
    }
    /*@ assert sk_velocity_in_range(raw, p, j); */
  }
  return true;
}

/*@ requires \valid_read(p) && \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns \nothing;
  @ ensures \result == true <==> sk_pans_in_range(raw, p);
  @*/
static bool pans_in_range(const uint8_t *raw, const berm_parameters *p)
{
  int32_t i;
  /*@ loop invariant 0 <= i <= BERM_SCANNER_MOUNTS;
    @ loop invariant \forall integer k; 0 <= k < i ==> sk_pan_in_range(raw, p, k);
    @ loop assigns i;
    @ loop variant BERM_SCANNER_MOUNTS - i;
    @*/
  for (i = 0; i < BERM_SCANNER_MOUNTS; i++) {
    int32_t goal = read_s32(raw, 40 + 4 * i);
    int32_t rate = read_s32(raw, 48 + 4 * i);
    if (goal < p->scanner[i].pan_low_urad || goal > p->scanner[i].pan_high_urad || rate < 0 || rate > p->scanner[i].pan_rate_max_urad_s) {
      /*@ assert !sk_pan_in_range(raw, p, i); */
      return false;
    }
    /*@ assert sk_pan_in_range(raw, p, i); */
  }
  return true;
}

/*@ requires \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns \nothing;
  @ ensures \result == true <==> sk_request_fields(raw);
  @*/
static bool fields_ok(const uint8_t *raw)
{
  uint16_t phase = read_u16(raw, 6);
  uint32_t flags = read_u32(raw, 12);
  uint32_t tail = read_u32(raw, 56);
  return phase < BERM_PHASE_COUNT && flags <= BERM_REQUEST_FLAG_HORN && tail == 0U;
}

/*@ requires \valid_read(p) && \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns \nothing;
  @ ensures \result == true <==> sk_request_ranges(raw, p);
  @*/
static bool ranges_ok(const uint8_t *raw, const berm_parameters *p)
{
  return fields_ok(raw) && velocities_in_range(raw, p) && pans_in_range(raw, p);
}

/*@ requires \valid(out) && \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1)) && \separated(out, raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns out->phase, out->sequence, out->flags, out->stamp_us;
  @ ensures sk_request_head_decoded(raw, out);
  @*/
static void decode_head(const uint8_t *raw, sk_request *out)
{
  out->phase = read_u16(raw, 6);
  out->sequence = read_u32(raw, 8);
  out->flags = read_u32(raw, 12);
  out->stamp_us = read_s64(raw, 16);
}

/* count signed fields from offset at */
/*@ requires 0 <= at <= 48 && 0 <= count <= 4 && \valid(to + (0 .. count - 1)) && \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1));
  @ requires \separated(to + (0 .. count - 1), raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns to[0 .. count - 1];
  @ ensures \forall integer i; 0 <= i < count ==> to[i] == sk_les32(raw, at + 4 * i);
  @*/
static void decode_fields(const uint8_t *raw, int32_t at, int32_t count, int32_t *to)
{
  int32_t k;
  /*@ loop invariant 0 <= k <= count;
    @ loop invariant \forall integer i; 0 <= i < k ==> to[i] == sk_les32(raw, at + 4 * i);
    @ loop assigns k, to[0 .. count - 1];
    @ loop variant count - k;
    @*/
  for (k = 0; k < count; k++) { to[k] = read_s32(raw, at + 4 * k); }
}

/*@ requires \valid(out) && \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1)) && \separated(out, raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns *out;
  @ ensures sk_request_head_decoded(raw, out);
  @ ensures sk_velocities_decoded(raw, out) && sk_pan_goals_decoded(raw, out) && sk_pan_rates_decoded(raw, out);
  @*/
static void decode(const uint8_t *raw, sk_request *out)
{
  decode_head(raw, out);
  decode_fields(raw, 24, SK_JOINTS, out->joint_velocity_urad_s);
  decode_fields(raw, 40, BERM_SCANNER_MOUNTS, out->pan_goal_urad);
  decode_fields(raw, 48, BERM_SCANNER_MOUNTS, out->pan_rate_urad_s);
}

/* magic, version and CRC */
/*@ requires \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns \nothing;
  @ ensures codes: \result == BERM_REQUEST_ACCEPTED || \result == BERM_REQUEST_MAGIC || \result == BERM_REQUEST_VERSION || \result == BERM_REQUEST_CRC;
  @ ensures whole: \result == BERM_REQUEST_ACCEPTED <==> sk_request_magic(raw) && sk_request_version(raw) && sk_request_crc(raw);
  @ ensures why_magic: \result == BERM_REQUEST_MAGIC ==> !sk_request_magic(raw);
  @ ensures why_version: \result == BERM_REQUEST_VERSION ==> !sk_request_version(raw);
  @ ensures why_crc: \result == BERM_REQUEST_CRC ==> !sk_request_crc(raw);
  @*/
static int32_t check_frame(const uint8_t *raw)
{
  if (read_u32(raw, 0) != BERM_CONTRACT_MAGIC) { return BERM_REQUEST_MAGIC; }
  if (read_u16(raw, 4) != BERM_CONTRACT_VERSION) { return BERM_REQUEST_VERSION; }
  if (sk_crc32(raw, SK_REQUEST_CRC_AT) != read_u32(raw, SK_REQUEST_CRC_AT)) { return BERM_REQUEST_CRC; }
  return BERM_REQUEST_ACCEPTED;
}

/* sequence */
/*@ requires \valid_read(state) && \valid_read(raw + (0 .. SK_REQUEST_BYTES - 1));
  @ assigns \nothing;
  @ ensures codes: \result == BERM_REQUEST_ACCEPTED || \result == BERM_REQUEST_NONE || \result == BERM_REQUEST_SEQUENCE;
  @ ensures whole: \result == BERM_REQUEST_ACCEPTED <==> sk_request_sequence(state, raw);
  @ ensures why_none: \result == BERM_REQUEST_NONE ==> sk_request_again(state, raw);
  @ ensures why_sequence: \result == BERM_REQUEST_SEQUENCE ==> !sk_request_sequence(state, raw) && !sk_request_again(state, raw);
  @*/
static int32_t check_sequence(const sk_request_state *state, const uint8_t *raw)
{
  uint32_t sequence = read_u32(raw, 8);
  if (!state->primed) { return BERM_REQUEST_ACCEPTED; }
  if (sequence == state->last_sequence) { return BERM_REQUEST_NONE; }
  if (!sequence_next(state->last_sequence, sequence)) { return BERM_REQUEST_SEQUENCE; }
  return BERM_REQUEST_ACCEPTED;
}

int32_t sk_request_check(sk_request_state *state, const uint8_t raw[SK_REQUEST_BYTES], const berm_parameters *p, int64_t now_us, sk_request *out)
{
  int32_t result = check_frame(raw);
  if (result != BERM_REQUEST_ACCEPTED) { return result; }
  result = check_sequence(state, raw);
  if (result != BERM_REQUEST_ACCEPTED) { return result; }
  if (!age_ok(read_s64(raw, 16), now_us, p->request_age_us)) { return BERM_REQUEST_AGE; }
  if (!ranges_ok(raw, p)) { return BERM_REQUEST_RANGE; }
  state->primed = true;
  state->last_sequence = read_u32(raw, 8);
  state->last_accept_us = now_us;
  decode(raw, out);
  return BERM_REQUEST_ACCEPTED;
}
