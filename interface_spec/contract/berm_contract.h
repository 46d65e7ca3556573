/* The contract between the safety kernel and the planning app: the layout of both shared-memory segments.
 *
 * C11 and C++17. Little endian, x86-64 and AArch64. Every field is fixed width and naturally aligned; there is
 * no implicit padding (asserted below). Normative text: CONTRACT.md. Units are in the names: urad, us, mm.
 * Joint order everywhere: swing, boom, stick, bucket. Scanner order: left, right.
 *
 * REQUEST segment: created and sealed against resizing by the kernel, written by the app, read by the kernel.
 * STATE segment: created by the kernel, sealed with F_SEAL_FUTURE_WRITE, mapped read-only by app and recorder.
 */
#ifndef BERM_CONTRACT_H
#define BERM_CONTRACT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#define BERM_STATIC_ASSERT(cond, text) static_assert(cond, text)
#else
#define BERM_STATIC_ASSERT(cond, text) _Static_assert(cond, text)
#endif

#define BERM_CONTRACT_MAGIC 0x4D524542u /* "BERM" */
#define BERM_CONTRACT_VERSION 2u

#define BERM_JOINTS 4
#define BERM_CYLINDERS 3 /* boom, stick, bucket */
#define BERM_SCANNERS 2
#define BERM_MAP_CELLS 104           /* cells along one side of the published map */
#define BERM_SCAN_RING 64            /* scan blocks kept */
#define BERM_SCAN_BLOCK_SAMPLES 120  /* most samples in one block */
#define BERM_DECISION_RING 256       /* decisions kept, one a cycle */
#define BERM_SLICE_SNAPSHOT 96       /* slices of the swept volume shown to observers */
#define BERM_SLICE_VERTICES 24

enum { BERM_SWING = 0, BERM_BOOM = 1, BERM_STICK = 2, BERM_BUCKET = 3 };

/* The work phase the app believes it is in. It can only make the kernel stricter. */
enum {
  BERM_PHASE_IDLE = 0,
  BERM_PHASE_DIG = 1,
  BERM_PHASE_LIFT = 2,
  BERM_PHASE_SWING_TO_TRUCK = 3,
  BERM_PHASE_DUMP = 4,
  BERM_PHASE_SWING_TO_DIG = 5,
  BERM_PHASE_WAIT = 6,
  BERM_PHASE_COUNT = 7
};

/* Kernel states (DESIGN: INIT, STANDBY, RUN, STOPPING, STOPPED, FAULT). Far-apart codes live in the core; these are for readers. */
enum {
  BERM_STATE_INIT = 0,
  BERM_STATE_STANDBY = 1,
  BERM_STATE_RUN = 2,
  BERM_STATE_STOPPING = 3,
  BERM_STATE_STOPPED = 4,
  BERM_STATE_FAULT = 5,
  BERM_STATE_COUNT = 6
};

/* Why the machine may not move, or stopped. Several can hold; the first that struck is reported. */
enum {
  BERM_STOP_NONE = 0,
  BERM_STOP_COLLISION_PREDICTED = 1, /* the reach box meets a known obstacle */
  BERM_STOP_UNKNOWN_GROUND = 2,      /* the reach box covers a cell never observed or out of the map */
  BERM_STOP_STALE_GROUND = 3,        /* ... observed too long ago */
  BERM_STOP_DIG_FLOOR = 4,           /* the bucket would pass below the dig zone's floor */
  BERM_STOP_REQUEST_HOLD = 5,        /* no usable request for 50 ms: hold */
  BERM_STOP_APP_SILENT = 6,          /* no usable request for 500 ms: latched */
  BERM_STOP_STATE_FRAME = 7,         /* machine state frames bad, missing or late: fault */
  BERM_STOP_SCANNER_SILENT = 8,      /* a scanner sent nothing usable for too long: fault */
  BERM_STOP_OPERATOR = 9,            /* operator stop: latched */
  BERM_STOP_EMERGENCY = 10,          /* e-stop receiver: latched, category 0 */
  BERM_STOP_JOINT_RANGE = 11,        /* the reach box leaves a joint's permitted range */
  BERM_STOP_BRAKING = 12,            /* the machine does not slow as its table says: fault, category 0 */
  BERM_STOP_MACHINE_FAULT = 13,      /* the machine reports an error of its own: fault */
  BERM_STOP_INTERNAL = 14,           /* a check of the kernel on itself failed: fault */
  BERM_STOP_CLOCK = 15,              /* the cycle came too late or time ran backwards: fault */
  BERM_STOP_BASE_MOVED = 16,         /* the machine's base tilted or slipped, so that the map no longer fits: latched */
  BERM_STOP_UNCOMMANDED = 17,        /* a joint moves otherwise than it was ever told to: fault, category 0 */
  BERM_STOP_OVERPASS = 18,           /* the reach box passes over what is too high to be passed over: a person or a vehicle may stand there */
  BERM_STOP_TAIL = 19,               /* the upper body's tail would swing into what stands there: latched */
  BERM_STOP_INTRUDER = 20,           /* something moved into the safety region, and has not left it long enough */
  BERM_STOP_SEPARATION = 21,         /* the distance of ISO 13855 is not kept: who comes into the safety region would be told of too late */
  BERM_STOP_SENSOR_BLOCKED = 22,     /* something lies on a sensor's window, all of it or a strip: fault */
  BERM_STOP_DUST = 23,               /* so much dust that the sensors cannot be relied on */
  BERM_STOP_REASONS = 24
};

