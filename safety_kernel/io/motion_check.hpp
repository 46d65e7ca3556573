// What motion is permitted in this cycle: the reach box, the volume swept over it, its clearance against the map, and the governor.
//
// The box is that of the commands sent and perhaps still under way and of the one to be sent, and of a stop after it: from when angles and velocities
// were read, and until the machine would brake by itself if no other command came (a kernel that is late, or dead). Clear: the request goes
// out, its swing cut to the speed for which there is room ahead. Else the same with the request slowed. Else recovery: a machine slower than
// the creep speeds may creep, by the same rule. Else the machine is held, with what blocked.
// Where it is slower near a truck's lane, a request at the speed elsewhere that would come near one is cut to the speed there.
// Where ISO 13855's distance is enforced, the request is cut to the speeds from which the machine stands in the time left, and nothing goes out from
// which it does not.
#pragma once

#include <cstdint>

#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "core/clearance.h"
#include "core/columns.h"
#include "core/governor.h"
#include "core/reach_box.h"
#include "core/speed_share.h"
#include "geometry/swept_slices.hpp"
#include "io/own_cells.hpp"
#include "io/sector_watch.hpp"

namespace berm::kernel {

enum class Permission { kFull, kGoverned, kCreep, kHeld };

struct MotionQuery {
  std::int64_t now_us;
  std::int64_t late_us;                  // how much older than the state latency angle and velocity may be
  std::int32_t angle_urad[4];
  std::int32_t velocity_urad_s[4];
  std::int32_t requested_urad_s[4];     // zeros when there is no usable request
  std::int32_t under_way_low_urad_s[4];  // commands sent and perhaps not yet obeyed
  std::int32_t under_way_high_urad_s[4];
  bool truck_admitted;                   // by the spotter, now: trucks in the truck zones may be passed over
  const SectorWatch* sectors;            // null: the separation is not evaluated
  std::int32_t speed_permille = SK_WHOLE_PERMILLE;       // of each joint's largest speed, that may be asked for
  std::int32_t lane_speed_permille = SK_WHOLE_PERMILLE;  // the same where what is asked for could come near a lane
};

struct MotionVerdict {
  Permission permission;
  std::uint8_t reason;                // BERM_STOP_*: why the request is not permitted; NONE with kFull
  std::int32_t command_urad_s[4];     // what may be sent
  std::int32_t permitted_low_urad_s[4], permitted_high_urad_s[4];  // around zero: what was cut was cut to this
  sk_reach_box box;                   // that was certified; of the request when held
  std::int32_t slices, cells;         // checked
  bool has_cell;                      // the next five are set
  std::int32_t blocked_x_mm, blocked_y_mm, blocked_height_mm;
  std::uint32_t blocked_link;
  bool separation_known;              // the next is set
  sk_separation separation;           // for the box
};

class MotionCheck {
 public:
  MotionCheck(const berm_parameters& parameters, const OwnCells& own_cells);

  void check(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict);

  // Slices of the newest box of the request.
  const SliceSet& slices() const { return request_slices_; }

 private:
  struct Commands {
    std::int32_t send_urad_s[4];
    std::int32_t low_urad_s[4], high_urad_s[4];  // with those under way
  };

  // Box of the commands; false where it cannot be bounded (speed or reach beyond the braking table).
  bool reach(const MotionQuery& query, const Commands& commands, sk_reach_box& box) const;
  // The arm folds in, or stands, and the swing stands, by commands and as measured. Only so may the dig-zone rule take stale ground as it was last seen, or a bucket that stood in a
  // pit, and hides the ground before it, could never leave; to either side, or outward, somebody may have come since.
  bool folds(const MotionQuery& query, const Commands& commands) const;
  bool joints_within(const sk_reach_box& box, const Commands& commands) const;
  // ahead: of the room ahead, beyond the box.
  std::uint8_t clear_one(const sk_height_map& map, SliceSet& slices, std::int32_t index, bool ahead, sk_clearance_result& result, MotionVerdict& verdict);
  std::uint8_t clear(const MotionQuery& query, const sk_height_map& map, const sk_reach_box& box, SliceSet& slices, bool dig_stale, MotionVerdict& verdict);
  Commands commands(const MotionQuery& query, std::int32_t percent, bool creeping) const;
  std::uint8_t judge(const MotionQuery& query, const sk_height_map& map, const Commands& commands, SliceSet& slices, bool creeping, MotionVerdict& verdict);
  bool slower(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict);
  // Room (urad from the measured angle) that is clear in the swing's direction of the request, as far as the box and wanted reach.
  std::int64_t room_ahead(const MotionQuery& query, const sk_height_map& map, std::int64_t wanted_urad, MotionVerdict& verdict);
  void govern_swing(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict);
  void cut_to_share(MotionQuery& query, std::int32_t permille) const;
  // Something that the request sweeps before standstill is near a lane, or nothing is known of what it sweeps.
  bool sweeps_near_lane(const MotionQuery& query);
  // What the separation leaves of the request; false where no joint may move at all.
  bool separate(MotionQuery& query, MotionVerdict& verdict) const;
  // Whether everything that moves, or may by the verdict's commands, stands in the time that the separation leaves over the verdict's box.
  bool stands_in_time(const MotionQuery& query, MotionVerdict& verdict) const;
  void certify(const MotionQuery& query, const sk_height_map& map, MotionVerdict& verdict);
  bool limit_overpass(bool truck_admitted);
  bool make_columns(const sk_height_map& map);
  std::int32_t tail_ahead_fresh_us() const;
  bool make_tail_ahead_columns(const sk_height_map& map);
  void note_cell(const sk_height_map& map, const sk_slice& slice, const sk_clearance_result& result, MotionVerdict& verdict) const;

  berm_parameters parameters_;  // cycle_us and state_latency_us are those of this cycle's box
  const std::int32_t state_latency_us_;
  const ImplementShape shape_;
  const OwnCells& own_cells_;
  sk_clearance_rules rules_{};
  bool limited_ = false, truck_admitted_ = false;  // what the overpass limits of the rules are made for
  SliceSet request_slices_;
  SliceSet other_slices_;  // of the room ahead, of a slower request, or of what may come near a lane
  sk_columns columns_;
  sk_columns tail_columns_;        // by the tail's own freshness; made only where it is watched
  sk_columns tail_ahead_columns_;  // by that of the room ahead of it; made only when that is asked for
  sk_choice choice_;
};

}  // namespace berm::kernel
