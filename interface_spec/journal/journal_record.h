/* The journal: what the kernel hands to the journal's writer, and the records that the writer files. C11 and C++17, little endian.
 * Normative text: JOURNAL.md. Records lie in the ring as these structures, one behind the other, each a multiple of 8 bytes.
 *
 * RING segment: created by the kernel, sealed with F_SEAL_FUTURE_WRITE, mapped read-only by the writer. Header, then the ring's bytes.
 * TAIL segment: created and sealed against resizing by the kernel, written by the writer, read (and not believed) by the kernel.
 */
#ifndef BERM_JOURNAL_RECORD_H
#define BERM_JOURNAL_RECORD_H

#include "config/parameter_block.h"
#include "contract/berm_contract.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BERM_JOURNAL_MAGIC 0x4A4D5242u        /* "BRMJ": the ring segment */
#define BERM_JOURNAL_RECORD_MAGIC 0x43525242u /* "BRRC": a record */
#define BERM_JOURNAL_VERSION 1u
#define BERM_JOURNAL_RING_BYTES (16u * 1024u * 1024u) /* a power of two; ten simulated minutes are about sixty times as much */
#define BERM_JOURNAL_VLP16_BYTES 1206u
#define BERM_JOURNAL_MAP_ROWS 104u

/* With what the kernel started. Written before the first greeting, then it stays. */
typedef struct berm_journal_start {
  uint32_t version;          /* BERM_JOURNAL_VERSION */
  uint32_t contract_version; /* BERM_CONTRACT_VERSION */
  uint32_t cell_mm;          /* edge of a map cell */
  uint32_t map_only;         /* 1: no machine */
  uint32_t parameter_bytes;  /* sizeof(berm_parameters) */
  uint32_t reserved;
  double mount[4];           /* VLP-16: x, y, z in metres, yaw in radians */
  berm_parameters parameters;
} berm_journal_start;

typedef struct berm_journal_ring {
  uint32_t magic;
  uint32_t size;          /* of the ring's bytes, a power of two */
  uint32_t header_bytes;  /* from the segment's begin to the ring's first byte */
  uint32_t reserved;
  uint64_t head;          /* bytes written since start; the next record begins at head % size */
  uint64_t offered;       /* records the kernel made or would have made, one a cycle */
  uint64_t lost;          /* of them dropped: no room, or no writer any more */
  uint64_t reserved_tail;
  berm_journal_start start;
} berm_journal_ring;
#define BERM_JOURNAL_HEADER_BYTES ((uint32_t)((sizeof(berm_journal_ring) + 63u) / 64u * 64u))

typedef struct berm_journal_tail {
  uint64_t tail;          /* bytes read since start */
  uint64_t reserved[7];
} berm_journal_tail;

#define BERM_JOURNAL_CLOCK_FAULT 1u
#define BERM_JOURNAL_APP_CONNECTED 2u

/* One cycle: its inputs and what came out. Behind it: frames_in + frames_out times berm_journal_frame, then scan_packets times
 * berm_journal_scan with its ranges, then vlp16_packets times the packet's 1206 bytes, then
 * lidar_packets times the packet's 1206 bytes and one byte with the lidar's number; each scan and packet filled up to 8 bytes with zeros. */
typedef struct berm_journal_cycle {
  uint32_t magic;             /* BERM_JOURNAL_RECORD_MAGIC */
  uint32_t bytes;             /* of the whole record */
  uint64_t sequence;          /* records offered before this one, lost ones too */
  uint64_t lost;              /* of them lost */
  uint64_t cycle;
  int64_t now_us;
  uint32_t flags;             /* BERM_JOURNAL_CLOCK_FAULT, BERM_JOURNAL_APP_CONNECTED */
  uint32_t app_connections;
  uint16_t frames_in;
  uint16_t frames_out;
  uint16_t scan_packets;
  uint16_t vlp16_packets;
  uint16_t lidar_packets;     /* of the lidars on the upper body */
  uint16_t reserved[3];
  uint64_t map_row_hash;      /* of row cycle % 104 of the height map after the cycle: JOURNAL.md */
  uint8_t request[64];        /* the private copy */
  berm_state state;           /* cycle_cpu_us is zero here */
  berm_decision decision;
} berm_journal_cycle;

typedef struct berm_journal_frame {
  uint32_t id;
  uint8_t length;
  uint8_t data[8];
  uint8_t reserved[3];
} berm_journal_frame;

/* A decoded scan datagram (SCAN.md); behind it count times echoes_per_sample ranges of 16 bits. */
typedef struct berm_journal_scan {
  uint64_t time_us;
  uint32_t sequence;
  uint32_t scanline;
  uint32_t sample_period_ns;
  int32_t pan_start_urad;
  int32_t pan_end_urad;
  uint16_t flags;
  uint16_t first_index;
  uint16_t samples_per_revolution;
  uint16_t count;
  uint8_t scanner;
  uint8_t echoes_per_sample;
  uint8_t window_percent;
  uint8_t reserved;
} berm_journal_scan;

BERM_STATIC_ASSERT(sizeof(berm_journal_start) == 24 + 32 + (sizeof(berm_parameters) + 7) / 8 * 8, "start layout");
BERM_STATIC_ASSERT(sizeof(berm_journal_ring) == 48 + sizeof(berm_journal_start), "ring header layout");
BERM_STATIC_ASSERT(sizeof(berm_journal_tail) == 64, "tail layout");
BERM_STATIC_ASSERT(sizeof(berm_journal_cycle) == 136 + sizeof(berm_state) + sizeof(berm_decision), "cycle record layout");
BERM_STATIC_ASSERT(sizeof(berm_journal_frame) == 16 && sizeof(berm_journal_scan) == 40, "parts of a record");
BERM_STATIC_ASSERT(sizeof(berm_journal_cycle) % 8 == 0, "records keep to 8 bytes");

#ifdef __cplusplus
}
#endif
#endif
