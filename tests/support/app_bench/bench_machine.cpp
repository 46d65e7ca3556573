#include "app_bench/bench_machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "app/machine_loader.hpp"
#include "app_bench/bench_cylinders.hpp"
#include "motion/arm_kinematics.hpp"
#include "motion/joint_response.hpp"
#include "motion/reach_preview.hpp"
#include "planning/truck_place.hpp"

namespace berm::app_bench {

using namespace berm::app;

namespace {

constexpr double kernel_cell = 0.3, kernel_half_side = 15.6;
constexpr int kernel_side = 104;
constexpr double bank_density = 1474.0;

std::int32_t largest_urad_s(const MachineModel& machine, std::size_t joint) { return static_cast<std::int32_t>(machine.joint[joint].velocity_max * 1e6); }

int kernel_index(double v) { return static_cast<int>(std::floor((v + kernel_half_side) / kernel_cell)); }

}  // namespace

MachineModel shipped_machine(const std::string& name) { return machine_model(config::load_machine_file(BERM_CONFIG_DIR "/machines/" + name + ".toml")); }
SiteModel shipped_site(const std::string& name) { return site_model(config::load_site_file(BERM_CONFIG_DIR "/sites/" + name + ".toml")); }
MachineModel zx200() { return shipped_machine("zx200"); }
ScriptSet shipped_scripts() { return read_scripts(BERM_SCRIPTS); }
SiteModel bench() { return shipped_site("bench"); }

TruckBed bench_bed() {
  TruckBed bed;
  bed.centre_x = -0.70, bed.centre_y = 6.75, bed.length = 4.88, bed.width = 2.44, bed.height = 1.22, bed.wall_top = BenchSite::wall_top;
  limit_to_zones(bed, bench().truck_zones);
  return bed;
}

SiteModel bench_with_truck() {
  SiteModel site = bench();
  site.bed = bench_bed();
  return site;
}

BenchMachine::BenchMachine(const MachineModel& machine, const Joints& start, std::uint64_t seed)
    : machine_(machine), segment_(std::make_unique<berm_state_segment>()), random_(seed), angle_(start), seen_(static_cast<std::size_t>(kernel_side * kernel_side), -1e9) {
  std::memset(static_cast<void*>(segment_.get()), 0, sizeof *segment_);
  segment_->magic = BERM_CONTRACT_MAGIC;
  segment_->version = BERM_CONTRACT_VERSION;
  segment_->size = sizeof(berm_state_segment);
  segment_->cell_mm = static_cast<std::uint32_t>(std::lround(kernel_cell * 1e3));
  segment_->map_origin_mm = -static_cast<std::int32_t>(std::lround(kernel_half_side * 1e3));
  for (std::size_t j = 0; j < joints; ++j) {
    most_speed[j] = machine.joint[j].velocity_max;
    permitted_high_[j] = largest_urad_s(machine, j);
    permitted_low_[j] = -permitted_high_[j];
  }
  measure();
  publish();
}

void BenchMachine::step(const berm_request& request) {
  ++cycle_;
  decide(request);
  const Joints before = angle_;
  pushed_ = 0.0;
  move();
  work_soil();
  push_ = has_pressures && digging_ ? soil_push(machine_, before, angle_, pushed_) : PlaneForce{};
  if (held_by_n > 0.0) push_ = {held_by_n, 0.0};
  site_.slump();
  measure();
  scan(request);
  if (map_void) std::fill(seen_.begin(), seen_.end(), -1e9);
  check();
  publish();
}

// As the kernel: cut towards zero to the bus's step; what was cut is permitted no more than that, the rest everything, what is held nothing.
void BenchMachine::decide(const berm_request& request) {
  constexpr std::int32_t step = 500;
  const auto cut = [](std::int32_t wanted, std::int32_t limit) { return std::clamp(wanted, -limit, limit) / step * step; };
  for (std::size_t j = 0; j < joints; ++j) {
    const std::int32_t largest = largest_urad_s(machine_, j), wanted = request.joint_velocity_urad_s[j];
    const auto most = std::min(largest, static_cast<std::int32_t>(std::lround(most_speed[j] * 1e6)));
    commanded_[j] = kernel_runs ? cut(wanted, most) : std::fabs(wanted * 1e-6) > machine_.joint[j].creep_velocity ? 0 : cut(wanted, largest);
    const bool whole = commanded_[j] == cut(wanted, largest);
    permitted_low_[j] = !kernel_runs ? 0 : whole ? -largest : std::min(0, commanded_[j]);
    permitted_high_[j] = !kernel_runs ? 0 : whole ? largest : std::max(0, commanded_[j]);
  }
}

double BenchMachine::noise() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }

