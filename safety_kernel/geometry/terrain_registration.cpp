#include "geometry/terrain_registration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace berm::kernel {
namespace {

constexpr int32_t zone_rim_mm = 500; // soil slides beyond a dig zone's edge
constexpr int64_t ring_mm[2] = {5500, 8500};

int32_t disagreement(int32_t difference_mm) noexcept {
  const int32_t d = std::min(std::abs(difference_mm), TerrainRegistration::clip_mm);
  return d * d >> 4;
}

bool near_shift(int32_t dx, int32_t dy) noexcept {
  return std::abs(dx) <= TerrainRegistration::near_cells && std::abs(dy) <= TerrainRegistration::near_cells;
}

} // namespace

TerrainRegistration::TerrainRegistration(const berm_parameters& parameters) noexcept {
  for (int32_t iy = 0; iy < side; ++iy)
    for (int32_t ix = 0; ix < side; ++ix) block_[iy * side + ix] = block_of(parameters, ix, iy);
  std::memset(slot_, 0, sizeof slot_);
  forget();
}

uint8_t TerrainRegistration::block_of(const berm_parameters& parameters, int32_t ix, int32_t iy) const noexcept {
  const int64_t x = (static_cast<int64_t>(ix) - half_cells) * cell_mm + cell_mm / 2, y = (static_cast<int64_t>(iy) - half_cells) * cell_mm + cell_mm / 2;
  const int64_t square = x * x + y * y, own = parameters.own_body_radius_mm;
  if (square < own * own || square > static_cast<int64_t>(range_mm) * range_mm) return left_out;
  for (int32_t z = 0; z < std::min(parameters.dig_zones, BERM_DIG_ZONES); ++z) {
    const berm_dig_zone& zone = parameters.dig_zone[z];
    if (x > zone.x_low_mm - zone_rim_mm && x < zone.x_high_mm + zone_rim_mm && y > zone.y_low_mm - zone_rim_mm && y < zone.y_high_mm + zone_rim_mm) return left_out;
  }
  constexpr double pi = 3.14159265358979323846;
  const double turn = (std::atan2(static_cast<double>(y), static_cast<double>(x)) + pi) / (2 * pi);
  const int bearing = std::min(static_cast<int>(turn * bearings), bearings - 1);
  const int ring = square < ring_mm[0] * ring_mm[0] ? 0 : square < ring_mm[1] * ring_mm[1] ? 1 : 2;
  return static_cast<uint8_t>(ring * bearings + bearing);
}

void TerrainRegistration::begin() noexcept {
  if (fresh_) return;
  fresh_ = true;
  forgetting_ = slots;
  sk_slip_begin(&slip_); // at once: what slipped is past
  confirmed_us_ = -1;
}

void TerrainRegistration::forget() noexcept {
  std::fill(reference_mm_, reference_mm_ + cells, unknown);
  std::memset(returns_, 0, sizeof returns_);
  std::memset(total_mm_, 0, sizeof total_mm_);
  std::memset(scored_, 0, sizeof scored_);
  std::memset(window_, 0, sizeof window_);
  sk_slip_begin(&slip_);
  filling_ = 0;
  slot_number_ = 1;
  judging_ = groups;
  slot_ends_us_ = -1;
  scored_in_slot_ = 0;
}

void TerrainRegistration::take(const sk_point& point) noexcept {
  if (forgetting_ > 0 || std::abs(point.x_mm) > range_mm || std::abs(point.y_mm) > range_mm) return;
  const int32_t ix = (point.x_mm + half_cells * cell_mm) / cell_mm, iy = (point.y_mm + half_cells * cell_mm) / cell_mm;
  const int32_t cell = iy * side + ix;
  const uint8_t block = block_[cell];
  if (block == left_out) return;
  fresh_ = false;
  const bool room = scored_in_cycle_ < returns_a_cycle && scored_in_slot_ < returns_a_slot;
  if (room && reference_mm_[cell] != unknown && scored_[cell] != slot_number_) {
    ++scored_in_cycle_;
    ++scored_in_slot_;
    scored_[cell] = slot_number_;
    score(cell, point.z_mm, slot_[filling_][block]);
  }
  if (slip_.learns && returns_[cell] < learn_returns) learn(cell, point.z_mm);
}

