// Registration of the terrain: the returns of the newest seconds against a reference of heights, at the place where they are seen and at every
// shift of up to 1.2 m in x and y, and up and down. Whether the base has slipped the core decides (core/base_slip.h) from the sums made here.
//
// The reference is the mean height of the first returns of a cell, and learns only while no shift is leant to: else it would follow a slip.
// Left out are cells that change by themselves: near the machine's own body, and dig zones with a rim. Each cell is scored once a slot, so that
// what is scanned often has no more votes. The work is spread: returns as they come, a few shifts of the last round each cycle.
//
// Not seen here: any slip over ground that looks the same from everywhere. `confirmed_us` says when every shift was last excluded.
#ifndef BERM_KERNEL_GEOMETRY_TERRAIN_REGISTRATION_HPP
#define BERM_KERNEL_GEOMETRY_TERRAIN_REGISTRATION_HPP

#include "config/parameter_block.h"
#include "core/base_slip.h"
#include "core/scanline_raster.h"

namespace berm::kernel {

class TerrainRegistration {
public:
  static constexpr int32_t cell_mm = 150;
  static constexpr int32_t shift_cells = 8;            // 1.2 m
  static constexpr int32_t near_cells = 1;             // shifts this small are within the margin: not judged
  static constexpr int32_t rise_mm = 150;              // the shifts up and down
  static constexpr int32_t range_mm = 12000;           // returns farther away are too thin
  static constexpr int32_t clip_mm = 64;               // a difference in height beyond this is one of another thing: it counts no more
  static constexpr int64_t slot_us = 500000;
  static constexpr int returns_a_cycle = 48;           // scored; all are learned from
  static constexpr int returns_a_slot = 2400;

  explicit TerrainRegistration(const berm_parameters& parameters) noexcept;

  // The map is begun anew: the reference too. Takes effect over the next cycles; costs nothing where there is nothing to forget.
  void begin() noexcept;
  // A kept return, base frame. No work in proportion to anything but itself.
  void take(const sk_point& point) noexcept;
  // Once a cycle, after its returns.
  void step(int64_t now_us) noexcept;

  bool slipped() const noexcept { return slip_.slipped; }
  int64_t confirmed_us() const noexcept { return confirmed_us_; } // when a round last excluded every shift, trusted; -1 not since the beginning
  uint32_t rounds() const noexcept { return rounds_; }            // since start
  uint32_t rounds_confirmed() const noexcept { return rounds_confirmed_; } // of these, those that excluded every shift, trusted

private:
  static constexpr int32_t half_cells = range_mm / cell_mm + shift_cells + 1;
  static constexpr int32_t side = 2 * half_cells, cells = side * side;
  static constexpr int32_t row = 2 * shift_cells + 1, level_shifts = row * row, shifts = level_shifts + 2;
  static constexpr int32_t window_slots = 8;           // 4 s are judged
  static constexpr int32_t slots = window_slots + 2;   // one that closed last, or is emptied, and one that is filled
  static constexpr int32_t group = 8, groups = (shifts + group - 1) / group; // shifts that are judged in one cycle
  static constexpr int32_t rings = 3, bearings = SK_SLIP_BLOCKS / rings;
  static constexpr int16_t unknown = INT16_MIN;
  static constexpr uint8_t left_out = 255, learn_returns = 16, least_returns = 3;
  static_assert(level_shifts - (2 * near_cells + 1) * (2 * near_cells + 1) + 2 == SK_SLIP_SHIFTS);
  static_assert(SK_SLIP_BLOCKS < left_out && rings * bearings == SK_SLIP_BLOCKS);
  static_assert((clip_mm * clip_mm) >> 4 == 256); // agreement in 256ths: see Sums
  static_assert(static_cast<int64_t>(window_slots) * returns_a_slot * 256 * 256 <= INT32_MAX); // no sum of a window overflows

  // Of one block: for each shift by how much its returns agree better there than here, and the squares of that. A cache line for a group.
  struct alignas(64) Sums {
    int32_t net[group], square[group];
  };

  uint8_t block_of(const berm_parameters& parameters, int32_t ix, int32_t iy) const noexcept;
  void score(int32_t cell, int32_t height_mm, Sums* sums) const noexcept;
  void learn(int32_t cell, int32_t height_mm) noexcept;
  void judge_group(int64_t now_us) noexcept;
  void judge(int32_t shift, int32_t votes, int32_t blocks, int64_t now_us) noexcept;
  void forget() noexcept;

  uint8_t block_[cells];         // of a cell, or left_out
  int16_t reference_mm_[cells];  // unknown until least_returns
  uint8_t returns_[cells];       // that the reference is made of
  int32_t total_mm_[cells];      // their sum
  uint32_t scored_[cells];       // number of the slot in which a return of this cell was last scored
  Sums slot_[slots][SK_SLIP_BLOCKS][groups];
  Sums window_[SK_SLIP_BLOCKS][groups]; // the newest window_slots closed ones together
  sk_slip_state slip_;

  int32_t forgetting_ = 0;       // slots still to be emptied, after begin
  bool fresh_ = true;            // nothing was taken since
  int32_t filling_ = 0;          // slot that takes the returns
  uint32_t slot_number_ = 1;
  int32_t judging_ = groups;     // group to be judged next, and moved on to the slot that closed last; groups: none
  int64_t slot_ends_us_ = -1;
  int scored_in_cycle_ = 0, scored_in_slot_ = 0;
  int64_t confirmed_us_ = -1;
  uint32_t rounds_ = 0, rounds_confirmed_ = 0;
};

} // namespace berm::kernel
#endif