void BenchMachine::measure() {
  for (std::size_t j = 0; j < joints; ++j) {
    measured_angle_[j] = static_cast<std::int32_t>(std::lround((angle_[j] + radians(0.02) * noise()) * 1e6));
    measured_velocity_[j] = static_cast<std::int32_t>(std::lround((velocity_[j] + radians(0.05) * noise()) * 1e6));
  }
}

void BenchMachine::move() {
  const double reach = reach_of(machine_, angle_);
  for (std::size_t j = 0; j < joints; ++j) {
    const JointLimits& limits = machine_.joint[j];
    const double before = velocity_[j];
    const TwoWayResponse both = responses_of(machine_, j, reach, payload_);
    JointResponse response = before > 0.0 || (before == 0.0 && commanded_[j] > 0) ? both.up : both.down;
    under_way_[j].push_back(commanded_[j] * 1e-6);
    double acting = 0.0;
    if (under_way_[j].size() > static_cast<std::size_t>(std::lround(response.dead_time / machine_.cycle))) {
      acting = under_way_[j].front();
      under_way_[j].pop_front();
    }
    // A loaded bucket makes the machine 15 % slower to answer than its file says.
    response.acceleration *= payload_ > 500.0 ? 0.85 : 1.0;
    response.deceleration *= brake_share[j];
    velocity_[j] = held_by_n >= 0.0 && j != swing ? 0.0 : speed_after(response, before, acting, machine_.cycle);
    if (held_by_n < 0.0 || j == swing) angle_[j] += 0.5 * (before + velocity_[j]) * machine_.cycle;
    if (angle_[j] < limits.low || angle_[j] > limits.high) ++findings_.range_contacts;
  }
}

void BenchMachine::work_soil() {
  const ArmPoints arm = forward(machine_, angle_);
  const Point tip = in_base(arm.tip, angle_[swing]);
  if (!site_.on_truck(tip.x, tip.y)) {
    // Everything above the bucket's shell goes into it, or past it when it is full.
    for (const Prism& part : machine_.parts)
      for (std::size_t i = 0; part.link == bucket && i < part.outline.size(); ++i)
        for (int k = 0; k < 12; ++k) {
          const auto &from = part.outline[i], &to = part.outline[(i + 1) % part.outline.size()];
          const double x = from[0] + k / 12.0 * (to[0] - from[0]), across = from[1] + k / 12.0 * (to[1] - from[1]);
          if (across < -0.05) continue;  // the outline's side of the heaped load
          const double c = std::cos(arm.bucket_attitude), s = std::sin(arm.bucket_attitude);
          const Point p = in_base({arm.bucket_pin.r + x * c - across * s, arm.bucket_pin.z + x * s + across * c}, angle_[swing]);
          const double cut_kg = site_.cut(p.x, p.y, angle_[swing], 0.55, p.z) * bank_density;
          pushed_ += cut_kg;
          payload_ = std::min(holds_kg, payload_ + cut_kg);
        }
  }
  digging_ = !site_.on_truck(tip.x, tip.y) && tip.z < site_.height(tip.x, tip.y) + 0.1;
  most_carried_ = digging_ ? payload_ : std::max(most_carried_, payload_);
  if (arm.bucket_attitude > radians(-140.0) && arm.tip.z > 0.2 && payload_ > 0.0) {
    const double share = std::clamp((arm.bucket_attitude - radians(-140.0)) / radians(50.0), 0.0, 1.0);
    const double empty_at = radians(-50.0), held = pours_by_tilt ? std::clamp((empty_at - arm.bucket_attitude) / (empty_at - radians(-140.0)), 0.0, 1.0) : 0.0;
    const double out = std::min(std::max(0.0, payload_ - std::max(held, sticks) * most_carried_), (200.0 + 2500.0 * share) * machine_.cycle);
    payload_ -= out;
    site_.dump(tip.x, tip.y, out);
  }
}

