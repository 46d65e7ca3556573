#include "core/parameter_check.h"
#include "io/parameter_loader.hpp"

namespace berm::kernel {

namespace {

// By ordinal; the limits are those of core/parameter_check.h.
constexpr const char* kText[] = {
    "holds",
    "magic: not a parameter block",
    "version: not this kernel's",
    "size: not that of this kernel's parameter block",
    "cell_mm: not the cell size this kernel was built with",
    "boom_pin_x_mm: within -3000..3000",
    "boom_pin_z_mm: within 0..5000",
    "boom_length_mm: within 1000..12000",
    "stick_length_mm: within 500..8000",
    "bucket_length_mm: within 300..4000",
    "boom pin and lengths: together at most 15000 mm",
    "own_body_radius_mm: within 500..6000",
    "joint_low_urad, joint_high_urad: low below high, within +-2 pi (swing) or +-pi",
    "velocity_max_urad_s: within 1000..4000000",
    "acceleration_max_urad_s2: within 1000..50000000",
    "creep_velocity_urad_s: within 0..velocity_max",
    "angle_error_urad: within 0..100000",
    "velocity_error_urad_s: within 0..200000",
    "state_latency_us: within 0..500000",
    "command_latency_us: within 0..1000000",
    "brake_reach_mm: rising, from above 0 to 32000",
    "brake_reach_mm: the last must cover the machine's reach",
    "brake_angle_urad: within 0..2 pi",
    "brake_angle_urad: must not fall with speed",
    "brake_angle_urad: must not fall with reach",
    "brake_time_us: within 0..30000000",
    "brake_time_us: must not fall with speed",
    "brake_time_us: must not fall with reach",
    "parts: 1 to 5",
    "part link: 1 boom, 2 stick, 3 bucket",
    "part half_width_mm: within 1..3000",
    "part vertices: 3 to 8",
    "part vertex_mm: within +-15000",
    "part outline: convex and counter-clockwise",
    "parts: boom, stick and bucket need one each at least",
    "scanner position: x and y within +-5000 mm, z within 0..8000 mm",
    "scanner pan_low_urad, pan_high_urad: low below high, within +-pi",
    "scanner pan_rate_max_urad_s: within 1..10000000",
    "scanner_silent_us: within 1000..5000000",
    "spurious_range_mm: within 1..100000",
    "range_min_mm, range_max_mm: 0 or more, min below max, at most 262140",
    "self_margin_mm: within 0..2000",
    "margin_mm: within 0..3000",
    "fresh_us: within 1..600000000",
    "generation_us: within 1..fresh_us",
    "dig_swing_limit_urad_s: within 0..velocity_max of the swing",
    "dig_zones: 0 to 4",
    "dig_zone: low below high, within +-15000 mm",
    "dig_zone floor_mm below ceiling_mm, both within +-20000",
    "request_age_us: within 1..500000",
    "request_hold_us: within 1..50000",
    "request_silent_us: within request_hold_us..500000",
    "state_frame_age_us: within 1..500000",
    "machine_state_age_us: within 1..1000000",
    "operator_age_us: within 1..1000000",
    "cycle_us: within 1000..100000",
    "standstill_urad_s: within 1..100000",
    "standstill_us: within 1..2000000",
    "base_tilt_urad: within 1000..35000",
    "base_tilt_hard_urad: within base_tilt_urad..90000",
    "base_azimuth_urad: within 1000..35000",
    "base_frame_age_us: within 1..1000000",
    "pass_over_mm: within +-20000",
    "ground_zones: 0 to 4",
    "ground_zone: low below high, within +-15000 mm",
    "ground_zone pass_over_mm: within +-20000",
    "truck_zones: 0 to 4",
    "truck_zone: low below high, within +-15000 mm",
    "truck_zone ceiling_mm: within +-20000",
};
static_assert(sizeof kText / sizeof kText[0] == SK_RULES, "one text a rule");

}  // namespace

const char* parameter_rule_text(std::int32_t rule) { return rule >= 0 && rule < SK_RULES ? kText[rule] : "no such rule"; }

}  // namespace berm::kernel
