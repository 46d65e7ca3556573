/* The scan datagram of the panning scanners. C11 and C++17. Normative text: SCAN.md.
 *
 * One UDP datagram carries up to BERM_SCAN_PACKET_SAMPLES consecutive samples of one scanline (a scanline is one turn of the
 * mirror, BERM_SCAN samples_per_revolution samples). Little endian on the wire, no padding; encode and decode copy field by field.
 *
 * Direction of sample i in the upper body's frame (x forward along the implements, y left, z up), from the scanner's head:
 *   e = 2 pi (first_index + i) / samples_per_revolution   0 forward horizontal, pi/2 up, pi back, 3 pi/2 down
 *   direction = (cos e cos pan, cos e sin pan, sin e)
 * pan is linear between pan_start and pan_end over the packet's samples.
 */
#ifndef BERM_SCAN_PACKET_H
#define BERM_SCAN_PACKET_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BERM_SCAN_PACKET_MAGIC 0x4E435342u /* "BSCN" */
#define BERM_SCAN_PACKET_VERSION 1
#define BERM_SCAN_PACKET_SAMPLES 120
#define BERM_SCAN_ECHOES 3
#define BERM_SCAN_RANGE_LSB_MM 4 /* raw 0: no return; largest 262 m */
#define BERM_SCAN_HEADER_BYTES 56
#define BERM_SCAN_PACKET_MAX_BYTES (BERM_SCAN_HEADER_BYTES + BERM_SCAN_PACKET_SAMPLES * BERM_SCAN_ECHOES * 2 + 4)

enum { BERM_SCAN_FLAG_FIRST = 1, BERM_SCAN_FLAG_LAST = 2, BERM_SCAN_FLAG_WINDOW_DIRTY = 4, BERM_SCAN_FLAG_HEAD_FAULT = 8 };

typedef struct berm_scan_packet {
  uint8_t scanner;                 /* 0 left, 1 right                                     offset 5 */
  uint16_t flags;                  /* BERM_SCAN_FLAG_*                                            6 */
  uint32_t sequence;               /* one more each packet of this scanner, wrapping              8 */
  uint32_t scanline;               /* one more each turn of the mirror                           12 */
  uint64_t time_us;                /* of the first sample                                        16 */
  uint32_t sample_period_ns;       /* 83333 at 12 kHz                                            24 */
  int32_t pan_start_urad;          /* at the first sample                                        28 */
  int32_t pan_end_urad;            /* at the last sample                                         32 */
  uint16_t first_index;            /*                                                            36 */
  uint16_t samples_per_revolution; /* 400                                                        38 */
  uint16_t count;              /* 1..BERM_SCAN_PACKET_SAMPLES                                    40 */
  uint8_t echoes_per_sample;   /* 1..3                                                           42 */
  uint8_t window_percent;      /* transmission of the exit window                                43 */
  /* 44..55 reserved, zero; magic u32 at 0, version u8 at 4 */
  uint16_t range[BERM_SCAN_PACKET_SAMPLES][BERM_SCAN_ECHOES]; /* nearest echo first; 0 where there is none */
} berm_scan_packet;                /* after the header: count x echoes_per_sample u16, then CRC-32C of all before it */

/* Result of decoding. */
enum {
  BERM_SCAN_OK = 0, BERM_SCAN_LENGTH = 1, BERM_SCAN_MAGIC = 2, BERM_SCAN_VERSION = 3, BERM_SCAN_CRC = 4,
  BERM_SCAN_FIELD = 5 /* a field out of its range */
};

/* Writes the datagram, returns its length in bytes; 0 when a field is out of range. out: BERM_SCAN_PACKET_MAX_BYTES. */
size_t berm_scan_encode(const berm_scan_packet *p, uint8_t *out);
/* Reads a datagram of n bytes. On any result but BERM_SCAN_OK *p is unchanged. */
int berm_scan_decode(const uint8_t *bytes, size_t n, berm_scan_packet *p);
const char *berm_scan_result_text(int result);

uint32_t berm_crc32(const uint8_t *bytes, size_t n);  /* IEEE 802.3, reflected, as in zlib */
/* Goes on where crc, of all bytes before, left off; 0 at the begin. */
uint32_t berm_crc32_continue(uint32_t crc, const uint8_t *bytes, size_t n);
uint32_t berm_crc32c(const uint8_t *bytes, size_t n); /* Castagnoli */

#ifdef __cplusplus
}
#endif
#endif
