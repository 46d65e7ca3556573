// What every party of the plane benchmark hands back, ours and the peers' alike. Base frame, metres.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

namespace berm::bench {

struct FoundPlane {
  Eigen::Vector3d normal, at;  // unit; a point of the plane
  Eigen::AlignedBox3d box;     // round the returns that it stands for
};

struct PlanesFound {
  std::vector<FoundPlane> planes;
  double normals_us = 0.0;  // of the whole time, that for normals of points
};

struct PlaneParty {
  std::string name;
  std::function<PlanesFound()> run;
};

// Least squares; the peers' own planes are of the same inliers, some of them by fewer points or in single precision.
template <typename Indices>
FoundPlane plane_through(const std::vector<Eigen::Vector3d>& points, const Indices& inliers) {
  FoundPlane plane{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), {}};
  for (const auto i : inliers) {
    plane.at += points[static_cast<std::size_t>(i)];
    plane.box.extend(points[static_cast<std::size_t>(i)]);
  }
  plane.at /= static_cast<double>(inliers.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto i : inliers) {
    const Eigen::Vector3d d = points[static_cast<std::size_t>(i)] - plane.at;
    spread += d * d.transpose();
  }
  plane.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  return plane;
}

}  // namespace berm::bench
