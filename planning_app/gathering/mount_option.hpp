// A scanner's place as the command line names it.
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace berm::app {

// From the recording's frame to the cloud's, of x,y,z,yaw[,pitch,roll]: metres within 1e5, degrees within 360. Turned by roll about x, then by pitch
// about y, then by yaw about z, the axes of the cloud's frame; then moved. Throws PointFileError, which names --mount.
Eigen::Isometry3d mount_of(const std::string& text);

}  // namespace berm::app
