// The script of one loading pass and its parameters: right-hand sides by kinematics, left-hand sides by the joint models.
#pragma once

#include <optional>

#include "motion/arm_controller.hpp"
#include "motion/arm_kinematics.hpp"
#include "motion/script.hpp"
#include "planning/script_set.hpp"
#include "planning/skyline.hpp"

namespace berm::app {

// What a pass has to do. Poses' swing entries are not used.
struct PassTask {
  Joints lifted_from{};        // measured when digging finished
  double truck_bearing = 0.0;  // swing angle over the dump point
  double dump_radius = 0.0;    // of the dump point from the swing axis
  double next_bearing = 0.0;   // swing angle of the next dig
  PlanePoint next_entry{};     // where the next drag begins (tip)
  double truck_top = 0.0;      // z of the highest thing under the swing near the truck; never taken as lower than its walls,
  double wall_top = 0.0;       // which end here
  double open_farther = 0.0;   // rad, than the bucket otherwise opens: soil sticks; as far as its range allows
  double brake_empty = 0.0;    // rad/s2 that landings of the empty swing are planned with at least (SwingBraking)
  bool lower_at_end = true;    // false: stay high after the pass, the truck is full
};

// Right-hand sides.
struct PassPoses { Joints carry{}, spill{}, dump{}, back{}, hover{}, dig{}; };

// Left-hand sides.
struct PassThresholds {
  double swing_start_boom = 0.0;   // boom angle above which the swing to the truck begins
  double fold_boom = 0.0;          // ... above which the stick folds to the carrying pose
  double extend_offset = 0.0;      // the stick moves to the spill point this far before the truck's bearing
  double open_offset = 0.0;        // the bucket opens this far before it
  double open_stick = 0.0;         // ... and with the stick beyond this
  double pour_bucket = 0.0;        // bucket angle above which the load pours: the stick moves to the dump point
  double hover_offset = 0.0;       // boom, stick and bucket reach out over the dig this far before its bearing
  double lower_offset = 0.0;       // ... and go down to where the drag begins
};

// The bucket's attitude at the spill point, where nothing slides yet; up to which little slides; and from which on the load does.
inline constexpr double attitude_spill = radians(-170.0), attitude_rests = radians(-157.0), attitude_pour = radians(-145.0);

// m, tip over the bench's level while the swing lands: heaps on the crest, the margin, the spread of a stop. The search finds lower ones.
inline constexpr double hover_highest = 1.60;
std::optional<Joints> hover_pose(const MachineModel& machine, const PassTask& task, double above);

// Nothing when the dump point is out of reach.
std::optional<PassPoses> pass_poses(const MachineModel& machine, const PassTask& task);

// Boom and stick while a part of a load is poured, the bucket at this attitude: at the spill point, and drawn in as the bucket tilts on, for its lip is not to go far
// beyond the dump point, even if the bucket is 15 degrees on when they are there. What slides last would else fall beside the far wall, and off a heap that stands over it. Bucket and swing as of the spill point.
Joints part_pose(const MachineModel& machine, const PassTask& task, const PassPoses& poses, double bucket_attitude);

// The farthest dump point from the swing axis, m: from there the stretched arm spills the load 0.25 m short of where it is meant to be.
double farthest_dump(const MachineModel& machine, double wall_top);

// Share of a heaped bucket that may be dumped that far from the swing axis. Where the stretched arm cannot hold the bucket level a heap slides off before the
// lip is over the bed; what lies lower in the bucket stays longer.
double share_at_reach(const MachineModel& machine, double wall_top, double radius);

// Bucket angle that holds a load, mouth up, with the stick at an attitude (boom and stick together); as near to it as the bucket's range allows.
double level_bucket(const MachineModel& machine, double stick_attitude);

// Parameters of the script "pass" by name.
std::vector<ScriptAngle> pass_angles(const MachineModel& machine, const PassTask& task, const PassPoses& poses, const PassThresholds& thresholds);
Script pass_script(const ScriptSet& scripts, const MachineModel& machine, const PassTask& task, const PassPoses& poses, const PassThresholds& thresholds);

// From wherever the implements are to a bearing: raise and half curl, swing when high; and to the start of a dig: lower when over it.
struct ApproachTask {
  Joints from{};
  double bearing = 0.0;             // swing angle
  double top = 0.0;                 // z of what is passed over
  std::optional<PlanePoint> entry;  // where the drag begins; without: stay high
  bool keeps_load = false;          // the bucket stays level on the way
};
// High and folded, over what is as high as top (z). Nothing where the machine cannot stand so.
std::optional<Joints> raised_pose(const MachineModel& machine, double top, bool keeps_load);
// Where the implements are over the way, and at its end. Swing entries are not used.
struct ApproachPoses { Joints back{}, end{}; };
// Parameters of the script "approach" by name.
std::vector<ScriptAngle> approach_angles(const ApproachTask& task, const ApproachPoses& poses);
std::optional<Script> approach_script(const ScriptSet& scripts, const MachineModel& machine, const ApproachTask& task);

}  // namespace berm::app
