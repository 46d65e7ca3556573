#include "io/lidar_intake.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/scanline_raster.h"

namespace berm::kernel {

namespace {

// Upper body's frame, m: the return, and from there to either edge of the beam.
struct Beam {
  Eigen::Vector3d middle, beside;
};

Beam beam_of(const LidarMount& mount, const Vlp16Return& hit, double aside_rad) {
  const Vlp16Elevation elevation = vlp16_elevation(hit.channel);
  const double range_m = hit.range_mm * 1e-3, level_m = range_m * elevation.cosine;
  const Vlp16Edges edges = vlp16_edges(level_m, -static_cast<double>(hit.azimuth_mdeg) * kVlp16RadPerMdeg, aside_rad);
  return {mount.place + mount.turn * Eigen::Vector3d(edges.middle_x, edges.middle_y, range_m * elevation.sine), mount.turn * Eigen::Vector3d(edges.beside_x, edges.beside_y, 0.0)};
}

}  // namespace

LidarIntake::LidarIntake(const berm_parameters& parameters)
    : parameters_(parameters), self_(parameters), lidars_(std::clamp<int>(parameters.lidars, 0, BERM_LIDARS)) {
  for (int i = 0; i < lidars_; ++i) {
    const LidarMount mount = lidar_mount(parameters.lidar[i]);
    mount_[i].place = mount.place;
    mount_[i].turn = mount.turn;
  }
}

// A firing without a return counts: it tells of the head, not of what it sees.
void LidarIntake::Mount::note_sectors(const std::uint8_t* bytes, std::int64_t now_us) {
  static_assert(kVlp16TurnMdeg % kSectors == 0);
  for (int block = 0; block < kVlp16Blocks; ++block) sector_us[vlp16_block_mdeg(bytes, block) / (kVlp16TurnMdeg / kSectors)] = now_us;
}

bool LidarIntake::accept(Mount& mount, const std::uint8_t* bytes, std::int64_t now_us) const {
  const std::uint32_t clock_us = vlp16_clock_us(bytes);
  if (clock_us >= SensorClock::kHourUs) return false;
  const std::uint32_t ahead_us = SensorClock::ahead_us(mount.clock.clock_us(), clock_us);
  // After a silence the sensor may have counted on: then it is heard anew.
  const bool anew = mount.heard_us < 0 || now_us - mount.heard_us > parameters_.scanner_silent_us;
  if (!anew && (ahead_us == 0 || ahead_us > kAheadMaxUs)) return false;
  if (anew) mount.clock.begin(clock_us, now_us);
  else mount.clock.advance(clock_us, now_us);
  if (now_us - mount.clock.time_us() > kLateMaxUs) return false;
  mount.heard_us = now_us;
  return true;
}

void LidarIntake::insert(const Mount& mount, const Vlp16Return& hit, const Firings& firings, const Swung& swung, std::int64_t now_us, sk_height_map& map, OwnShadow& shadow) {
  const auto [middle, beside] = beam_of(mount, hit, std::max(hit.spread_mdeg, kTakenMdeg / 2) * kVlp16RadPerMdeg);
  const Eigen::Vector3d edge[2] = {middle + beside, middle - beside};
  if (!(middle.head<2>().squaredNorm() <= kFarthestM * kFarthestM)) return;
  const sk_point from = lidar_base_point(edge[0], swung.cosine, swung.sine), to = lidar_base_point(edge[1], swung.cosine, swung.sine);
  if (self_.is_own(edge[0], swung.pose) && self_.is_own(edge[1], swung.pose)) {
    // What the implements hide keeps its height. Behind ground or tracks within the own body's circle nothing is hidden that this beam could have seen.
    if (!self_.is_implement(edge[0], swung.pose)) return;
    shadow.keep(OwnShadow::kLidar, lidar_base_point(mount.place, swung.cosine, swung.sine), from, now_us, map);
    return;
  }
  if (spurious(mount, hit, firings, swung)) return;
  if (sk_raster_segment(&map, &from, &to, now_us, parameters_.generation_us) > 0) ++points_;
}

// Of a packet's returns the one of each firing and laser.
struct LidarIntake::Firings {
  explicit Firings(const Vlp16Packet& packet) {
    for (int i = 0; i < packet.count; ++i) of[packet.point[i].firing % kMost][packet.point[i].channel % kVlp16Channels] = &packet.point[i];
  }
  const Vlp16Return* at(int firing, int channel) const {
    return firing >= 0 && firing < kMost && channel >= 0 && channel < kVlp16Channels ? of[firing][channel] : nullptr;
  }
  static constexpr int kMost = kVlp16MaxPoints / kVlp16Channels;
  const Vlp16Return* of[kMost][kVlp16Channels] = {};
};

int LidarIntake::supports(const Mount& mount, const Vlp16Return& hit, const Firings& firings, int firing, int channel, const Swung& swung) const {
  const Vlp16Return* other = firings.at(firing, channel);
  if (other == nullptr || std::abs(other->range_mm - hit.range_mm) > parameters_.spurious_range_mm) return 0;
  const std::uint32_t turned_mdeg = (other->azimuth_mdeg + kVlp16TurnMdeg - hit.azimuth_mdeg) % kVlp16TurnMdeg;
  if (std::min(turned_mdeg, kVlp16TurnMdeg - turned_mdeg) > kBesideMdeg) return 0;
  return self_.is_own(beam_of(mount, *other, 0.0).middle, swung.pose) ? 0 : 1;
}

// The packet before and the next are not waited for: at an end of the packet the two firings inwards are asked.
bool LidarIntake::spurious(const Mount& mount, const Vlp16Return& hit, const Firings& firings, const Swung& swung) const {
  const int last = packet_.firings - 1, before = hit.firing == 0 ? 2 : hit.firing - 1, after = hit.firing == last ? last - 2 : hit.firing + 1;
  int supporters = supports(mount, hit, firings, before, hit.channel, swung) + supports(mount, hit, firings, after, hit.channel, swung);
  for (const int beside : {-1, 1})
    if (supporters < kSupporters) supporters += supports(mount, hit, firings, hit.firing, hit.channel + beside, swung);
  return supporters < kSupporters;
}

bool LidarIntake::take(int lidar, const std::uint8_t* bytes, std::size_t size, const JointHistory& joints, std::int64_t now_us, sk_height_map& map,
                       OwnShadow& shadow) {
  if (lidar < 0 || lidar >= lidars_ || vlp16_decode(bytes, size, packet_) != Vlp16Result::kOk) return false;
  Mount& mount = mount_[lidar];
  if (!accept(mount, bytes, now_us)) return false;
  mount.note_sectors(bytes, now_us);
  const JointAngles angles = joints.at(now_us).angles;
  const Swung swung{self_.pose(angles), std::cos(angles.swing), std::sin(angles.swing)};
  const Firings firings(packet_);
  for (int i = 0; i < packet_.count; ++i) {
    const Vlp16Return& hit = packet_.point[i];
    if (hit.azimuth_mdeg % kTakenMdeg < kVlp16FiringMdeg) insert(mount, hit, firings, swung, now_us, map, shadow);
  }
  return true;
}

bool LidarIntake::all_heard() const {
  return std::all_of(mount_, mount_ + lidars_, [](const Mount& m) { return m.turned_us() >= 0; });
}

bool LidarIntake::silent(std::int64_t now_us, std::int32_t limit_us) const {
  return all_heard() && std::any_of(mount_, mount_ + lidars_, [&](const Mount& m) { return now_us - m.heard_us > limit_us || now_us - m.turned_us() > limit_us + kTurnUs; });
}

}  // namespace berm::kernel
