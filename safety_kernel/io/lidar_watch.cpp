#include "io/lidar_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace berm::kernel {

namespace {

constexpr double kFarthestM = 22.0;             // from the swing axis: beyond the map's corners
constexpr double kIntoMm = 100.0;               // less than half of a child's thickness
constexpr double kBeyondMapMm = 15300.0;        // where lines end that leave the map

// The line's end, brought in to where it leaves the map.
sk_point clipped(const sk_point& from, const sk_point& to) {
  double part = 1.0;
  const auto bring_in = [&part](double start, double end) {
    if (std::fabs(end) <= kBeyondMapMm || std::fabs(start) >= kBeyondMapMm) return;
    part = std::min(part, (std::copysign(kBeyondMapMm, end) - start) / (end - start));
  };
  bring_in(from.x_mm, to.x_mm);
  bring_in(from.y_mm, to.y_mm);
  const auto along = [part](double start, double end) { return static_cast<std::int32_t>(std::lround(start + part * (end - start))); };
  return {along(from.x_mm, to.x_mm), along(from.y_mm, to.y_mm), along(from.z_mm, to.z_mm)};
}

// A little farther along the beam, as seen from above.
sk_point farther(const sk_point& head, const sk_point& met) {
  const double dx = met.x_mm - head.x_mm, dy = met.y_mm - head.y_mm, part = kIntoMm / std::max(std::hypot(dx, dy), 1.0);
  return {met.x_mm + static_cast<std::int32_t>(std::lround(part * dx)), met.y_mm + static_cast<std::int32_t>(std::lround(part * dy)), met.z_mm};
}

// Whether no taken firing between them is missing.
bool follow(std::uint32_t from_mdeg, std::uint32_t to_mdeg) { return (to_mdeg + kVlp16TurnMdeg - from_mdeg) % kVlp16TurnMdeg <= LidarWatch::kGapMdeg; }

}  // namespace

LidarWatch::LidarWatch(const berm_parameters& parameters, int lidar)
    : mount_(lidar_mount(parameters.lidar[lidar])),
      self_(parameters),
      rise_mm_(parameters.workspace_rise_mm),
      spurious_mm_(parameters.spurious_range_mm),
      monitor_(parameters, parameters.workspace_lidar_wait_us, parameters.workspace_lidar_period_us) {}

void LidarWatch::begin() {
  monitor_.begin();
  columns_ = 0;
  returns_.count = 0;
  line_ = turn_ = 0;
}

bool LidarWatch::draws_lines(std::uint32_t azimuth_mdeg) {
  const std::uint32_t line = azimuth_mdeg / kLineMdeg;
  if (line == line_) return false;
  if (line < line_) ++turn_;
  line_ = line;
  return line % kTurnsOfLines == turn_ % kTurnsOfLines;
}

// The sixteen lasers fire one after the other, while the sensor turns by 0.13 degrees.
void LidarWatch::see(const Vlp16Return* hit, int count, const Pose& pose, Column& column) const {
  column = Column{};
  column.azimuth_mdeg = hit[0].azimuth_mdeg;
  column.head = pose.head;
  const double heading = -static_cast<double>(column.azimuth_mdeg) * kVlp16RadPerMdeg;
  const Eigen::Vector3d ahead = mount_.turn * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0), up = mount_.turn.col(2);
  const Eigen::Vector3d right = ahead.cross(up);
  for (int i = 0; i < count; ++i) {
    const Vlp16Elevation elevation = vlp16_elevation(hit[i].channel);
    const int channel = hit[i].channel % kVlp16Channels;
    const double range_m = hit[i].range_mm * 1e-3, level_m = range_m * elevation.cosine;
    const double turned_rad = ((hit[i].azimuth_mdeg + kVlp16TurnMdeg - column.azimuth_mdeg) % kVlp16TurnMdeg) * kVlp16RadPerMdeg;
    const Eigen::Vector3d upper = mount_.place + level_m * ahead + level_m * turned_rad * right + range_m * elevation.sine * up;
    const bool far = upper.head<2>().squaredNorm() > kFarthestM * kFarthestM;
    column.met[channel] = !far && self_.is_own(upper, pose.implements) ? Met::kOwn : Met::kThing;
    column.range_mm[channel] = hit[i].range_mm;
    column.level_mm[channel] = static_cast<std::int32_t>(level_m * 1e3);
    column.point[channel] = lidar_base_point(upper, pose.cosine, pose.sine);
  }
}

bool LidarWatch::counts(const Column& column, int channel, const Column* before, const Column* after) const {
  const auto level = [&column, channel](int other) {
    return other >= 0 && other < kVlp16Channels && column.met[other] == Met::kThing &&
           std::abs(column.level_mm[other] - column.level_mm[channel]) <= kUprightMm;
  };
  const bool upright = level(channel - 1) || level(channel + 1);
  const std::int32_t limit_mm = upright ? kBesideUprightMm : spurious_mm_;
  const auto beside = [&column, channel, limit_mm](const Column* other) {
    return other != nullptr && other->met[channel] == Met::kThing && std::abs(other->range_mm[channel] - column.range_mm[channel]) <= limit_mm;
  };
  return upright ? beside(before) && beside(after) : beside(before) || beside(after);
}

