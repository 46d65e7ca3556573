#include "sweep.hpp"

#include <algorithm>
#include <cmath>

#include "figures.hpp"

namespace berm::kernel::test {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFarthest = 65535 * BERM_SCAN_RANGE_LSB_MM * 1e-3;

}  // namespace

double uniform(std::mt19937_64& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
double degrees(double value) { return value * kPi / 180.0; }

Sweep::Sweep(const berm_parameters& parameters, double swing_rad) : Sweep(parameters, {swing_rad, 0.87, -1.57, -0.70}) {}

Sweep::Sweep(const berm_parameters& parameters, const std::array<double, 4>& angle_rad) : parameters_(parameters), swing_rad_(angle_rad[0]), intake_(parameters) {
  sk_map_clear(map_.get());
  std::int32_t angle_urad[4];
  for (std::size_t j = 0; j < 4; ++j) angle_urad[j] = static_cast<std::int32_t>(std::lround(angle_rad[j] * 1e6));
  joints_.push(0, angle_urad);
}

Spot Sweep::head(int scanner) const {
  const berm_scanner_mount& mount = parameters_.scanner[scanner];
  const double x = mount.x_mm * 1e-3, y = mount.y_mm * 1e-3, c = std::cos(swing_rad_), s = std::sin(swing_rad_);
  return {x * c - y * s, x * s + y * c};
}

Spot Sweep::at(int scanner, double pan_rad, double distance) const {
  const Spot from = head(scanner);
  return {from.x + distance * std::cos(bearing(pan_rad)), from.y + distance * std::sin(bearing(pan_rad))};
}

void Sweep::pan(int scanner, double from_rad, double to_rad, double rate_rad_s, double phase) {
  run(scanner, from_rad, to_rad >= from_rad ? rate_rad_s : -rate_rad_s, std::fabs(to_rad - from_rad) / rate_rad_s, phase);
}

void Sweep::stare(int scanner, double pan_rad, double seconds, double phase) { run(scanner, pan_rad, 0.0, seconds, phase); }

// Echoes of a beam with a width: what its middle and its four edges meet, nearest first, of more than three the farthest last.
void Sweep::measure(const std::array<double, 3>& from, double pan_rad, double elevation_rad, std::uint16_t (&echo)[BERM_SCAN_ECHOES]) const {
  constexpr double kAside[5][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const double b = bearing(pan_rad), cos_b = std::cos(b), sin_b = std::sin(b), cos_e = std::cos(elevation_rad), sin_e = std::sin(elevation_rad);
  int count = 0;
  for (int i = 0; i < (beam_rad > 0.0 ? 5 : 1); ++i) {
    const double left = 0.5 * beam_rad * kAside[i][0], up = 0.5 * beam_rad * kAside[i][1];  // so small that the length stays 1
    const auto range =
        scene.range({from, {cos_e * cos_b - left * sin_b - up * sin_e * cos_b, cos_e * sin_b + left * cos_b - up * sin_e * sin_b, sin_e + up * cos_e}});
    if (!range || *range >= kFarthest) continue;
    const auto raw = static_cast<std::uint16_t>(std::max(1L, std::lround(*range * 1e3 / BERM_SCAN_RANGE_LSB_MM)));
    if (std::find(echo, echo + count, raw) != echo + count) continue;
    if (count < BERM_SCAN_ECHOES) echo[count++] = raw;
    else *std::max_element(echo, echo + count) = std::max(raw, *std::max_element(echo, echo + count));
  }
  std::sort(echo, echo + count);
}

void Sweep::run(int scanner, double from_rad, double rate_rad_s, double seconds, double phase) {
  const Spot above = head(scanner);
  const std::array<double, 3> from = {above.x, above.y, parameters_.scanner[scanner].z_mm * 1e-3};
  const auto first = static_cast<std::int64_t>(std::ceil(phase));
  const double late = static_cast<double>(first) - phase;
  const auto pan_of = [&](std::int64_t n) { return from_rad + rate_rad_s * (static_cast<double>(n) + late) * kSamplePeriod; };
  const auto samples = static_cast<std::int64_t>(seconds / kSamplePeriod);
  line_[scanner] += 2;  // another line than the one before
  for (std::int64_t n = 0; n < samples;) {
    const int index = static_cast<int>((first + n) % kSamplesPerTurn);
    if (index == 0) ++line_[scanner];
    const int count = static_cast<int>(std::min<std::int64_t>({BERM_SCAN_PACKET_SAMPLES, kSamplesPerTurn - index, samples - n}));
    berm_scan_packet p{};
    p.scanner = static_cast<std::uint8_t>(scanner);
    p.flags = index + count == kSamplesPerTurn ? BERM_SCAN_FLAG_LAST : 0;
    p.sequence = ++sequence_[scanner];
    p.scanline = line_[scanner];
    p.time_us = static_cast<std::uint64_t>(time_ns_ / 1000);
    p.sample_period_ns = static_cast<std::uint32_t>(std::lround(kSamplePeriod * 1e9));
    p.pan_start_urad = static_cast<std::int32_t>(std::lround(pan_of(n) * 1e6));
    p.pan_end_urad = static_cast<std::int32_t>(std::lround(pan_of(n + count - 1) * 1e6));
    p.first_index = static_cast<std::uint16_t>(index);
    p.samples_per_revolution = kSamplesPerTurn;
    p.count = static_cast<std::uint16_t>(count);
    p.echoes_per_sample = BERM_SCAN_ECHOES;
    p.window_percent = 100;
    for (int i = 0; i < count; ++i) measure(from, pan_of(n + i), 2 * kPi * (index + i) / kSamplesPerTurn, p.range[i]);
    n += count;
    time_ns_ += std::lround(count * kSamplePeriod * 1e9);
    send(p);
  }
  wait(0.05);  // the line's last packet, if it waits for the next one
  intake_.flush(joints_, now_us(), *map_, *blocks_);
}

void Sweep::send(const berm_scan_packet& packet) {
  const auto taken = static_cast<std::int64_t>(packet.time_us);
  if (taken >= lost_from_us && taken < lost_to_us) return;
  blocks_->count = 0;
  intake_.take(packet, joints_, now_us(), *map_, *blocks_);
  if (watch) watch();
}

Spot cell_low(int ix, int iy) { return {(SK_MAP_ORIGIN_MM + ix * SK_CELL_MM) * 1e-3, (SK_MAP_ORIGIN_MM + iy * SK_CELL_MM) * 1e-3}; }

CellRange cells_of(const std::vector<Spot>& footprint) {
  const auto [x_low, x_high] = std::minmax_element(footprint.begin(), footprint.end(), [](Spot a, Spot b) { return a.x < b.x; });
  const auto [y_low, y_high] = std::minmax_element(footprint.begin(), footprint.end(), [](Spot a, Spot b) { return a.y < b.y; });
  const auto index = [](double v) { return static_cast<int>(std::floor((v * 1e3 - SK_MAP_ORIGIN_MM) / SK_CELL_MM)); };
  return {index(x_low->x), index(x_high->x), index(y_low->y), index(y_high->y)};
}

bool in_map(const std::vector<Spot>& footprint) {
  const CellRange c = cells_of(footprint);
  return c.x_low >= 0 && c.y_low >= 0 && c.x_high < SK_MAP_CELLS && c.y_high < SK_MAP_CELLS;
}

namespace {

template <class Visit>
void each_cell(const std::vector<Spot>& footprint, Visit visit) {
  const CellRange c = cells_of(footprint);
  for (int iy = c.y_low; iy <= c.y_high; ++iy)
    for (int ix = c.x_low; ix <= c.x_high; ++ix) {
      const Spot low = cell_low(ix, iy);
      if (!clipped(footprint, low, {low.x + kCell, low.y + kCell}).empty()) visit(iy, ix);
    }
}

}  // namespace

std::int32_t highest_top(const sk_height_map& map, const std::vector<Spot>& footprint) {
  std::int32_t top = -SK_HEIGHT_MAX_MM;
  each_cell(footprint, [&](int iy, int ix) {
    if (map.seen_us[iy][ix] >= 0) top = std::max(top, sk_map_top(&map, iy, ix));
  });
  return top;
}

bool all_low(const sk_height_map& map, const std::vector<Spot>& footprint, std::int64_t not_before_us, std::int32_t top_mm) {
  bool low = true;
  each_cell(footprint, [&](int iy, int ix) { low = low && map.seen_us[iy][ix] >= std::max<std::int64_t>(0, not_before_us) && sk_map_top(&map, iy, ix) <= top_mm; });
  return low;
}

}  // namespace berm::kernel::test
