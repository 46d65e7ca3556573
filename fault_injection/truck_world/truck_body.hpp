// A truck's body: its sizes drawn from a class, its opening, and its triangles.
// Truck frame: origin on the ground under the middle of the bed, x along the bed's long axis to the cab, y left, z up. Metres.
#pragma once

#include <array>

#include "truck_world/mesh.hpp"
#include "truck_world/random_streams.hpp"
#include "truck_world/truck_class.hpp"

namespace berm::truck_world {

struct TruckBody {
  BedShape bed = BedShape::box;
  bool tracks = false;
  double length = 0.0, width = 0.0, wall_height = 0.0;  // inside; floor to top of the walls
  double wall_thickness = 0.0;
  double floor_height = 0.0;                            // over the ground
  Tailgate tailgate = Tailgate::up;
  bool canopy = false;
  double canopy_length = 0.0, canopy_rise = 0.0;
  double cab_gap = 0.0, cab_length = 0.0, cab_top = 0.0;
  double mud = 0.0;                                     // thickest on the walls

  [[nodiscard]] double top() const { return floor_height + wall_height; }
  [[nodiscard]] double front() const { return length / 2 + wall_thickness + cab_gap + cab_length; }  // x of the foremost point
  [[nodiscard]] double outer_width() const { return width + 2 * wall_thickness; }
  // Height of the bed's floor over floor_height at y; |y| <= width / 2.
  [[nodiscard]] double floor_rise(double y) const;
  // Level full, m3.
  [[nodiscard]] double struck_volume() const;
};

// Within every range of its class.
TruckBody draw_truck_body(const TruckClass& truck_class, Random& random);

// On the inner top edge of the walls, in order round the opening, counter-clockwise from above: front left, rear left, rear right, front right.
// Without a tailgate, or with it down, the rear ones are the rear ends of the side walls' inner top edges.
std::array<Vector3d, 4> opening_corners(const TruckBody& body);

// Walls, floor, canopy, cab, chassis and wheels, in the truck frame. Mud never reaches the inner top edge.
Mesh truck_mesh(const TruckBody& body, Random& mud);

}  // namespace berm::truck_world