BenchMachine::Outline BenchMachine::implements(const Joints& q) const {
  Outline outline;
  const ArmPoints arm = forward(machine_, q);
  for (const Prism& part : machine_.parts) {
    if (part.link == boom) continue;
    const PlanePoint base = part.link == stick ? arm.stick_pin : arm.bucket_pin;
    const double a = part.link == stick ? arm.stick_attitude : arm.bucket_attitude;
    for (std::size_t i = 0; i < part.outline.size(); ++i) {
      const auto& from = part.outline[i];
      const auto& to = part.outline[(i + 1) % part.outline.size()];
      for (int k = 0; k < 4; ++k) {
        const double t = 0.25 * k, x = from[0] + t * (to[0] - from[0]), z = from[1] + t * (to[1] - from[1]);
        for (const double side : {-1.0, 0.0, 1.0})
          outline.points.push_back({base.r + x * std::cos(a) - z * std::sin(a), base.z + x * std::sin(a) + z * std::cos(a), side * part.half_width});
      }
    }
  }
  return outline;
}

void BenchMachine::scan(const berm_request& request) {
  constexpr int samples = 100, revolution = 400;  // no block spans two turns of the mirror
  constexpr double march = 0.1, farthest = 14.0, to_surface = 0.001;
  const double time_s = static_cast<double>(cycle_) * machine_.cycle;
  for (std::size_t i = 0; i < 2; ++i) {
    const ScannerMount& mount = machine_.scanner[i];
    const double goal = request.pan_goal_urad[i] * 1e-6, rate = request.pan_rate_urad_s[i] * 1e-6;
    pan_before_[i] = pan_[i];
    pan_[i] += std::clamp(goal - pan_[i], -rate * machine_.cycle, rate * machine_.cycle);
    findings_.most_azimuth_rate = std::max(findings_.most_azimuth_rate, std::fabs((pan_[i] - pan_before_[i]) / machine_.cycle + velocity_[swing]));
    const std::uint32_t n = segment_->scan_head;
    berm_scan_block& block = segment_->scan[n % BERM_SCAN_RING];
    block.sequence = 2 * n + 1;
    block.scanner = static_cast<std::uint8_t>(i);
    block.count = samples;
    block.scanline = scanline_[i];
    block.time_us = static_cast<std::int64_t>(cycle_) * 10000;
    block.sample_period_ns = 1;  // all at once
    block.first_index = static_cast<std::uint16_t>(mirror_[i]);
    block.samples_per_revolution = revolution;
    block.pan_start_urad = static_cast<std::int32_t>(std::lround(pan_before_[i] * 1e6));
    block.pan_end_urad = static_cast<std::int32_t>(std::lround(pan_[i] * 1e6));
    const double c = std::cos(angle_[swing]), s = std::sin(angle_[swing]);
    const double x0 = mount.x * c - mount.y * s, y0 = mount.x * s + mount.y * c;
    for (int k = 0; k < samples; ++k) {
      const double e = 2.0 * std::numbers::pi * ((mirror_[i] + static_cast<std::uint32_t>(k)) % revolution) / revolution;
      block.used[k] = 0;
      block.range_mm[k] = 0;
      block.echoes[k] = 0;
      std::fill_n(block.point_mm[k], 3, 0);
      if (std::sin(e) > -0.05) continue;
      const double azimuth = angle_[swing] + pan_before_[i] + (pan_[i] - pan_before_[i]) * k / (samples - 1);
      const double dx = std::cos(e) * std::cos(azimuth), dy = std::cos(e) * std::sin(azimuth), dz = std::sin(e);
      const auto below = [&](double range) { return mount.z + range * dz <= site_.height(x0 + range * dx, y0 + range * dy); };
      for (double range = 0.5; range < farthest; range += march) {
        // Every cell that the ray passes in free space or meets counts as seen, as after the kernel's interpolation.
        if (!below(range)) continue;
        double above = range - march;
        while (range - above > to_surface) (below(0.5 * (above + range)) ? range : above) = 0.5 * (above + range);
        block.used[k] = 1;
        block.echoes[k] = 1;
        block.range_mm[k] = static_cast<std::uint32_t>(std::lround(range * 1e3));
        // As the kernel projects it: by the swing angle as measured.
        const double exact = block.range_mm[k] * 1e-3, off = measured_angle_[swing] * 1e-6 - angle_[swing];
        const double x = x0 + exact * dx, y = y0 + exact * dy;
        block.point_mm[k][0] = static_cast<std::int32_t>(std::lround((x * std::cos(off) - y * std::sin(off)) * 1e3));
        block.point_mm[k][1] = static_cast<std::int32_t>(std::lround((x * std::sin(off) + y * std::cos(off)) * 1e3));
        block.point_mm[k][2] = static_cast<std::int32_t>(std::ceil((mount.z + exact * dz) * 1e3));
        break;
      }
    }
    // The kernel interpolates along the scanline: every cell between the head and its farthest return.
    for (const double back : {0.0, std::numbers::pi})
      for (double range = 0.5; range < farthest; range += 0.15) {
        const double azimuth = angle_[swing] + pan_[i] + back;
        const int ix = kernel_index(x0 + range * std::cos(azimuth)), iy = kernel_index(y0 + range * std::sin(azimuth));
        if (ix >= 0 && iy >= 0 && ix < kernel_side && iy < kernel_side) seen_[static_cast<std::size_t>(iy * kernel_side + ix)] = time_s;
      }
    mirror_[i] = (mirror_[i] + samples) % revolution;
    scanline_[i] += mirror_[i] == 0 ? 1 : 0;
    block.sequence = 2 * n + 2;
    segment_->scan_head = n + 1;
  }
}

