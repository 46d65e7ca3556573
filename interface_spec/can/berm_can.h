/* CAN identifiers, messages and codec of berm.dbc. C11 and C++17. Normative text: CAN.md.
 *
 * Machine frames follow the Hitachi ZX200 automation interface: 29-bit ids in J1939 shape, 8 bytes, little endian, unsigned
 * with offset. Frames that matter are preceded by a guard frame (data id, counter, CRC-32), after the pattern of SAE J1939-76.
 * Physical values here are integers: urad, urad/s, kPa, kg; encoding rounds to the nearest raw step and saturates at the field.
 */
#ifndef BERM_CAN_H
#define BERM_CAN_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* machine -> kernel */
#define BERM_CAN_FRONT_ANGLE 0x18FF7DE8u            /* 10 ms, guarded */
#define BERM_CAN_FRONT_ANGULAR_VELOCITY 0x18FF78E8u /* 10 ms, guarded */
#define BERM_CAN_PRESSURE_1 0x18FF79E8u             /* 10 ms */
#define BERM_CAN_ROLL_PITCH 0x18FF7EE8u             /* 20 ms */
#define BERM_CAN_MACHINE_STATE 0x18FF84E8u          /* 50 ms, guarded */
#define BERM_CAN_VEHICLE_AZIMUTH 0x18FF96E8u        /* 100 ms */
#define BERM_CAN_PAYLOAD 0x18FFB0E8u                /* 100 ms, Berm's own: on-board weighing */
#define BERM_CAN_ESTOP_STATUS 0x18FFB1E8u           /* 50 ms, guarded, Berm's own */
/* operator panel -> kernel */
#define BERM_CAN_OPERATOR 0x18FFB20Cu               /* 50 ms, guarded */
#define BERM_CAN_SPOTTER 0x18FFB30Du                /* 50 ms, guarded */
/* kernel -> machine */
#define BERM_CAN_VELOCITY_CMD_1 0x18FF670Au         /* 10 ms, guarded */
#define BERM_CAN_MACHINE_SETTING_CMD 0x18FF660Au    /* 50 ms, guarded */
#define BERM_CAN_HEARTBEAT 0x18FFA10Au              /* 10 ms, guarded, Berm's own */
#define BERM_CAN_SCANNER_PAN_CMD 0x18FFA20Au        /* 10 ms a scanner, Berm's own */
/* guard frames: same source address as what they guard */
#define BERM_CAN_GUARD_MACHINE 0x18FFA0E8u
#define BERM_CAN_GUARD_KERNEL 0x18FFA00Au
#define BERM_CAN_GUARD_OPERATOR 0x18FFA00Cu
#define BERM_CAN_GUARD_SPOTTER 0x18FFA00Du
/* simulation only: the virtual clock of lockstep runs; ignored unless the kernel was started with --lockstep */
#define BERM_CAN_SIMULATION_CLOCK 0x18FFE0FEu

/* The machine obeys what it was told last until it has heard no heartbeat for so long (IF-CAN-14); then it brakes by itself. */
#define BERM_CAN_SILENCE_US 50000
/* The kernel sends within this of its cycle's start, or nothing in that cycle (IF-CAN-22). */
#define BERM_CAN_SEND_LATE_US 5000

/* The data id of a guarded message: its PDU specific byte (bits 8 to 15 of the id), unique in this network. */
#define BERM_CAN_DATA_ID(can_id) ((uint8_t)(((can_id) >> 8) & 0xFFu))

typedef struct berm_can_frame { uint32_t id; uint8_t length; uint8_t data[8]; } berm_can_frame;