/* Whether a reason is a cell of the map's: then the blocked_* fields say which. */
#define BERM_STOP_HAS_CELL(reason) (((reason) >= BERM_STOP_COLLISION_PREDICTED && (reason) <= BERM_STOP_DIG_FLOOR) || (reason) == BERM_STOP_OVERPASS || \
                                     (reason) == BERM_STOP_TAIL || (reason) == BERM_STOP_INTRUDER)

/* Result of the check of the newest request. */
enum {
  BERM_REQUEST_ACCEPTED = 0,
  BERM_REQUEST_NONE = 1,       /* nothing new since the last cycle */
  BERM_REQUEST_MAGIC = 2,
  BERM_REQUEST_VERSION = 3,
  BERM_REQUEST_CRC = 4,
  BERM_REQUEST_SEQUENCE = 5,
  BERM_REQUEST_AGE = 6,
  BERM_REQUEST_RANGE = 7,
  BERM_REQUEST_RESULTS = 8
};

#define BERM_REQUEST_FLAG_HORN 1u /* sound the horn: the truck is full */

/* One motion request. 64 bytes; the CRC-32 (IEEE 802.3, reflected) covers bytes 0 to 59. */
typedef struct berm_request {
  uint32_t magic;                              /* BERM_CONTRACT_MAGIC */
  uint16_t version;                            /* BERM_CONTRACT_VERSION */
  uint16_t phase;                              /* BERM_PHASE_*, below BERM_PHASE_COUNT */
  uint32_t sequence;                           /* one more than in the request before, wrapping */
  uint32_t flags;                              /* BERM_REQUEST_FLAG_*; other bits zero */
  int64_t stamp_us;                            /* time_us of the state this answers; 0..age limit old */
  int32_t joint_velocity_urad_s[BERM_JOINTS];  /* within the parameter block's velocity limits */
  int32_t pan_goal_urad[BERM_SCANNERS];        /* pan relative to the upper body, positive left, within the pan limits */
  int32_t pan_rate_urad_s[BERM_SCANNERS];      /* 0..pan rate limit */
  uint32_t reserved_tail;                      /* zero */
  uint32_t crc32;
} berm_request;

/* The request segment. guard is a sequence lock: odd while the app writes. The kernel copies once and lets the CRC decide. */
typedef struct berm_request_segment {
  uint32_t guard;
  uint32_t reserved[15];
  berm_request request;
} berm_request_segment;

#define BERM_PANEL_OPERATOR_RUN 1u
#define BERM_PANEL_TRUCK_PARKED 2u  /* the spotter: a truck stands ready to be loaded */
#define BERM_PANEL_TRUCK_LEAVING 4u
#define BERM_PANEL_RELEASE_AWAITED 8u /* in STANDBY: RUN does not begin before the run switch was switched off once; the kernel's, of no frame */
#define BERM_UNWATCHED_TAIL 1u      /* the ground round the upper body's tail: it must be fenced */
#define BERM_UNWATCHED_WORKSPACE 2u /* the safety region: nobody may come into it */

#define BERM_SIGHT_BLOCKED(eye) (1u << (eye)) /* an eye cannot see, or a strip of it: 0, 1 the scanners, 2 to 5 the lidars on the upper body */
#define BERM_SIGHT_EYES 6
#define BERM_SIGHT_DUST_SLOW 0x100u /* dust: every joint's request is cut to a share of its largest speed */
#define BERM_SIGHT_DUST_STOP 0x200u /* dust: motion is held */
#define BERM_SIGHT_LEARNS 0x400u    /* the Workspace Monitor learns the ground, who comes may go unseen: every request is cut to a share of the largest speeds */
#define BERM_SIGHT_LEARNS_LANE 0x800u /* it learns the lane of a truck that has parked: requests that come near it are */

