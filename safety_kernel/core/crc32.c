#include "crc32.h"

uint32_t sk_crc32_byte(uint32_t crc_register, uint8_t byte)
{
  uint32_t c = crc_register ^ (uint32_t)byte;
  int32_t k;
  /*@ loop invariant 0 <= k <= 8;
    @ loop invariant c == sk_crc_bits(crc_register ^ byte, k);
    @ loop assigns k, c;
    @ loop variant 8 - k;
    @*/
  for (k = 0; k < 8; k++) {
    if (c % 2U == 1U) { c = (c / 2U) ^ 0xEDB88320U; }
    else { c = c / 2U; }
  }
  return c;
}

uint32_t sk_crc32_run(uint32_t crc_register, const uint8_t *bytes, int32_t n)
{
  uint32_t c = crc_register;
  int32_t i;
  /*@ loop invariant 0 <= i <= n;
    @ loop invariant c == sk_crc_run(crc_register, bytes, i);
    @ loop assigns i, c;
    @ loop variant n - i;
    @*/
  for (i = 0; i < n; i++) { c = sk_crc32_byte(c, bytes[i]); }
  return c;
}

uint32_t sk_crc32(const uint8_t *bytes, int32_t n)
{
  return sk_crc32_run(0xFFFFFFFFU, bytes, n) ^ 0xFFFFFFFFU;
}