void TerrainRegistration::score(int32_t cell, int32_t height_mm, Sums* sums) const noexcept {
  const int32_t here = disagreement(height_mm - reference_mm_[cell]);
  int32_t better[groups * group] = {};
  for (int32_t dy = -shift_cells; dy <= shift_cells; ++dy) {
    const int16_t* there = reference_mm_ + cell + dy * side - shift_cells;
    int32_t* to = better + (dy + shift_cells) * row;
    for (int32_t i = 0; i < row; ++i) to[i] = there[i] == unknown ? 0 : here - disagreement(height_mm - there[i]);
  }
  for (int32_t i = 0; i < 2; ++i) better[level_shifts + i] = here - disagreement(height_mm - reference_mm_[cell] - (2 * i - 1) * rise_mm);
  for (int32_t g = 0; g < groups; ++g) {
    for (int32_t i = 0; i < group; ++i) {
      const int32_t b = better[g * group + i];
      sums[g].net[i] += b;
      sums[g].square[i] += b * b;
    }
  }
}

void TerrainRegistration::learn(int32_t cell, int32_t height_mm) noexcept {
  total_mm_[cell] += height_mm;
  ++returns_[cell];
  if (returns_[cell] >= least_returns) reference_mm_[cell] = static_cast<int16_t>(total_mm_[cell] / returns_[cell]);
}

void TerrainRegistration::judge(int32_t shift, int32_t votes, int32_t blocks, int64_t now_us) noexcept {
  if (shift >= shifts || (shift < level_shifts && near_shift(shift % row - shift_cells, shift / row - shift_cells))) return;
  if (!sk_slip_judge(&slip_, votes, blocks)) return;
  ++rounds_;
  if (!slip_.confirmed || slip_.trust < SK_SLIP_TRUST_LEAST) return;
  ++rounds_confirmed_;
  confirmed_us_ = now_us;
}

// The window takes in the slot that closed last and lets go of the oldest, which is emptied: it is filled next.
void TerrainRegistration::judge_group(int64_t now_us) noexcept {
  const int32_t closed = (filling_ + slots - 1) % slots, oldest = (filling_ + 1) % slots;
  int32_t votes[group] = {}, blocks[group] = {};
  for (int32_t b = 0; b < SK_SLIP_BLOCKS; ++b) {
    Sums& window = window_[b][judging_];
    Sums& out = slot_[oldest][b][judging_];
    const Sums& in = slot_[closed][b][judging_];
    for (int32_t i = 0; i < group; ++i) {
      window.net[i] += in.net[i] - out.net[i];
      window.square[i] += in.square[i] - out.square[i];
    }
    out = Sums{};
    for (int32_t i = 0; i < group; ++i) {
      if (window.square[i] < SK_SLIP_LEAST_SQUARE) continue;
      ++blocks[i];
      votes[i] += sk_slip_vote(window.net[i], window.square[i]);
    }
  }
  for (int32_t i = 0; i < group; ++i) judge(judging_ * group + i, votes[i], blocks[i], now_us);
  ++judging_;
}

void TerrainRegistration::step(int64_t now_us) noexcept {
  scored_in_cycle_ = 0;
  if (forgetting_ > 0) {
    --forgetting_;
    std::memset(slot_[forgetting_], 0, sizeof slot_[forgetting_]);
    if (forgetting_ == 0) forget();
    return;
  }
  if (slot_ends_us_ < 0) slot_ends_us_ = now_us + slot_us;
  if (judging_ < groups) {
    judge_group(now_us);
  } else if (now_us >= slot_ends_us_) {
    filling_ = (filling_ + 1) % slots;
    ++slot_number_;
    scored_in_slot_ = 0;
    slot_ends_us_ = now_us + slot_us;
    judging_ = 0;
  }
}

} // namespace berm::kernel
