#include "app/recognised_bed.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

TruckBed recognised_bed(const RecognisedTruck& truck) {
  TruckBed bed;
  bed.centre_x = truck.pose.middle.x();
  bed.centre_y = truck.pose.middle.y();
  bed.yaw = truck.yaw;
  bed.length = truck.length;
  bed.width = truck.width;
  bed.height = truck.height;
  // Of Rz(yaw) Ry(pitch) Rx(roll): nose down pitch is positive.
  bed.rise_along = -std::tan(truck.pose.pitch);
  bed.rise_across = std::tan(truck.pose.roll) / std::cos(truck.pose.pitch);
  bed.wall_top = truck.pose.middle.z() - bed.top_at(0.0, 0.0);
  // An end lies half a length beyond the middle.
  const Eigen::Vector2d along(std::cos(truck.yaw), std::sin(truck.yaw));
  const double middle = along.dot(truck.pose_covariance.topLeftCorner<2, 2>() * along), both = std::fabs(along.dot(truck.pose_covariance.block<2, 1>(0, 6)));
  bed.end_deviation = std::sqrt(std::max(0.0, middle + both + 0.25 * truck.pose_covariance(6, 6)));  // the worse end
  return bed;
}

}  // namespace berm::app
