/* CRC-32 (IEEE 802.3, reflected, as zlib's), bit by bit. */
#ifndef SK_CRC32_H
#define SK_CRC32_H
#include "sk_common.h"
SK_BEGIN

#define SK_CRC32_BYTES_MAX 65536

/*@ // the register after one more bit, after k more bits, after n more bytes
  @ logic integer sk_crc_bit(integer c) = (c % 2 == 1) ? ((c / 2) ^ 0xEDB88320) : c / 2;
  @ logic integer sk_crc_bits(integer c, integer k) = k <= 0 ? c : sk_crc_bit(sk_crc_bits(c, k - 1));
  @ logic integer sk_crc_run{L}(integer c, uint8_t *p, integer n) =
  @   n <= 0 ? c : sk_crc_bits(sk_crc_run{L}(c, p, n - 1) ^ \at(p[n - 1], L), 8);
  @ logic integer sk_crc_of{L}(uint8_t *p, integer n) = sk_crc_run{L}(0xFFFFFFFF, p, n) ^ 0xFFFFFFFF;
  @*/

/* The register (start: all ones; result: its complement) after one more byte. */
/*@ assigns \nothing;
  @ ensures \result == sk_crc_bits(crc_register ^ byte, 8);
  @*/
uint32_t sk_crc32_byte(uint32_t crc_register, uint8_t byte);

/* The register after n more bytes. */
/*@ requires 0 <= n <= SK_CRC32_BYTES_MAX && \valid_read(bytes + (0 .. n - 1));
  @ assigns \nothing;
  @ ensures \result == sk_crc_run(crc_register, bytes, n);
  @*/
uint32_t sk_crc32_run(uint32_t crc_register, const uint8_t *bytes, int32_t n);

/*@ requires 0 <= n <= SK_CRC32_BYTES_MAX && \valid_read(bytes + (0 .. n - 1));
  @ assigns \nothing;
  @ ensures \result == sk_crc_of(bytes, n);
  @*/
uint32_t sk_crc32(const uint8_t *bytes, int32_t n);

SK_END
#endif