/* Machine state and verdict of one cycle. */
typedef struct berm_state {
  uint64_t cycle;                                    /* cycles since start */
  int64_t time_us;                                   /* kernel time */
  int32_t joint_angle_urad[BERM_JOINTS];             /* measured */
  int32_t joint_velocity_urad_s[BERM_JOINTS];        /* measured */
  int32_t pan_angle_urad[BERM_SCANNERS];             /* newest from the scan packets */
  int32_t payload_kg;                                /* on-board weighing; -1 unknown; not trusted */
  int32_t cylinder_kpa[BERM_CYLINDERS][2];           /* boom, stick, bucket: pressure in bottom and rod side; not trusted */
  uint32_t request_sequence;                         /* of the newest accepted request */
  uint8_t request_result;                            /* BERM_REQUEST_* of this cycle */
  uint8_t kernel_state;                              /* BERM_STATE_* */
  uint8_t stop_reason;                               /* BERM_STOP_* now in force, BERM_STOP_NONE in RUN */
  uint8_t stop_category;                             /* 0 or 1 while stopping or stopped, 2 while merely held, 255 in RUN */
  int32_t commanded_urad_s[BERM_JOINTS];             /* what was sent to the machine */
  int32_t permitted_low_urad_s[BERM_JOINTS];         /* where the request was cut: what of it goes out; else the largest speeds; zero when held */
  int32_t permitted_high_urad_s[BERM_JOINTS];
  int32_t reach_low_urad[BERM_JOINTS];               /* reach box of this cycle */
  int32_t reach_high_urad[BERM_JOINTS];
  int32_t blocked_x_mm;                              /* centre of the first blocking cell, when BERM_STOP_HAS_CELL(stop_reason) */
  int32_t blocked_y_mm;
  int32_t blocked_height_mm;
  uint32_t blocked_link;                             /* joint index of the link that would meet it; 0: the upper body's tail; BERM_JOINTS: none, it is an intruder */
  uint32_t stop_count[BERM_STOP_REASONS];            /* stops since start, by reason */
  uint32_t cycle_cpu_us;                             /* CPU time of the previous cycle (not in journals: it is not reproducible) */
  uint32_t panel;                                    /* BERM_PANEL_*: newest operator and spotter frames; not trusted */
  uint32_t journal_lost;                             /* records that the journal lost before this cycle; stays at 2^32 - 1 */
  uint32_t terrain_confirmed_ms;                     /* since the scanned terrain last excluded a slip of the base; 2^32 - 1: not since the map was begun */
  uint32_t unwatched;                                /* BERM_UNWATCHED_*: what the kernel does not check, for no sensor sees it */
  int16_t separation_bearing_deg;                    /* base frame, from x to y: where the distance of ISO 13855 leaves the least; -1: not evaluated */
  int16_t separation_stop_ms;                        /* the most stopping time that keeps it there; -1: none */
  int32_t dust_permille;                             /* of the dustiest sensor: returns with a second echo in front of the last */
  uint32_t sight;                                    /* BERM_SIGHT_* */
  uint32_t reserved;
} berm_state;

/* A block of consecutive samples of one scanline, as received. Range 0 means no return. */
typedef struct berm_scan_block {
  uint32_t sequence;        /* 2n+1 while block n is written, 2n+2 when complete */
  uint8_t scanner;          /* 0 left, 1 right */
  uint8_t reserved;
  uint16_t count;           /* samples in this block */
  uint32_t scanline;        /* number of the scanline */
  uint32_t sample_period_ns;
  int64_t time_us;          /* time of the first sample */
  int32_t pan_start_urad;   /* pan at first and last sample */
  int32_t pan_end_urad;
  uint16_t first_index;     /* place of the first sample on the mirror's circle */
  uint16_t samples_per_revolution;
  uint32_t reserved_tail;
  uint32_t range_mm[BERM_SCAN_BLOCK_SAMPLES];     /* last echo */
  uint8_t echoes[BERM_SCAN_BLOCK_SAMPLES];        /* number of echoes, 0..3 */
  int32_t point_mm[BERM_SCAN_BLOCK_SAMPLES][3];   /* base frame, as the kernel projected it */
  uint8_t used[BERM_SCAN_BLOCK_SAMPLES];          /* 1 went into the map, 0 dropped (own machine, spurious, no return) */
} berm_scan_block;

