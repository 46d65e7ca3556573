// Whether somebody stands in what the implements could still sweep before they stand: by the oracle's own kinematics, over the reach box that the
// kernel published (every position that a joint can take if it were told to stop a cycle from now).
#pragma once

#include <array>

#include "plant/machine/implement_shape.hpp"
#include "plant/oracle/oracle.hpp"

namespace berm::watch {

struct ReachBox { std::array<double, 4> low{}, high{}; };  // rad: swing, boom, stick, bucket

class SweptReach {
 public:
  explicit SweptReach(const plant::ImplementShape& shape) : oracle_(shape), implements_(shape.parts.size()) {}

  // To the nearest implement, m; 0 in contact.
  double distance(const std::array<double, 4>& joints, const plant::oracle::Body& body) const;
  // Whether the body meets an implement at some pose of the box: at the swing that brings the swing plane nearest the body (its corners, if it has
  // some), and at the ends and the middle of the other joints' intervals.
  bool holds(const ReachBox& box, const plant::oracle::Body& body) const;

 private:
  bool meets(const std::array<double, 4>& joints, const plant::oracle::Body& body) const;

  plant::oracle::Oracle oracle_;
  std::size_t implements_;
};

}  // namespace berm::watch
