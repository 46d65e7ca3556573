#include "perception/scanline_processor.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

const ScanReturn nothing{};

bool follows(const ScanlinePart& before, const ScanlinePart& after) {
  return before.scanline == after.scanline && before.samples_per_revolution == after.samples_per_revolution &&
         before.first_index + before.count == after.first_index;
}

}  // namespace

KinematicChain scanner_chain(const ScannerMount& mount) { return panning_scanner(mount.x, mount.y, mount.z); }

bool well_formed(const berm_scan_block& block) {
  constexpr std::int64_t latest_us = 1'000'000'000'000'000;
  constexpr std::uint32_t longest_period_ns = 10'000'000;
  constexpr std::int32_t most_pan_urad = 6'283'186;
  const auto within = [](std::int32_t urad) { return urad >= -most_pan_urad && urad <= most_pan_urad; };
  return block.scanner < BERM_SCANNERS && block.count >= 1 && block.count <= BERM_SCAN_BLOCK_SAMPLES && block.samples_per_revolution >= 1 &&
         block.first_index + block.count <= block.samples_per_revolution &&
         block.sample_period_ns >= 1 && block.sample_period_ns <= longest_period_ns &&
         block.time_us >= 0 && block.time_us <= latest_us && within(block.pan_start_urad) && within(block.pan_end_urad);
}

ScanlineProcessor::ScanlineProcessor(const MachineModel& machine)
    : machine_(machine), chain_{scanner_chain(machine.scanner[0]), scanner_chain(machine.scanner[1])}, own_(machine) {}

void ScanlineProcessor::locate(const berm_scan_block& block, const MachineHistory& history, ScanlinePart& part) {
  part.scanner = block.scanner;
  part.scanline = block.scanline;
  part.first_index = block.first_index;
  part.samples_per_revolution = block.samples_per_revolution;
  part.count = block.count;
  const std::int64_t begin_ns = block.time_us * 1000;
  // In half a block's time the implements move by less than 0.05 m, of a margin of 0.3.
  if (const auto middle = history.at(begin_ns + std::int64_t{block.sample_period_ns} * block.count / 2)) {
    own_.pose(middle->angle);
    part.swing = middle->angle[swing];
  }
  const double pan_start = block.pan_start_urad * 1e-6, pan_end = block.pan_end_urad * 1e-6;
  for (int i = 0; i < part.count; ++i) {
    ScanReturn& s = part.sample[static_cast<std::size_t>(i)];
    s = {};
    const std::int64_t time_ns = begin_ns + std::int64_t{block.sample_period_ns} * i;
    s.time_s = static_cast<double>(time_ns) * 1e-9;
    const double range = block.range_mm[i] * 1e-3;
    if (range < machine_.range_min || range > machine_.range_max) continue;
    const auto pose = history.at(time_ns);
    if (!pose) continue;
    const double share = part.count > 1 ? static_cast<double>(i) / (part.count - 1) : 0.0;
    const std::array<double, 2> joint{pose->angle[swing], pan_start + share * (pan_end - pan_start)};
    const double mirror = full_turn * (part.first_index + i) / part.samples_per_revolution;
    const Eigen::Vector3d point = chain_[part.scanner].pose(joint) * Eigen::Vector3d(range * std::cos(mirror), range * std::sin(mirror), 0.0);
    s.range = range;
    s.x = point.x();
    s.y = point.y();
    s.z = point.z();
    s.several_echoes = block.echoes[i] > 1;
    const double c = std::cos(joint[0]), sn = std::sin(joint[0]);
    s.own = own_.holds(s.x * c + s.y * sn, s.y * c - s.x * sn, s.z);
    if (pose->neighbours) check_.compare(part.scanner, s.time_s, {s.x, s.y, s.z}, block.point_mm[i]);
  }
}

// Supported: by a neighbour as far away, or by lying between two, as ground that recedes does, however steeply. The own machine supports nothing.
void ScanlineProcessor::judge(Line& line, const ScanlinePart* after) const {
  ScanlinePart& part = line.part;
  const auto sample = [&](int i) -> const ScanReturn& {
    if (i < 0) return line.before[static_cast<std::size_t>(-i - 1)];
    if (i < part.count) return part.sample[static_cast<std::size_t>(i)];
    return after != nullptr && i - part.count < after->count ? after->sample[static_cast<std::size_t>(i - part.count)] : nothing;
  };
  const auto beside = [&](int i, int way) -> const ScanReturn& {
    for (int k = 1; k <= neighbours; ++k)
      if (const ScanReturn& s = sample(i + k * way); s.range > 0.0) return s;
    return nothing;
  };
  for (int i = 0; i < part.count; ++i) {
    ScanReturn& s = part.sample[static_cast<std::size_t>(i)];
    if (!s.usable()) continue;
    const ScanReturn &left = beside(i, -1), &right = beside(i, 1);
    const auto agrees = [&](const ScanReturn& n) { return n.usable() && std::fabs(n.range - s.range) <= machine_.spurious_range; };
    const bool between = left.usable() && right.usable() && (left.range - s.range) * (right.range - s.range) <= 0.0;
    s.lone = !agrees(left) && !agrees(right) && !between;
  }
}

std::span<const ScanlinePart> ScanlineProcessor::take(const berm_scan_block& block, const MachineHistory& history) {
  ScanlinePart part;
  locate(block, history, part);
  Line& line = line_[part.scanner];
  const bool chained = line.part.count > 0 && follows(line.part, part);
  std::size_t finished = 0;
  if (line.waiting) {
    judge(line, chained ? &part : nullptr);
    finished_[finished++] = line.part;
  }
  for (int k = 0; k < neighbours; ++k) {
    const int i = line.part.count - 1 - k;
    line.before[static_cast<std::size_t>(k)] = chained && i >= 0 ? line.part.sample[static_cast<std::size_t>(i)] : nothing;
  }
  line.part = part;
  line.waiting = part.first_index + part.count < part.samples_per_revolution;
  if (!line.waiting) {
    judge(line, nullptr);
    finished_[finished++] = line.part;
  }
  return {finished_.data(), finished};
}

}  // namespace berm::app
