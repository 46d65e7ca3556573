// Whether a return came from the machine itself, by the app's own kinematics: inside the cylinder of the own body, at whatever height, or within the
// machine file's self margin of a part of the implements. Metres, the upper body's frame: x ahead, y to the left, z up from the ground.
#pragma once

#include <array>
#include <vector>

#include "motion/machine_model.hpp"

namespace berm::app {

class OwnMachine {
public:
  explicit OwnMachine(const MachineModel& machine);

  // Where the implements are from here on.
  void pose(const Joints& angle);
  bool holds(double x, double y, double z) const;

private:
  struct Edge { double normal_x = 0.0, normal_z = 0.0, offset = 0.0; };  // outwards in the link's frame; of the margin's line
  struct Part {
    std::size_t link = boom;
    double half_width = 0.0;  // with the margin
    std::vector<Edge> edge;   // a point within all of them is within the margin; at a corner a little beyond it
    double reach = 0.0;       // from the link's pin
  };
  struct Link { double r = 0.0, z = 0.0, cosine = 1.0, sine = 0.0; };

  MachineModel machine_;
  std::vector<Part> part_;
  std::array<Link, joints> link_;
  double widest_ = 0.0;
};

}  // namespace berm::app
