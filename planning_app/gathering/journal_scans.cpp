#include "gathering/journal_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <numbers>

#include "config/compile_parameters.hpp"
#include "config/strict_table.hpp"
#include "journal/journal_names.hpp"
#include "journal/journal_record.h"
#include "journal/scan_record.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double kept_s = 2.0;  // of angles; a turn of the mirror takes 0.03

// As far as it tells where the machine itself is.
MachineModel own_shape(const berm_parameters& p) {
  constexpr double mm = 1e-3;
  MachineModel machine;
  machine.boom_pin_x = p.boom_pin_x_mm * mm;
  machine.boom_pin_z = p.boom_pin_z_mm * mm;
  machine.boom_length = p.boom_length_mm * mm;
  machine.stick_length = p.stick_length_mm * mm;
  machine.bucket_length = p.bucket_length_mm * mm;
  machine.own_body_radius = p.own_body_radius_mm * mm;
  machine.self_margin = p.self_margin_mm * mm;
  for (std::int32_t i = 0; i < std::clamp(p.parts, 0, BERM_PARTS); ++i) {
    const berm_part& part = p.part[i];
    Prism prism;
    prism.link = static_cast<std::size_t>(std::clamp(part.link, 1, 3));
    prism.half_width = part.half_width_mm * mm;
    for (std::int32_t v = 0; v < std::clamp(part.vertices, 0, BERM_PART_VERTICES); ++v) prism.outline.push_back({part.vertex_mm[v][0] * mm, part.vertex_mm[v][1] * mm});
    machine.parts.push_back(std::move(prism));
  }
  return machine;
}

}  // namespace

JournalScans::JournalScans(const std::string& path) : path_(path) {
  if (!reader_.open(path)) throw PointFileError(reader_.error());
  while (reader_.next(item_) == record::McapReader::Result::kItem) {
    if (item_.kind == record::McapItem::Kind::kMessage) break;
    if (item_.kind != record::McapItem::Kind::kAttachment || item_.name != record::names::kParameters) continue;
    try {
      parameters_ = config::parse_parameters({reinterpret_cast<const char*>(item_.bytes), item_.size}, fmt::format("{}: {}", path, item_.name));
    } catch (const config::ConfigError& error) {
      throw PointFileError(error.what());
    }
    own_.emplace(own_shape(parameters_));
    return;
  }
  throw PointFileError(reader_.error().empty() ? fmt::format("{}: {}: no journal of the kernel, it begins with none", path, record::names::kParameters) : reader_.error());
}

bool JournalScans::is_journal(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;  // of a pipe what is looked at is gone
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), std::fclose);
  std::array<std::uint8_t, sizeof record::kMcapMagic> head{};
  return file != nullptr && std::fread(head.data(), 1, head.size(), file.get()) == head.size() && std::memcmp(head.data(), record::kMcapMagic, head.size()) == 0;
}

KinematicChain JournalScans::chain(std::size_t scanner) const {
  const berm_scanner_mount& mount = parameters_.scanner[scanner];
  return panning_scanner(mount.x_mm * 1e-3, mount.y_mm * 1e-3, mount.z_mm * 1e-3);
}

void JournalScans::damaged(const std::string& what) const { throw PointFileError(fmt::format("{}: cycle record {}: {}", path_, cycles_, what)); }

bool JournalScans::read_cycle() {
  for (;;) {
    const record::McapReader::Result got = reader_.next(item_);
    if (got == record::McapReader::Result::kBad) throw PointFileError(reader_.error());
    cut_off_ = got == record::McapReader::Result::kCut;
    if (got != record::McapReader::Result::kItem) return false;
    if (item_.kind != record::McapItem::Kind::kMessage || item_.name != record::names::kCycleTopic || item_.encoding != record::names::kCycleEncoding) continue;
    take_cycle(item_.bytes, item_.size);
    return true;
  }
}

void JournalScans::take_cycle(const std::uint8_t* bytes, std::size_t size) {
  record::ByteReader from(bytes, size);
  berm_journal_cycle head{};
  if (!from.copy(head) || head.magic != BERM_JOURNAL_RECORD_MAGIC || head.bytes != size) damaged("magic or bytes: not a record of a cycle");
  from.raw((std::uint64_t{head.frames_in} + head.frames_out) * sizeof(berm_journal_frame));
  take_state(head.state);
  for (int i = 0; i < head.scan_packets; ++i) {
    berm_scan_packet packet;
    if (!record::take_scan(from, packet)) damaged("scan_packets: a scan is damaged, or outside the limits of a datagram");
    take_packet(packet);
  }
  if (!from.good()) damaged("frames_in or frames_out: more than there are bytes");
  ++cycles_;
}

// A cycle in which no new angles came says the same again: a swing that moves has not stood.
void JournalScans::take_state(const berm_state& state) {
  constexpr double moves = 0.01;  // rad/s
  const double time_s = static_cast<double>(state.time_us) * 1e-6;
  if (confirmed_ms_ != UINT32_MAX && state.terrain_confirmed_ms == UINT32_MAX) begun_anew_s_ = time_s;
  confirmed_ms_ = state.terrain_confirmed_ms;
  Joints angle;
  for (std::size_t j = 0; j < joints; ++j) angle[j] = state.joint_angle_urad[j] * 1e-6;
  if (!arm_.empty()) {
    const Arm& last = arm_.back();
    if (time_s <= last.time_s) return;
    angle[swing] = last.angle[swing] + std::remainder(angle[swing] - last.angle[swing], full_turn);
    if (angle == last.angle && std::fabs(state.joint_velocity_urad_s[BERM_SWING] * 1e-6) > moves) return;
  }
  arm_.push_back({time_s, angle});
  while (arm_.front().time_s < time_s - kept_s) arm_.pop_front();
}