// What lasers above each other meet of something upright goes into one cell, or errors of a few centimetres would share it out among two and give
// each another height at every turn: that of the lowest return, a little farther into what it met, so that what only just reaches into a cell does
// not fill it. Its highest return is no spurious one, there being another below it, so it is not the one to discard.
void LidarWatch::insert(const Column& column, const bool (&counting)[kVlp16Channels], const MonitorWatch::Others& others, std::int64_t now_us) {
  for (int c = 0; c < kVlp16Channels;) {
    const int lowest = c++;
    if (!counting[lowest]) continue;
    while (c < kVlp16Channels && counting[c] && std::abs(column.level_mm[c] - column.level_mm[lowest]) <= kBesideUprightMm) ++c;
    if (c == lowest + 1) {
      monitor_.insert(column.point[lowest], now_us, others);
      continue;
    }
    sk_point at = farther(column.head, column.point[lowest]);
    for (int channel = lowest; channel < c; ++channel) {
      at.z_mm = column.point[channel].z_mm;
      monitor_.insert(at, now_us, others);
    }
    monitor_.insert(at, now_us, others);
  }
}

void LidarWatch::note(const Column& column, const bool (&counting)[kVlp16Channels], bool lined) {
  for (int channel = 0; channel < kVlp16Channels; ++channel)
    if (counting[channel] && returns_.count < LidarReturns::kCapacity) returns_.hit[returns_.count++] = {column.head, column.point[channel], lined};
}

void LidarWatch::finish(const Column& column, const Column* before, const Column* after, const MonitorWatch::Others& others, std::int64_t now_us) {
  bool counting[kVlp16Channels];
  for (int c = 0; c < kVlp16Channels; ++c) counting[c] = column.met[c] == Met::kThing && counts(column, c, before, after);
  insert(column, counting, others, now_us);
  const bool lined = draws_lines(column.azimuth_mdeg);
  note(column, counting, lined);
  if (lined) draw(column, now_us);
}

// A beam that came back from the own machine, or did not come back, cuts the line: what lies between its neighbours is not known.
void LidarWatch::draw(const Column& column, std::int64_t now_us) {
  bool nearest = true;
  for (int c = 0; c < kVlp16Channels; ++c) {
    if (column.met[c] != Met::kThing) continue;
    if (nearest) draw_nearest(column.head, column.point[c], now_us);
    else if (column.met[c - 1] == Met::kThing) draw_line(column.point[c - 1], column.point[c], now_us);
    nearest = false;
  }
}

// Nothing stands above the line, but what is lower was not seen. The ground is taken to lie as the nearest return does, or half a rise below the
// line: lower than that, what is seen there from elsewhere one day would be an obstacle; higher, a child beside the lidar were none.
void LidarWatch::draw_nearest(const sk_point& head, const sk_point& nearest, std::int64_t now_us) {
  if (nearest.z_mm >= head.z_mm) return;
  const std::int32_t start_mm = std::max(head.z_mm - rise_mm_ / 2, nearest.z_mm);
  const double part = static_cast<double>(start_mm - nearest.z_mm) / (head.z_mm - nearest.z_mm);
  const auto along = [part](std::int32_t from, std::int32_t to) { return from + static_cast<std::int32_t>(std::lround(part * (to - from))); };
  const sk_point start{head.x_mm, head.y_mm, start_mm}, foot{along(head.x_mm, nearest.x_mm), along(head.y_mm, nearest.y_mm), nearest.z_mm};
  draw_line(start, foot, now_us);
  draw_line(foot, nearest, now_us);
}

// Not over what was measured: the line past the edge of a thing, from where the swing has carried the lidar, would lower the cell that the thing
// is in.
void LidarWatch::draw_line(const sk_point& from, const sk_point& to, std::int64_t now_us) {
  monitor_.interpolate(from, clipped(from, to), MonitorWatch::Over::kUnmeasured, now_us);
}

void LidarWatch::take(const Vlp16Packet& packet, const JointAngles& joints, std::int64_t now_us, const MonitorWatch::Others& others) {
  Pose pose{self_.pose(joints), std::cos(joints.swing), std::sin(joints.swing), {}};
  pose.head = lidar_base_point(mount_.place, pose.cosine, pose.sine);
  returns_.count = 0;
  int next = 0;
  for (int first = 0; first < packet.count; first = next) {
    while (next < packet.count && packet.point[next].firing == packet.point[first].firing) ++next;
    if (packet.point[first].firing % kTaken != 0) continue;
    Column& after = newest_[columns_ % 3];
    see(packet.point + first, next - first, pose, after);
    ++columns_;
    if (columns_ < 2) continue;
    const Column& column = newest_[(columns_ - 2) % 3];
    const Column* before = columns_ > 2 ? &newest_[(columns_ - 3) % 3] : nullptr;
    const bool follows = follow(column.azimuth_mdeg, after.azimuth_mdeg);
    if (before != nullptr && !follow(before->azimuth_mdeg, column.azimuth_mdeg)) before = nullptr;
    finish(column, before, follows ? &after : nullptr, others, now_us);
  }
}

}  // namespace berm::kernel