void BenchMachine::check() {
  const double time_s = static_cast<double>(cycle_) * machine_.cycle;
  const double c = std::cos(angle_[swing]), s = std::sin(angle_[swing]);
  bool wall = false, ground = false, floor = false;
  for (const auto& [r, z, across] : implements(angle_).points) {
    const double x = r * c - across * s, y = r * s + across * c;
    const double h = site_.height(x, y);
    if (site_.on_truck(x, y)) {
      const double top = std::max(h, BenchSite::wall_top);
      findings_.lowest_over_truck = std::min(findings_.lowest_over_truck, z - top);
      wall = wall || z < top + machine_.margin;
      continue;
    }
    const bool dig_zone = x > 3.9 && x < 10.5 && y > -4.2 && y < 4.2;
    if (dig_zone && std::fabs(velocity_[swing]) < machine_.dig_swing_limit) floor = floor || z < -3.4;
    else ground = ground || z < h + machine_.margin;
  }
  findings_.wall_contacts += wall;
  findings_.ground_contacts += ground;
  findings_.floor_contacts += floor;
  // Where the bucket will be within a second or two at this swing speed, and through the stop that may follow.
  if (std::fabs(velocity_[swing]) > machine_.dig_swing_limit) {
    const ArmPoints arm = forward(machine_, angle_);
    const double decel = 0.6 * machine_.joint[swing].acceleration_max;
    const double ahead = velocity_[swing] * velocity_[swing] / (2.0 * decel) + 0.15 * std::fabs(velocity_[swing]);
    for (double a = 0.0; a <= ahead; a += radians(2.0)) {
      const double bearing = angle_[swing] + std::copysign(a, velocity_[swing]);
      for (double r = std::max(3.3, std::min(arm.tip.r, arm.bucket_pin.r)); r < std::max(arm.tip.r, arm.bucket_pin.r) + 0.4; r += kernel_cell) {
        const int ix = kernel_index(r * std::cos(bearing)), iy = kernel_index(r * std::sin(bearing));
        if (time_s - seen_[static_cast<std::size_t>(iy * kernel_side + ix)] > machine_.fresh) ++findings_.unseen_cells;
      }
    }
  }
}

