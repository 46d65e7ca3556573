// What a ray weighs as evidence of a bed: a return on a face that is predicted weighs 1.
#pragma once

namespace berm::app {

constexpr double kInside = 0.08;   // a return somewhere inside
constexpr double kThrough = 4.0;   // a ray through a wall, or a return deeper than any floor
constexpr double kTop = 0.4;       // a return on a wall's top: a load that is level with it has as many
constexpr double kAbove = 1.0;     // a return where a wall goes on above its top
constexpr double kAboveInner = 0.05, kAboveInnerMost = 0.35, kInnerGate = 0.09;  // m: the same on inner faces; of the return from the face
constexpr double kLevel = 0.15;    // a return over the opening in the plane of the tops: a lid
constexpr double kUpright = 1.0;    // an upright surface within the opening, over the load or in it: soil lies flatter
constexpr double kCabShare = 1.0;  // of the bed's evidence, at most
constexpr double kCabEnough = 60.0;  // of a cab and of an end's outer face: that there is one; more says no more of where the bed ends
constexpr double kTiltUsual = 0.03;  // rad, of a bed that stands on ground a truck can back up on: costs a ray
constexpr double kOpenEnd = 12.0;  // for an end without a wall: a wall more would explain less

constexpr double kWallSeen = 0.6;    // m below the top down to which every class has wall, a half pipe within the gate
constexpr double kPipeUpright = 0.08;  // m below the top down to which a half pipe's side is upright
constexpr double kRangeGate = 0.12;  // m, four standard deviations of a range
constexpr double kTopGate = 0.15;    // m, along the ray
constexpr double kLevelWithin = 0.05, kLevelMargin = 0.3;  // m
constexpr double kDeepest = 2.1;     // m below the tops: no floor lies so deep

constexpr double kUprightMargin = 0.2;       // m from the walls' inner faces
constexpr double kUprightAbove = 1.6;        // m over the tops up to which it counts
constexpr double kHeapSlope = 0.78, kHeapOver = 0.15;  // a heap rises no steeper from the walls' inner edges; m over that

constexpr double kSensorClear = 1.0;         // m in plan between sensor and bed

// How far from every wall a return so high over the tops must lie to be of a heap, m; 0: anywhere.
inline double heap_margin(double over_tops) { return over_tops <= kHeapOver ? 0.0 : (over_tops - kHeapOver) / kHeapSlope; }

// Returns on one outer face tell less the more there are: a cab, a container or a wall has as many.
constexpr double kFaceFull = 200.0, kFaceBeyond = 0.3;
inline double saturated(double face) { return face <= kFaceFull ? face : kFaceFull + kFaceBeyond * (face - kFaceFull); }

// Of a bed that tilts, rad.
inline double tilt_cost(double pitch, double roll) { return (pitch * pitch + roll * roll) / (kTiltUsual * kTiltUsual); }

// Of a return so far off a predicted surface, within the gate.
inline double fit(double off, double gate) { return 1.0 - off * off / (gate * gate); }

}  // namespace berm::app
