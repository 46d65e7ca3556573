#include "frame_guard.h"

void sk_guard_init(sk_guard_state *s, uint32_t can_id)
{
  s->can_id = can_id;
  s->armed = false;
  s->guard_counter = 0U;
  s->guard_crc = 0U;
  s->guard_us = 0;
  s->primed = false;
  s->last_counter = 0U;
  s->last_us = -1;
}

/*@ requires \valid_read(d + (0 .. 3));
  @ assigns \nothing;
  @ ensures \result == sk_guard_le32(d, 0);
  @*/
static uint32_t read_le32(const uint8_t *d)
{
  return (uint32_t)d[0] + 256U * (uint32_t)d[1] + 65536U * (uint32_t)d[2] + 16777216U * (uint32_t)d[3];
}

/*@ requires 0 <= i < SK_GUARD_COVERED && \valid_read(data + (0 .. 7));
  @ assigns \nothing;
  @ ensures \result == sk_guard_byte(id, counter, data, i);
  @*/
static uint8_t covered_byte(uint32_t id, uint8_t counter, const uint8_t *data, int32_t i)
{
  if (i == 0) { return (uint8_t)(id % 256U); }
  if (i == 1) { return (uint8_t)((id / 256U) % 256U); }
  if (i == 2) { return (uint8_t)((id / 65536U) % 256U); }
  if (i == 3) { return (uint8_t)(id / 16777216U); }
  if (i == 4) { return counter; }
  return data[i - 5];
}

/*@ requires \valid_read(s) && \valid_read(data + (0 .. 7));
  @ assigns \nothing;
  @ ensures \result == true <==> sk_crc_matches(s, data);
  @*/
static bool crc_matches(const sk_guard_state *s, const uint8_t *data)
{
  uint32_t c = 0xFFFFFFFFU;
  int32_t i;
  /*@ loop invariant 0 <= i <= SK_GUARD_COVERED;
    @ loop invariant c == sk_guard_run(s->can_id, s->guard_counter, data, i);
    @ loop assigns i, c;
    @ loop variant SK_GUARD_COVERED - i;
    @*/
  for (i = 0; i < SK_GUARD_COVERED; i++) { c = sk_crc32_byte(c, covered_byte(s->can_id, s->guard_counter, data, i)); }
  return (c ^ 0xFFFFFFFFU) == s->guard_crc;
}

/*@ assigns \nothing;
  @ ensures \result == true <==> sk_pair_in_time(guard_us, now_us);
  @*/
static bool pair_in_time(int64_t guard_us, int64_t now_us)
{
  return guard_us >= 0 && guard_us <= now_us && now_us - guard_us <= SK_GUARD_PAIR_US;
}

/*@ requires \valid_read(s);
  @ assigns \nothing;
  @ ensures \result == true <==> sk_counter_ok(s);
  @*/
static bool counter_ok(const sk_guard_state *s)
{
  int32_t gap = (int32_t)s->guard_counter - (int32_t)s->last_counter;
  if (gap < 0) { gap = gap + 256; }
  return !s->primed || (gap >= 1 && gap <= SK_GUARD_GAP_MAX);
}

void sk_guard_arm(sk_guard_state *s, const uint8_t data[8], int32_t length, int64_t now_us)
{
  s->armed = false;
  if (length != 8 || now_us < 0) { return; }
  if ((uint32_t)data[0] != (s->can_id / 256U) % 256U || data[2] != 255U || data[3] != 255U) { return; }
  s->armed = true;
  s->guard_counter = data[1];
  s->guard_crc = read_le32(&data[4]);
  s->guard_us = now_us;
}

int32_t sk_guard_accept(sk_guard_state *s, const uint8_t data[8], int32_t length, int64_t now_us)
{
  bool armed = s->armed;
  s->armed = false;
  if (length != 8) { return SK_FRAME_LENGTH; }
  if (!armed) { return SK_FRAME_UNGUARDED; }
  if (!pair_in_time(s->guard_us, now_us)) { return SK_FRAME_LATE; }
  if (!crc_matches(s, data)) { return SK_FRAME_CRC; }
  if (!counter_ok(s)) { return SK_FRAME_COUNTER; }
  s->primed = true;
  s->last_counter = s->guard_counter;
  s->last_us = now_us;
  return SK_FRAME_OK;
}

bool sk_guard_fresh(const sk_guard_state *s, int64_t now_us, int32_t max_age_us)
{
  return s->last_us >= 0 && s->last_us <= now_us && now_us - s->last_us <= max_age_us;
}
