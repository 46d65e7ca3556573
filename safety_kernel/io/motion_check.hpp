// Whether motion is permitted in this cycle: the reach box, the volume swept over it, and its clearance against the map.
//
// Any command clear: the request goes out. Else recovery: a machine slower than the creep speeds may creep on commands whose own box is
// clear. Else the machine is held, with what blocked.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "core/clearance.h"
#include "core/columns.h"
#include "core/reach_box.h"
#include "geometry/swept_slices.hpp"

namespace berm::kernel {

enum class Permission { kFull, kCreep, kHeld };

struct MotionQuery {
  std::int64_t now_us;
  std::int32_t angle_urad[4];
  std::int32_t velocity_urad_s[4];
  std::int32_t requested_urad_s[4];     // zeros when there is no usable request
  std::int32_t under_way_low_urad_s[4];  // commands sent and perhaps not yet obeyed
  std::int32_t under_way_high_urad_s[4];
};

struct MotionVerdict {
  Permission permission;
  std::uint8_t reason;                // BERM_STOP_*: why not every command is permitted; NONE with kFull
  std::int32_t command_urad_s[4];     // what may be sent
  sk_reach_box box;                   // for any command
  std::int32_t slices, cells;         // checked
  bool has_cell;                      // the next five are set
  std::int32_t blocked_x_mm, blocked_y_mm, blocked_height_mm;
  std::uint32_t blocked_link;
};

// Commands on the bus have this step; what is sent is cut to it towards zero, so that no rounding exceeds what was checked.
constexpr std::int32_t kCommandStepUradS = 500;
std::int32_t limited_command(std::int32_t requested_urad_s, std::int32_t limit_urad_s);

class MotionCheck {
 public:
  explicit MotionCheck(const berm_parameters& parameters);

  void check(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict);

  // Slices of the newest box for any command.
  const SliceSet& slices() const { return any_slices_; }

 private:
  // Box for mode; false where it cannot be bounded (speed or reach beyond the braking table).
  bool reach(const MotionQuery& query, int mode, const std::int32_t* low_urad_s, const std::int32_t* high_urad_s, sk_reach_box& box) const;
  bool joints_within(const sk_reach_box& box, const std::int32_t* low_urad_s, const std::int32_t* high_urad_s) const;
  std::uint8_t clear(const MotionQuery& query, const sk_height_map& map, const sk_reach_box& box, SliceSet& slices, bool creeping, MotionVerdict& verdict);
  std::uint8_t creep(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict);
  void note_cell(const sk_height_map& map, const sk_slice& slice, const sk_clearance_result& result, MotionVerdict& verdict) const;

  const berm_parameters& parameters_;
  const ImplementShape shape_;
  sk_clearance_rules rules_{};
  SliceSet any_slices_;
  SliceSet creep_slices_;
  sk_columns columns_;
  sk_choice choice_;
};

}  // namespace berm::kernel
