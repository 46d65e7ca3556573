// The outline of a part's sweep in the swing plane, for all parts over one reach box.
#ifndef BERM_KERNEL_GEOMETRY_PART_OUTLINE_HPP
#define BERM_KERNEL_GEOMETRY_PART_OUTLINE_HPP

#include "config/parameter_block.h"
#include "core/clearance.h"
#include "core/reach_box.h"
#include "geometry/tail_sweep.hpp"

namespace berm::kernel {

inline constexpr int sweep_directions = SK_SLICE_VERTICES / 2; // edges of a slice's outline in the swing plane

// All in the frame turned to the middle of a slice's swing interval: r (x) forward, y left, z up, mm.
struct PartOutline {
  // Corner i, between edges i and i + 1; its distance to either side of the swing plane.
  float x_mm[sweep_directions], side_mm[sweep_directions];
  int32_t z_mm[sweep_directions];
  int32_t z_low_mm;
  // Edge i: outward normal, and how far out it lies.
  float normal_r[sweep_directions], normal_z[sweep_directions], offset_mm[sweep_directions];
  float side_offset_mm;      // of the planes (sin half, -+cos half) at the sides
  float x_low_mm, x_high_mm; // of the corners
  float reach_squared;       // no point of the part, width included, is farther from the swing axis; mm^2
  int32_t link;
};

// What of the parts' shapes does not change with the joints: worked out once. Of each vertex, in the directions of the outline's edges, how far it lies along
// and across. The edges keep to the link, tilted against it so that the outline of the part by itself is smallest.
class ImplementShape {
public:
  explicit ImplementShape(const berm_parameters& parameters) noexcept;

  struct Vertex {
    float along[sweep_directions], across[sweep_directions]; // the latter in magnitude
    float radius[4]; // four times the same
  };
  struct Part {
    int32_t link; // 0 where the part is malformed
    float tilt_cosine, tilt_sine; // of the first edge's normal against the link's x axis
    float half_width_mm, reach_mm; // farthest that a point of the part can ever be from the swing axis, the width left out
    Vertex vertex[BERM_PART_VERTICES]; // the last is repeated
  };

  int32_t parts = 0; // 0 where there are none or too many
  float pin_x_mm, pin_z_mm, length_mm[2];
  Part part[BERM_PARTS];
  TailShape tail;
};

// The joints' absolute elevations over a box, as PartSweep has them (part_sweep.hpp), which is the exact statement that this one is held against.
class BoxSweep {
public:
  // False where an interval is malformed. half_swing_rad: of a slice.
  bool set(const sk_reach_box& box, double half_swing_rad) noexcept;
  // False where the part is malformed, or its height leaves the core's range.
  bool outline(const ImplementShape& shape, int part, PartOutline& out) const noexcept;

  float cos_half() const noexcept { return cosine_[6]; }
  float sin_half() const noexcept { return sine_[6]; }

private:
  float tan_half_ = 0.0F, over_cos_half_ = 1.0F, sagitta_ = 0.0F;
  float cosine_[8], sine_[8]; // of the links' mean elevations, then of half their intervals, then of half the swing
};

} // namespace berm::kernel
#endif
