#include <cmath>

#include "planes_parties.hpp"
#include "recognition/truck_recogniser.hpp"

namespace berm::bench {
namespace {

using Eigen::Vector3d;

constexpr double kWallDepth = 1.5;  // m below the tops, as a box round a wall
constexpr double kLeastOfPlane = 20.0;

PlanesFound upright_planes(const SweepPoints& sweep) {
  const truck_world::Vector3d& v = sweep.scene->truth.viewpoint;
  app::FanSweep fans = app::make_fans(sweep.scene->cloud, {v.x(), v.y(), v.z()});
  PlanesFound out;
  for (const app::UprightRegion& r : app::upright_regions(fans, app::upright_segments(fans))) {
    const Vector3d first(r.first.x(), r.first.y(), r.low), last(r.last.x(), r.last.y(), r.high);
    FoundPlane plane{{r.normal.x(), r.normal.y(), 0.0}, first, Eigen::AlignedBox3d(first)};
    plane.box.extend(last);
    out.planes.push_back(plane);
  }
  return out;
}

PlanesFound recognised_walls(const SweepPoints& sweep, const app::TruckRangeSet& ranges) {
  const truck_world::Vector3d& v = sweep.scene->truth.viewpoint;
  const app::RecognisedTruck truck = app::recognise_truck(sweep.scene->cloud, {v.x(), v.y(), v.z()}, ranges);
  PlanesFound out;
  if (!truck.found) return out;
  const app::BedPose& pose = truck.pose;
  const Eigen::Matrix3d rotation = pose.rotation();
  for (const int axis : {0, 1})
    for (const int side : {-1, 1})
      for (const bool outer : {false, true}) {
        if (axis == 0 && side == pose.open_end) continue;
        Vector3d along = Vector3d::Zero();
        along[1 - axis] = pose.face(1 - axis, 1, false);
        const Vector3d normal = rotation.col(axis), at = pose.middle + side * pose.face(axis, side, outer) * normal, down(0.0, 0.0, -kWallDepth);
        FoundPlane plane{normal, at, Eigen::AlignedBox3d(Vector3d(at + rotation * along))};
        plane.box.extend(Vector3d(at - rotation * along));
        plane.box.extend(Vector3d(at + down));
        out.planes.push_back(plane);
      }
  return out;
}

}  // namespace

std::vector<PlaneParty> our_parties(const SweepPoints& sweep, const app::TruckRangeSet& ranges) {
  return {{"plane_stage", [&sweep] { return upright_planes(sweep); }},
          {"recognition", [&sweep, &ranges] { return recognised_walls(sweep, ranges); }}};
}

int neighbours(const SweepPoints& sweep, int usual) { return static_cast<int>(std::lround(usual * std::sqrt(sweep.density))); }
int least_returns(const SweepPoints& sweep) { return static_cast<int>(std::lround(kLeastOfPlane * sweep.density)); }

}  // namespace berm::bench
