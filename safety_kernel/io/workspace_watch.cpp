#include "io/workspace_watch.hpp"

#include <algorithm>
#include <cmath>

#include "io/low_rays.hpp"

namespace berm::kernel {

WorkspaceWatch::WorkspaceWatch(const berm_parameters& parameters)
    : parameters_(parameters),
      lidars_(std::clamp<int>(parameters.lidars, 0, BERM_LIDARS)),
      scanners_(parameters, parameters.workspace_wait_us, parameters.workspace_period_us),
      lidar_{{parameters, 0}, {parameters, 1}, {parameters, 2}, {parameters, 3}},
      digs_(parameters),
      space_(parameters) {
  static_assert(BERM_LIDARS == 4);
}

void WorkspaceWatch::begin() {
  scanners_.begin();
  for (int i = 0; i < lidars_; ++i) lidar_[i].begin();
  for (Last& last : last_) last = Last{};
  space_.begin();
  space_.watch(lanes_open_, false);
  in_space_ = {-1, -1};
  in_space_us_ = -1;
  begun_ = holds_ = false;
  learned_us_ = space_learned_us_ = lane_learned_us_ = lane_space_learned_us_ = kNotLearning;
}

MonitorWatch::Others WorkspaceWatch::others_of(int number) {
  MonitorWatch::Others others;
  for (int other = 0; other < monitors(); ++other)
    if (other != number) others.monitor[others.count++] = &of(other);
  if (number != kScanners) others.scanners = &scanners_;
  return others;
}

sk_point WorkspaceWatch::head(int scanner, std::int64_t time_us, const JointHistory& joints) const {
  const berm_scanner_mount& mount = parameters_.scanner[scanner];
  const double swing = joints.at(time_us).angles.swing, cosine = std::cos(swing), sine = std::sin(swing);
  const auto mm = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
  return {mm(cosine * mount.x_mm - sine * mount.y_mm), mm(sine * mount.x_mm + cosine * mount.y_mm), mount.z_mm};
}

bool WorkspaceWatch::space_learns(const sk_point& point) const {
  if (!begun_ || space_learned_us_ != kNotLearning) return true;
  const bool lane_learns = lane_space_learned_us_ != kNotLearning && in_lane(sk_map_index(point.y_mm), sk_map_index(point.x_mm));
  return lane_learns || space_.may_be_soil(point);
}

void WorkspaceWatch::take(const ScanBlocks& blocks, const JointHistory& joints, std::int64_t now_us) {
  if (!watched()) return;
  const MonitorWatch::Others others = others_of(kScanners);
  for (int b = 0; b < blocks.count; ++b) {
    const berm_scan_block& block = blocks.block[b];
    Last& last = last_[block.scanner % BERM_SCANNERS];
    const sk_point from = head(block.scanner % BERM_SCANNERS, block.time_us, joints);
    for (int i = 0; i < block.count; ++i) {
      const sk_point point{block.point_mm[i][0], block.point_mm[i][1], block.point_mm[i][2]};
      const std::int32_t index = block.first_index + i;
      if (block.used[i] == 0) continue;
      const bool follows = last.scanline == block.scanline && last.index + 1 == index;
      if (follows) scanners_.interpolate(last.point, point, MonitorWatch::Over::kEverything, now_us);
      scanners_.insert(point, now_us, others);
      if (space_.kept()) space_.take(from, point, space_learns(point), now_us);
      last = {block.scanline, index, point};
    }
  }
}

void WorkspaceWatch::take(int lidar, const Vlp16Packet& packet, const JointAngles& joints, std::int64_t now_us) {
  if (!watched() || lidar < 0 || lidar >= lidars_) return;
  const MonitorWatch::Others others = others_of(lidar + 1);
  lidar_[lidar].take(packet, joints, now_us, others);
  const LidarReturns& returns = lidar_[lidar].returns();
  for (int i = 0; i < returns.count; ++i) {
    const LidarReturns::Return& r = returns.hit[i];
    if (holds_ && r.lined) pass_low(lidar_[lidar].monitor(), others, in_space_.iy >= 0 ? &space_ : nullptr, r.head, r.point, now_us);
    if (!space_.kept()) continue;
    if (r.lined) space_.take(r.head, r.point, space_learns(r.point), now_us);
    else space_.meet(r.point, space_learns(r.point), now_us);
  }
}

void WorkspaceWatch::trucks(bool spotter_fresh, bool parked, std::int64_t now_us) {
  if (!watched() || !spotter_fresh || parked != lanes_open_) return;
  lanes_open_ = !parked;
  for (int number = 0; number < monitors(); ++number) of(number).change_lanes(parameters_, lanes_open_);
  for (int i = 0; i < parameters_.lanes; ++i) space_.forget(parameters_.lane[i]);
  lane_learned_us_ = now_us + parameters_.workspace_learn_us;
  lane_space_learned_us_ = space_learned_from(now_us);
  space_.watch(lanes_open_, false);
}

std::int64_t WorkspaceWatch::space_learned_from(std::int64_t now_us) const {
  return now_us + std::min<std::int64_t>(parameters_.workspace_learn_us, kSpaceLearnUs);
}

void WorkspaceWatch::settle(const berm_lane& rectangle) {
  for (int number = 0; number < monitors(); ++number) of(number).settle(rectangle);
}

bool WorkspaceWatch::in_lane(std::int32_t iy, std::int32_t ix) const {
  return std::any_of(parameters_.lane, parameters_.lane + parameters_.lanes,
                     [&](const berm_lane& lane) { return sk_is_touched(iy, ix, lane.x_low_mm, lane.y_low_mm, lane.x_high_mm, lane.y_high_mm); });
}

// In rectangles from the middle of a cell to the middle of another: rows in which the same cells are no lane's have theirs in common.
void WorkspaceWatch::settle_beside_lanes() {
  const auto middle = [](std::int32_t i) { return SK_MAP_ORIGIN_MM + SK_CELL_MM * i + SK_CELL_MM / 2; };
  const auto alike = [this](std::int32_t one, std::int32_t other) {
    for (std::int32_t ix = 0; ix < SK_MAP_CELLS; ++ix)
      if (in_lane(one, ix) != in_lane(other, ix)) return false;
    return true;
  };
  for (std::int32_t first_y = 0, end_y = 1; first_y < SK_MAP_CELLS; first_y = end_y++) {
    while (end_y < SK_MAP_CELLS && alike(first_y, end_y)) ++end_y;
    for (std::int32_t first_x = 0, end_x = 1; first_x < SK_MAP_CELLS; first_x = end_x++) {
      if (in_lane(first_y, first_x)) continue;
      while (end_x < SK_MAP_CELLS && !in_lane(first_y, end_x)) ++end_x;
      settle({middle(first_x), middle(first_y), middle(end_x - 1), middle(end_y - 1)});
    }
  }
}

void WorkspaceWatch::end_learning(std::int64_t now_us) {
  if (!begun_) {
    learned_us_ = now_us + parameters_.workspace_learn_us;
    space_learned_us_ = space_learned_from(now_us);
  }
  begun_ = true;
  if (now_us >= space_learned_us_) space_learned_us_ = kNotLearning;
  if (now_us >= lane_space_learned_us_) lane_space_learned_us_ = kNotLearning;
  const bool all = learned_us_ != kNotLearning && now_us >= learned_us_, lanes = lane_learned_us_ != kNotLearning && now_us >= lane_learned_us_;
  // A truck that came while the map was learned is to be learned as long as any other.
  if (all && lane_learned_us_ != kNotLearning) settle_beside_lanes();
  else if (all) settle({SK_MAP_ORIGIN_MM, SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM, -SK_MAP_ORIGIN_MM});
  for (int i = 0; lanes && i < parameters_.lanes; ++i) settle(parameters_.lane[i]);
  if (all) learned_us_ = kNotLearning;
  if (lanes) lane_learned_us_ = kNotLearning;
  // Of a truck more and more is seen meanwhile, and left out of what free space watches; but not while somebody is in the region, lest it be he.
  const bool truck_seen = !lanes_open_ && space_learned_us_ == kNotLearning && lane_space_learned_us_ == kNotLearning;
  truck_box_due_ = truck_box_due_ || all || lanes || (truck_seen && (learned_us_ != kNotLearning || lane_learned_us_ != kNotLearning) && now_us >= truck_box_us_);
  if (!truck_box_due_ || holds_) return;
  space_.watch(lanes_open_, truck_seen);
  truck_box_due_ = false;
  truck_box_us_ = now_us + kTruckBoxUs;
}

bool WorkspaceWatch::foreign(std::int64_t now_us) {
  in_space_ = {-1, -1};
  if (space_.find(in_space_)) in_space_us_ = now_us;
  return in_space_us_ >= 0 && now_us - in_space_us_ < parameters_.workspace_dwell_us;
}

void WorkspaceWatch::dig(const JointAngles& joints, bool stands, std::int64_t now_us) {
  if (!watched() || parameters_.workspace_histogram == 0) return;
  digs_.step(joints, stands, holds_, now_us);
  const bool learned = begun_ && learned_us_ == kNotLearning;
  for (int number = 0; number < monitors(); ++number) of(number).dig(digs_.cells(), learned, holds_);
  space_.dig(digs_.cells(), learned, holds_);
}

bool WorkspaceWatch::step(std::int64_t now_us) {
  if (!watched()) return false;
  end_learning(now_us);
  holds_ = foreign(now_us);
  for (int number = 0; number < monitors(); ++number) holds_ = of(number).step(now_us) || holds_;
  return holds_;
}

bool WorkspaceWatch::place(std::int32_t& x_mm, std::int32_t& y_mm, std::int32_t& height_mm) const {
  for (int number = 0; number < monitors(); ++number)
    if (of(number).place(x_mm, y_mm, height_mm)) return true;
  if (in_space_.iy < 0) return false;
  x_mm = SK_MAP_ORIGIN_MM + SK_CELL_MM * in_space_.ix + SK_CELL_MM / 2;
  y_mm = SK_MAP_ORIGIN_MM + SK_CELL_MM * in_space_.iy + SK_CELL_MM / 2;
  height_mm = space_.foreign_height_mm(in_space_);
  return true;
}

}  // namespace berm::kernel