void JournalScans::take_packet(const berm_scan_packet& packet) {
  if ((packet.flags & (BERM_SCAN_FLAG_WINDOW_DIRTY | BERM_SCAN_FLAG_HEAD_FAULT)) != 0) return;
  Line& line = open_[packet.scanner];
  if (packet.scanline != line.scanline || packet.first_index < line.next_index) finish(packet.scanner);
  line.scanline = packet.scanline;
  line.scanner = packet.scanner;
  line.next_index = packet.first_index + packet.count;
  for (int i = 0; i < packet.count; ++i) {
    int range_mm = 0;  // of the farthest echo
    for (int echo = 0; echo < packet.echoes_per_sample; ++echo)
      if (packet.range[i][echo] > 0) range_mm = packet.range[i][echo] * BERM_SCAN_RANGE_LSB_MM;
    if (range_mm < parameters_.range_min_mm || range_mm > parameters_.range_max_mm) continue;
    const double share = packet.count > 1 ? static_cast<double>(i) / (packet.count - 1) : 0.0;
    line.samples.push_back({static_cast<double>(packet.time_us) * 1e-6 + static_cast<double>(packet.sample_period_ns) * i * 1e-9,
                            full_turn * (packet.first_index + i) / packet.samples_per_revolution,
                            (packet.pan_start_urad + share * (packet.pan_end_urad - packet.pan_start_urad)) * 1e-6, range_mm * 1e-3});
  }
  if ((packet.flags & BERM_SCAN_FLAG_LAST) != 0) finish(packet.scanner);
}

void JournalScans::finish(std::size_t scanner) {
  Line& line = open_[scanner];
  if (!line.samples.empty()) {
    line.begun_anew_s = begun_anew_s_ < line.samples.front().time_s ? begun_anew_s_ : -1.0;
    whole_.push_back(std::move(line));
  }
  line = {};
}

// Linear between the angles before and after; before the oldest and after the newest it stood.
Joints JournalScans::angles_at(double time_s) const {
  const auto after = std::lower_bound(arm_.begin(), arm_.end(), time_s, [](const Arm& a, double t) { return a.time_s < t; });
  if (after == arm_.begin()) return after->angle;
  if (after == arm_.end()) return arm_.back().angle;
  const Arm& before = *(after - 1);
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  Joints angle;
  for (std::size_t j = 0; j < joints; ++j) angle[j] = before.angle[j] + share * (after->angle[j] - before.angle[j]);
  return angle;
}

// The pan goes on while the mirror turns: each return is where its own time has it, and is laid into the plane of the middle one. What that
// moves it by, a few hundredths of a radian at a full turn's rim, is across the plane, where the angle is known least.
void JournalScans::project(const Line& line, EncodedScan& scan) {
  const Sample& middle = line.samples[line.samples.size() / 2];
  const Joints arm = angles_at(middle.time_s);
  scan.scanner = line.scanner;
  scan.time_s = middle.time_s;
  scan.begun_anew_s = line.begun_anew_s;
  scan.encoder = {arm[swing], middle.pan_rad};
  scan.returns.clear();
  own_->pose(arm);
  const KinematicChain links = chain(line.scanner);
  const Eigen::Isometry3d to_plane = links.pose(scan.encoder).inverse();
  const double c = std::cos(arm[swing]), n = std::sin(arm[swing]);
  for (const Sample& s : line.samples) {
    const std::array<double, 2> encoder{angles_at(s.time_s)[swing], s.pan_rad};
    const Eigen::Vector3d place = links.pose(encoder) * Eigen::Vector3d(s.range_m * std::cos(s.mirror_rad), s.range_m * std::sin(s.mirror_rad), 0.0);
    if (own_->holds(place.x() * c + place.y() * n, place.y() * c - place.x() * n, place.z())) continue;
    const Eigen::Vector3d p = to_plane * place;
    scan.returns.push_back({std::atan2(p.y(), p.x()), std::hypot(p.x(), p.y())});
  }
  // The mirror begins its circle ahead, at angle 0.
  std::sort(scan.returns.begin(), scan.returns.end(), [](const PolarReturn& a, const PolarReturn& b) { return a.angle_rad < b.angle_rad; });
}

bool JournalScans::next(EncodedScan& scan) {
  while (!ended_ && (whole_.empty() || arm_.empty() || whole_.front().samples.back().time_s > arm_.back().time_s)) {
    if (read_cycle()) continue;
    ended_ = true;
    for (std::size_t scanner = 0; scanner < open_.size(); ++scanner) finish(scanner);
  }
  if (whole_.empty() || arm_.empty()) return false;
  project(whole_.front(), scan);
  whole_.pop_front();
  return true;
}

}  // namespace berm::app