/* Order of the four fields in the frames is boom, stick, bucket, swing; arrays here are in Berm's joint order. */
typedef struct berm_front_angle { int32_t angle_urad[4]; } berm_front_angle;               /* LSB 400 urad, -10 rad */
typedef struct berm_front_velocity { int32_t velocity_urad_s[4]; } berm_front_velocity;    /* LSB 200 urad/s, -5 rad/s */
typedef struct berm_velocity_cmd { int32_t velocity_urad_s[4]; } berm_velocity_cmd;        /* LSB 500 urad/s, -16 rad/s; neutral raw 0x7D00 */
typedef struct berm_pressure { int32_t kpa[8]; } berm_pressure;                            /* boom bottom/rod, stick b/r, bucket b/r, swing a/b; LSB 200 kPa, -10 MPa */
typedef struct berm_roll_pitch { int32_t roll_urad; int32_t pitch_urad; } berm_roll_pitch; /* 14 bits each, LSB 500 urad, -4 rad */
typedef struct berm_machine_state {
  bool lock_command;          /* bit 0 */
  bool pilot_unlocked;        /* bit 6: pilot shut-off valve, 1 unlocked */
  bool system_error;          /* bit 8 */
  uint8_t can_errors;         /* bits 9, 10, 11 */
  bool lock_receiver_error;   /* bit 12 */
  bool estop_receiver_error;  /* bit 13 */
  bool switch_error;          /* bit 14 */
  uint8_t control_state;      /* 16/8 */
  int16_t oil_temperature_c;  /* 24/8, offset -100 */
  bool engine_on;             /* bit 40 */
  uint8_t alive_counter;      /* 56/8 */
} berm_machine_state;
typedef struct berm_vehicle_azimuth { int32_t upper_urad; int32_t track_urad; } berm_vehicle_azimuth; /* LSB 400 urad, -10 rad */
typedef struct berm_payload { uint16_t kg; bool valid; } berm_payload;                     /* kg 0/16, valid 16/1 */
typedef struct berm_estop { bool pressed; bool receiver_ok; uint8_t alive_counter; } berm_estop; /* 0/1, 1/1, 56/8 */
typedef struct berm_operator { bool run; bool stop; bool reset; bool relearn; uint8_t alive_counter; } berm_operator; /* bits 0..3, 56/8 */
typedef struct berm_spotter { bool truck_parked; bool truck_leaving; bool stop; uint8_t alive_counter; } berm_spotter; /* bits 0..2, 56/8 */
typedef struct berm_machine_setting {
  uint8_t engine_rpm_x10; bool eco; bool fast_travel; bool working_notice; uint8_t led; bool horn;
  uint8_t front_signal;       /* 28/4: 0 none, 1 effort, 2 velocity */
  uint8_t alive_counter;      /* 56/8 */
} berm_machine_setting;       /* rpm 0/8, eco 8/1, travel 9/2, notice 11/1, LED 12/2, horn 14/2, travel switch 24/4, front switch 28/4 */
/* The machine moves only while it hears this, guarded, with enable set. */
typedef struct berm_heartbeat {
  bool enable;                /* 0/1 */
  uint8_t stop_category;      /* 8/8: 0 power removed at once, 1 brake then power removed, 2 hold, 255 none */
  uint8_t kernel_state;       /* 16/8: BERM_STATE_* */
  uint8_t stop_reason;        /* 24/8: BERM_STOP_* */
  uint16_t cycle;             /* 32/16: low bits of the cycle count */
  uint8_t alive_counter;      /* 56/8 */
} berm_heartbeat;
typedef struct berm_pan_cmd { uint8_t scanner; int32_t goal_urad; int32_t rate_urad_s; } berm_pan_cmd; /* scanner 0/8, goal 16/16 LSB 400 urad -10 rad, rate 32/16 LSB 500 urad/s 0 */
typedef struct berm_sim_clock { uint32_t cycle; uint32_t scan_packets; } berm_sim_clock;   /* 0/32, 32/32: packets sent so far, all scan ports */
typedef struct berm_guard { uint8_t data_id; uint8_t counter; uint32_t crc32; } berm_guard; /* 0/8, 8/8, 32/32; bits 16..31 are ones */

/* CRC-32 (IEEE) over the guarded frame's id (4 bytes, little endian), the guard's counter and the eight data bytes. */
uint32_t berm_can_guard_crc(uint32_t can_id, uint8_t counter, const uint8_t data[8]);
/* Guard id for a guarded message: same source address. */
uint32_t berm_can_guard_id(uint32_t can_id);
berm_can_frame berm_can_make_guard(const berm_can_frame *guarded, uint8_t counter);

/* Encoders give a complete frame; decoders return false (and change nothing) when id or length is not theirs; that of the guard also when bits
 * 16..31 are not ones. */
berm_can_frame berm_encode_front_angle(const berm_front_angle *m);
bool berm_decode_front_angle(const berm_can_frame *f, berm_front_angle *m);
berm_can_frame berm_encode_front_velocity(const berm_front_velocity *m);
bool berm_decode_front_velocity(const berm_can_frame *f, berm_front_velocity *m);
berm_can_frame berm_encode_velocity_cmd(const berm_velocity_cmd *m);
bool berm_decode_velocity_cmd(const berm_can_frame *f, berm_velocity_cmd *m);
berm_can_frame berm_encode_pressure(const berm_pressure *m);
bool berm_decode_pressure(const berm_can_frame *f, berm_pressure *m);
berm_can_frame berm_encode_roll_pitch(const berm_roll_pitch *m);
bool berm_decode_roll_pitch(const berm_can_frame *f, berm_roll_pitch *m);
berm_can_frame berm_encode_machine_state(const berm_machine_state *m);
bool berm_decode_machine_state(const berm_can_frame *f, berm_machine_state *m);
berm_can_frame berm_encode_vehicle_azimuth(const berm_vehicle_azimuth *m);
bool berm_decode_vehicle_azimuth(const berm_can_frame *f, berm_vehicle_azimuth *m);
berm_can_frame berm_encode_payload(const berm_payload *m);
bool berm_decode_payload(const berm_can_frame *f, berm_payload *m);
berm_can_frame berm_encode_estop(const berm_estop *m);
bool berm_decode_estop(const berm_can_frame *f, berm_estop *m);
berm_can_frame berm_encode_operator(const berm_operator *m);
bool berm_decode_operator(const berm_can_frame *f, berm_operator *m);
berm_can_frame berm_encode_spotter(const berm_spotter *m);
bool berm_decode_spotter(const berm_can_frame *f, berm_spotter *m);
berm_can_frame berm_encode_machine_setting(const berm_machine_setting *m);
bool berm_decode_machine_setting(const berm_can_frame *f, berm_machine_setting *m);
berm_can_frame berm_encode_heartbeat(const berm_heartbeat *m);
bool berm_decode_heartbeat(const berm_can_frame *f, berm_heartbeat *m);
berm_can_frame berm_encode_pan_cmd(const berm_pan_cmd *m);
bool berm_decode_pan_cmd(const berm_can_frame *f, berm_pan_cmd *m);
berm_can_frame berm_encode_sim_clock(const berm_sim_clock *m);
bool berm_decode_sim_clock(const berm_can_frame *f, berm_sim_clock *m);
berm_can_frame berm_encode_guard(uint32_t guard_id, const berm_guard *m);
bool berm_decode_guard(const berm_can_frame *f, berm_guard *m);

#ifdef __cplusplus
}
#endif
#endif
