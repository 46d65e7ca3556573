/* The parameter block: what the machine and site files compile to, and all the kernel knows of machine and site.
 *
 * C11 and C++17. A file of exactly sizeof(berm_parameters) bytes, little endian, int32 fields only (no padding), CRC-32 (IEEE) over
 * all bytes before crc32. Units in the names. Link frames: x along the pin line from the link's near pin, z to the left of x
 * seen from the right-hand side of the machine (so +z is up when the link points forward and level). Normative text: CONFIG.md.
 */
#ifndef BERM_PARAMETER_BLOCK_H
#define BERM_PARAMETER_BLOCK_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BERM_PARAMETERS_MAGIC 0x42504152 /* "RAPB" */
#define BERM_PARAMETERS_VERSION 1
#define BERM_PARTS 5            /* convex prisms that cover the implements with the heaviest payload */
#define BERM_PART_VERTICES 8
#define BERM_BRAKE_SPEEDS 8     /* table columns: speeds k * velocity_max / (BERM_BRAKE_SPEEDS - 1) */
#define BERM_BRAKE_REACHES 4    /* table rows: reach up to brake_reach_mm[r] */
#define BERM_DIG_ZONES 4
#define BERM_GROUND_ZONES 4
#define BERM_TRUCK_ZONES 4
#define BERM_SCANNER_MOUNTS 2
#define BERM_LANES 4
#define BERM_LIDARS 4           /* VLP-16 on the upper body */

enum { BERM_SEPARATION_NONE = 0, BERM_SEPARATION_REPORTED = 1, BERM_SEPARATION_ENFORCED = 2 };

typedef struct berm_part {
  int32_t link;                                   /* 1 boom, 2 stick, 3 bucket */
  int32_t half_width_mm;                          /* lateral, about the swing plane */
  int32_t vertices;                               /* 3..BERM_PART_VERTICES used */
  int32_t vertex_mm[BERM_PART_VERTICES][2];       /* x, z in the link's frame; convex, counter-clockwise (x towards z) */
} berm_part;

typedef struct berm_scanner_mount {               /* head in the upper body's frame */
  int32_t x_mm, y_mm, z_mm;
  int32_t pan_low_urad, pan_high_urad;            /* pan limits */
  int32_t pan_rate_max_urad_s;
} berm_scanner_mount;

typedef struct berm_lidar_mount {                 /* sensor's frame in the upper body's: turned by yaw, then pitch (front down), then roll (left up) */
  int32_t x_mm, y_mm, z_mm;
  int32_t roll_urad, pitch_urad, yaw_urad;
} berm_lidar_mount;

typedef struct berm_dig_zone { int32_t x_low_mm, y_low_mm, x_high_mm, y_high_mm, floor_mm, ceiling_mm; } berm_dig_zone; /* base frame */
typedef struct berm_ground_zone { int32_t x_low_mm, y_low_mm, x_high_mm, y_high_mm, pass_over_mm; } berm_ground_zone; /* lower ground; base frame */
typedef struct berm_truck_zone { int32_t x_low_mm, y_low_mm, x_high_mm, y_high_mm, ceiling_mm; } berm_truck_zone;     /* base frame */

typedef struct berm_lane { int32_t x_low_mm, y_low_mm, x_high_mm, y_high_mm; } berm_lane; /* base frame */

