/* CRC-32 (IEEE 802.3, reflected, as zlib's), bit by bit. */
#ifndef SK_CRC32_H
#define SK_CRC32_H
#include "sk_common.h"
SK_BEGIN
uint32_t sk_crc32(const uint8_t *bytes, int32_t n);
SK_END
#endif