/* One decision of the kernel, for the journal. Only reproducible quantities. */
typedef struct berm_decision {
  uint64_t cycle;
  int64_t time_us;
  int32_t joint_angle_urad[BERM_JOINTS];
  int32_t joint_velocity_urad_s[BERM_JOINTS];
  int32_t requested_urad_s[BERM_JOINTS];
  int32_t commanded_urad_s[BERM_JOINTS];
  int32_t permitted_low_urad_s[BERM_JOINTS];
  int32_t permitted_high_urad_s[BERM_JOINTS];
  int32_t reach_low_urad[BERM_JOINTS];
  int32_t reach_high_urad[BERM_JOINTS];
  uint32_t request_sequence;
  uint8_t request_result;
  uint8_t kernel_state;
  uint8_t stop_reason;
  uint8_t stop_category;
  uint16_t phase;
  uint16_t slices;             /* slices checked */
  uint32_t cells;              /* cells checked */
  int32_t blocked_x_mm;
  int32_t blocked_y_mm;
  int32_t blocked_height_mm;
  uint32_t scan_points;        /* points that went into the map */
} berm_decision;

enum { BERM_CELL_UNKNOWN = 0, BERM_CELL_OBSERVED = 1, BERM_CELL_STALE = 2, BERM_CELL_OWN_BODY = 3 };

typedef struct berm_slice {
  uint32_t link;       /* joint index of the link */
  uint32_t vertices;
  int32_t vertex_mm[BERM_SLICE_VERTICES][3];
} berm_slice;

/* The state segment. */
typedef struct berm_state_segment {
  uint32_t magic;
  uint32_t version;
  uint32_t size;                 /* sizeof(berm_state_segment) */
  uint32_t cell_mm;              /* edge of a map cell */
  int32_t map_origin_mm;         /* x and y of the map's low corner */
  uint32_t parameter_crc32;      /* of the block in force */
  uint32_t wake;                 /* futex word: one more every cycle */
  uint32_t scan_head;            /* blocks written so far; newest is (scan_head - 1) % BERM_SCAN_RING */
  uint32_t decision_head;        /* decisions written so far */
  uint32_t state_guard;          /* sequence lock of state: odd while the kernel writes */
  uint32_t slice_guard;          /* sequence lock of the slice snapshot */
  uint32_t slice_count;          /* slices in the snapshot, of the newest reach box */
  uint32_t kernel_pid;
  uint32_t reserved[3];
  berm_state state;
  berm_decision decision[BERM_DECISION_RING];
  berm_scan_block scan[BERM_SCAN_RING];
  berm_slice slice[BERM_SLICE_SNAPSHOT];
  int32_t map_height_mm[BERM_MAP_CELLS][BERM_MAP_CELLS]; /* [iy][ix]; refreshed a few rows a cycle */
  uint8_t map_status[BERM_MAP_CELLS][BERM_MAP_CELLS];    /* BERM_CELL_* */
} berm_state_segment;

BERM_STATIC_ASSERT(sizeof(berm_request) == 64, "request layout");
BERM_STATIC_ASSERT(offsetof(berm_request, crc32) == sizeof(berm_request) - 4, "the CRC is the last field");
BERM_STATIC_ASSERT(sizeof(berm_request_segment) == 128, "request segment layout");
BERM_STATIC_ASSERT(sizeof(berm_state) == 320, "state layout");
BERM_STATIC_ASSERT(sizeof(berm_scan_block) == 40 + BERM_SCAN_BLOCK_SAMPLES * 18, "scan block layout");
BERM_STATIC_ASSERT(sizeof(berm_decision) == 176, "decision layout");
BERM_STATIC_ASSERT(sizeof(berm_slice) == 8 + BERM_SLICE_VERTICES * 12, "slice layout");
BERM_STATIC_ASSERT(sizeof(berm_state_segment) == 64 + sizeof(berm_state) + BERM_DECISION_RING * sizeof(berm_decision) +
                   BERM_SCAN_RING * sizeof(berm_scan_block) + BERM_SLICE_SNAPSHOT * sizeof(berm_slice) + BERM_MAP_CELLS * BERM_MAP_CELLS * 5,
                   "state segment layout");

/* The greeting on the Unix socket (SOCK_SEQPACKET): the peer sends one byte, its role; the kernel checks the peer's uid and
 * answers with one berm_welcome and the file descriptors (SCM_RIGHTS). App: state segment, request segment. Recorder: state segment.
 * Journal's writer: ring and tail segment (journal/journal_record.h), their sizes in state_size and request_size. */
#define BERM_ROLE_APP 0x41
#define BERM_ROLE_RECORDER 0x52
#define BERM_ROLE_JOURNAL 0x4A
typedef struct berm_welcome {
  uint32_t magic;
  uint32_t version;
  uint32_t accepted;      /* 1, or 0 with a reason */
  uint32_t state_size;
  uint32_t request_size;
  char reason[108];
} berm_welcome;
BERM_STATIC_ASSERT(sizeof(berm_welcome) == 128, "welcome layout");

#ifdef __cplusplus
}
#endif
#endif