typedef struct berm_parameters {
  int32_t magic, version, size, cell_mm;
  /* kinematics: joint 0 swing about z at the origin; boom pin at (boom_pin_x, 0, boom_pin_z) in the upper body's frame */
  int32_t boom_pin_x_mm, boom_pin_z_mm, boom_length_mm, stick_length_mm, bucket_length_mm;
  int32_t own_body_radius_mm;                     /* cells nearer the swing axis are the machine's own; only the boom may be over them */
  int32_t joint_low_urad[4], joint_high_urad[4];  /* permitted range; swing too (+-2 pi at most) */
  int32_t velocity_max_urad_s[4];
  int32_t acceleration_max_urad_s2[4];            /* largest the machine can do, either direction */
  int32_t creep_velocity_urad_s[4];               /* recovery motion: see SK requirements */
  int32_t angle_error_urad[4], velocity_error_urad_s[4];
  int32_t state_latency_us;                       /* age of a state frame when a cycle takes it, at most */
  int32_t command_latency_us;                     /* from sending a command to the joint obeying it, at most */
  /* braking table: angle from obeying the stop to standstill, worst case for speeds and reaches up to the entry, heaviest payload */
  int32_t brake_reach_mm[BERM_BRAKE_REACHES];
  int32_t brake_angle_urad[4][BERM_BRAKE_REACHES][BERM_BRAKE_SPEEDS];
  int32_t brake_time_us[4][BERM_BRAKE_REACHES][BERM_BRAKE_SPEEDS];
  int32_t parts;
  berm_part part[BERM_PARTS];
  /* sensors */
  berm_scanner_mount scanner[BERM_SCANNER_MOUNTS];
  int32_t scanner_silent_us;                      /* a scanner silent for longer is a fault */
  int32_t spurious_range_mm;                      /* a single return that differs by more from both neighbours is dropped */
  int32_t range_min_mm, range_max_mm;
  int32_t self_margin_mm;                         /* returns nearer to the own implements are taken for them */
  /* map and clearance */
  int32_t margin_mm;                              /* added to every column: calibration and range noise */
  int32_t fresh_us;                               /* a cell observed longer ago is stale */
  int32_t generation_us;                          /* a new sweep of a cell begins when the last began longer ago */
  int32_t dig_swing_limit_urad_s;                 /* contact in the dig zone only below this swing speed */
  int32_t dig_zones;
  berm_dig_zone dig_zone[BERM_DIG_ZONES];
  /* overpass rule: see core/overpass.h */
  int32_t pass_over_mm;                           /* base frame: what stands higher is passed beside, never over */
  int32_t ground_zones;
  berm_ground_zone ground_zone[BERM_GROUND_ZONES]; /* where the ground lies lower: the limit of the cells that it meets */
  int32_t truck_zones;
  berm_truck_zone truck_zone[BERM_TRUCK_ZONES];    /* while a truck is admitted: what is wholly inside and no higher may be passed over */
  /* requests and frames */
  int32_t request_age_us, request_hold_us, request_silent_us; /* 50 000 hold, 500 000 latched stop */
  int32_t state_frame_age_us, machine_state_age_us, operator_age_us;
  int32_t cycle_us;
  int32_t standstill_urad_s, standstill_us;       /* 0.5 deg/s for 200 ms */
  /* motion of the base: see core/base_motion.h */
  int32_t base_tilt_urad;                         /* roll or pitch farther from the map's own than this, for most of 300 ms: the base has moved */
  int32_t base_tilt_hard_urad;                    /* farther than this in one frame: it has moved */
  int32_t base_azimuth_urad;                      /* the same for the azimuth of the tracks, for most of 300 ms */
  int32_t base_frame_age_us;                      /* no Roll_Pitch or Vehicle_Azimuth for longer: fault */
  /* the upper body's tail: see safety_kernel/requirements/tail.md */
  int32_t tail_watched;                           /* 1: a sensor sees the ground round the tail, the kernel checks it; 0: nobody does */
  int32_t tail_radius_mm;                         /* from the swing axis to the tail's farthest point */
  int32_t tail_half_width_mm;                     /* about the swing plane */
  int32_t tail_low_mm, tail_high_mm;              /* underside and top above the ground */
  int32_t tail_clearance_mm;                      /* how far beyond the tail's sides, and behind beyond the own body, must be seen to be free */
  int32_t tail_fresh_us;                          /* a cell round the tail observed longer ago is stale */
  int32_t lidars;
  berm_lidar_mount lidar[BERM_LIDARS];
  /* Workspace Monitor: see safety_kernel/requirements/workspace_monitor.md */
  int32_t workspace_watched;                      /* 1: what rises in the safety region stops the machine; 0: nobody watches it */
  int32_t workspace_radius_mm;                    /* of the safety region, about the swing axis */
  int32_t workspace_rise_mm;                      /* a rise by more is a change */
  int32_t workspace_neighbour_mm;                 /* a neighbour less than this below what is new explains a rise */
  int32_t workspace_slope_mm;                     /* a neighbour higher by more than this explains it too: an edge */
  int32_t workspace_wait_us;                      /* a cell that gets data without end is judged when it is so old */
  int32_t workspace_period_us;                    /* between comparisons */
  int32_t workspace_dwell_us;                     /* the region is clear for so long before the machine may go on */
  int32_t workspace_learn_us;                     /* the ground is learned for so long from the begin, a lane's from when a truck has parked */
  int32_t workspace_learn_speed_permille;         /* of each joint's largest speed, while it is learned; while a lane is, near that */
  int32_t workspace_foreign;                      /* so many voxels of free space with something in them are an intruder; 0: free space is not kept */
  int32_t workspace_lidar_wait_us;                /* the same two of what a lidar on the upper body sees: it sees all round, ten times a second */
  int32_t workspace_lidar_period_us;
  int32_t workspace_follows;                      /* 1: the map that is compared with follows what is seen; 0: it stays as it was first seen */
  int32_t workspace_histogram;                    /* 1: what is seen is compared with a histogram of heights per cell; 0: with one height */
  /* ISO 13855's minimum distance: see safety_kernel/requirements/separation.md */
  int32_t workspace_separation;                   /* BERM_SEPARATION_* */
  int32_t workspace_approach_mm_s;                /* K: speed at which somebody approaches */
  int32_t workspace_intrusion_mm;                 /* C: what of him may reach ahead before he is detected */
  int32_t lanes;
  berm_lane lane[BERM_LANES];                     /* where trucks come and go: not watched unless one is parked */
  /* what the sensors can see: see safety_kernel/requirements/sight.md */
  int32_t sight_blind_permille;                   /* a strip of a sensor of whose rays so many are blind is blocked: fault */
  int32_t dust_slow_permille;                     /* so many returns with more than one echo: motion is slowed */
  int32_t dust_stop_permille;                     /* so many: motion is held */
  int32_t dust_speed_permille;                    /* of each joint's largest speed, while slowed */
  int32_t dust_dwell_us;                          /* below the limit for so long before it is lifted */
  int32_t crc32;                                  /* bit pattern of the CRC-32 */
} berm_parameters;

#ifdef __cplusplus
}
#endif
#endif