// As the kernel's map: the highest of the cell, once a scanline has crossed it.
void BenchMachine::publish_cell(int ix, int iy) {
  const double age = static_cast<double>(cycle_) * machine_.cycle - seen_[static_cast<std::size_t>(iy * kernel_side + ix)];
  const double x = (ix + 0.5) * kernel_cell - kernel_half_side, y = (iy + 0.5) * kernel_cell - kernel_half_side;
  const bool own = std::hypot(x, y) < machine_.own_body_radius;
  const bool ever = seen_[static_cast<std::size_t>(iy * kernel_side + ix)] >= 0.0;
  segment_->map_status[iy][ix] = own ? BERM_CELL_OWN_BODY : !ever ? BERM_CELL_UNKNOWN : age > machine_.fresh ? BERM_CELL_STALE : BERM_CELL_OBSERVED;
  double top = -1e9;
  for (const double dx : {-0.1, 0.0, 0.1})
    for (const double dy : {-0.1, 0.0, 0.1}) top = std::max(top, site_.height(x + dx, y + dy));
  segment_->map_height_mm[iy][ix] = ever ? static_cast<std::int32_t>(std::lround(top * 1e3)) : 0;
}

void BenchMachine::publish() {
  berm_state& state = segment_->state;
  ++segment_->state_guard;
  state.cycle = cycle_;
  state.time_us = static_cast<std::int64_t>(cycle_) * 10000;
  for (std::size_t j = 0; j < joints; ++j) {
    state.joint_angle_urad[j] = measured_angle_[j];
    state.joint_velocity_urad_s[j] = measured_velocity_[j];
    state.commanded_urad_s[j] = commanded_[j];
    state.permitted_low_urad_s[j] = permitted_low_[j];
    state.permitted_high_urad_s[j] = permitted_high_[j];
  }
  for (std::size_t i = 0; i < 2; ++i) state.pan_angle_urad[i] = static_cast<std::int32_t>(std::lround(pan_[i] * 1e6));
  state.payload_kg = digging_ || !weighs ? -1 : static_cast<std::int32_t>(std::lround(std::max(0.0, payload_ * (1.0 + 0.03 * noise()) + weighing_error_kg)));
  const CylinderPressures pressure = has_pressures ? pressures(machine_, angle_, payload_, push_) : CylinderPressures{};
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    state.cylinder_kpa[i][0] = static_cast<std::int32_t>(std::lround(pressure[i].bottom_kpa));
    state.cylinder_kpa[i][1] = static_cast<std::int32_t>(std::lround(pressure[i].rod_kpa));
  }
  state.kernel_state = kernel_runs ? BERM_STATE_RUN : BERM_STATE_STOPPED;
  state.stop_reason = kernel_runs ? std::uint8_t{BERM_STOP_NONE} : stop_reason;
  const bool latches = stop_reason == BERM_STOP_BASE_MOVED || stop_reason == BERM_STOP_EMERGENCY;
  state.stop_category = kernel_runs ? 255 : latches ? 1 : 2;
  for (int rows = 0; rows < 4; ++rows, next_row_ = (next_row_ + 1) % kernel_side)
    for (int ix = 0; ix < kernel_side; ++ix) publish_cell(ix, next_row_);
  state.panel = BERM_PANEL_OPERATOR_RUN | (truck_parked ? BERM_PANEL_TRUCK_PARKED : 0u) | (truck_leaves ? BERM_PANEL_TRUCK_LEAVING : 0u);
  ++segment_->state_guard;
  berm_decision& decision = segment_->decision[segment_->decision_head % BERM_DECISION_RING];
  decision = {};
  decision.cycle = state.cycle;
  decision.time_us = state.time_us;
  std::copy_n(state.joint_angle_urad, joints, decision.joint_angle_urad);
  std::copy_n(state.joint_velocity_urad_s, joints, decision.joint_velocity_urad_s);
  ++segment_->decision_head;
  ++segment_->wake;
}

}  // namespace berm::app_bench
