// CGAL's plane extraction as the distribution packages it: region growing on a point set, and Efficient RANSAC (Schnabel et al., 2007).
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>
#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <utility>

#include "planes_parties.hpp"
#include "timing.hpp"

namespace berm::bench {
namespace {

namespace shapes = CGAL::Shape_detection;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using PointMap = CGAL::First_of_pair_property_map<Oriented>;
using NormalMap = CGAL::Second_of_pair_property_map<Oriented>;
using OrientedPoints = std::vector<Oriented>;

OrientedPoints with_normals(const SweepPoints& sweep, const OrientedPoints& bare, int neighbours_usual) {
  OrientedPoints points = bare;
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(points, static_cast<unsigned>(neighbours(sweep, neighbours_usual)),
                                                   CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()));
  return points;
}

struct GrowingSettings {
  int normal_neighbours, growing_neighbours;
  double reach_m;  // of the neighbours; 0: growing_neighbours of them
  double distance_m, angle_deg;
  bool sorted;     // seeds from where the neighbourhood is flattest
};

PlanesFound grown(const SweepPoints& sweep, const OrientedPoints& bare, const GrowingSettings& s) {
  using ByNumber = shapes::Point_set::K_neighbor_query<Kernel, OrientedPoints, PointMap>;
  using ByReach = shapes::Point_set::Sphere_neighbor_query<Kernel, OrientedPoints, PointMap>;
  using Region = shapes::Point_set::Least_squares_plane_fit_region<Kernel, OrientedPoints, PointMap, NormalMap>;
  const double begin = cpu_us();
  const OrientedPoints points = with_normals(sweep, bare, s.normal_neighbours);
  PlanesFound out;
  out.normals_us = cpu_us() - begin;
  Region region(points, s.distance_m, s.angle_deg, static_cast<std::size_t>(least_returns(sweep)));
  std::vector<std::vector<std::size_t>> regions;
  const auto grow = [&](auto query) {
    using Query = decltype(query);
    if (s.sorted) {
      shapes::Point_set::Least_squares_plane_fit_sorting<Kernel, OrientedPoints, Query, PointMap> sorting(points, query);
      sorting.sort();
      const auto seeds = sorting.seed_map();
      shapes::Region_growing<OrientedPoints, Query, Region, decltype(sorting.seed_map())>(points, query, region, seeds)
          .detect(std::back_inserter(regions));
    } else {
      shapes::Region_growing<OrientedPoints, Query, Region>(points, query, region).detect(std::back_inserter(regions));
    }
  };
  if (s.reach_m > 0.0) {
    grow(ByReach(points, s.reach_m));
  } else {
    grow(ByNumber(points, static_cast<std::size_t>(neighbours(sweep, s.growing_neighbours))));
  }
  for (const auto& inliers : regions) out.planes.push_back(plane_through(sweep.points, inliers));
  return out;
}

struct RansacSettings {
  int normal_neighbours;
  double distance_m, cluster_m, normal_threshold, probability;
};

PlanesFound ransac(const SweepPoints& sweep, const OrientedPoints& bare, const RansacSettings& s) {
  using Traits = shapes::Efficient_RANSAC_traits<Kernel, OrientedPoints, PointMap, NormalMap>;
  using Ransac = shapes::Efficient_RANSAC<Traits>;
  CGAL::get_default_random() = CGAL::Random(1);
  const double begin = cpu_us();
  OrientedPoints points = with_normals(sweep, bare, s.normal_neighbours);
  PlanesFound out;
  out.normals_us = cpu_us() - begin;
  Ransac detection;
  detection.set_input(points);
  detection.add_shape_factory<shapes::Plane<Traits>>();
  Ransac::Parameters parameters;
  parameters.probability = s.probability;
  parameters.min_points = static_cast<std::size_t>(least_returns(sweep));
  parameters.epsilon = s.distance_m;
  parameters.cluster_epsilon = s.cluster_m;
  parameters.normal_threshold = s.normal_threshold;
  detection.detect(parameters);
  std::vector<Eigen::Vector3d> reordered;  // the detection has put the points in another order
  for (const Oriented& p : points) reordered.emplace_back(p.first.x(), p.first.y(), p.first.z());
  for (const auto& shape : detection.shapes()) out.planes.push_back(plane_through(reordered, shape->indices_of_assigned_points()));
  return out;
}

// The first found the most faces in 30 sweeps of seed 2, of equals the fastest; measured are others.
constexpr GrowingSettings kCgalGrowing[] = {{12, 8, 0.0, 0.06, 15.0, false},
                                            {16, 12, 0.0, 0.06, 15.0, false},
                                            {12, 8, 0.0, 0.06, 25.0, false},
                                            {16, 12, 0.0, 0.06, 15.0, true},
                                            {20, 12, 0.0, 0.05, 25.0, false},
                                            {16, 12, 0.3, 0.06, 25.0, false},
                                            {20, 12, 0.0, 0.09, 25.0, true}};
constexpr RansacSettings kCgalRansac[] = {{20, 0.06, 0.8, 0.85, 0.05},
                                          {20, 0.09, 0.6, 0.9, 0.05},
                                          {20, 0.06, 0.6, 0.9, 0.05},
                                          {12, 0.06, 0.6, 0.9, 0.05},
                                          {20, 0.06, 0.4, 0.9, 0.05},
                                          {20, 0.09, 0.6, 0.9, 0.01}};

}  // namespace

std::vector<PlaneParty> cgal_parties(const SweepPoints& sweep, bool every_setting) {
  const auto bare = std::make_shared<OrientedPoints>();
  for (const Eigen::Vector3d& p : sweep.points) bare->emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), Kernel::Vector_3(0.0, 0.0, 0.0));
  std::vector<PlaneParty> parties;
  add_parties(
      parties, "cgal_region_growing", kCgalGrowing, every_setting,
      [](const GrowingSettings& s) {
        return fmt::format("k {} {} reach {} distance {} angle {} sorted {}", s.normal_neighbours, s.growing_neighbours, s.reach_m, s.distance_m, s.angle_deg, s.sorted);
      },
      [&sweep, bare](const GrowingSettings& s) { return grown(sweep, *bare, s); });
  add_parties(
      parties, "cgal_efficient_ransac", kCgalRansac, every_setting,
      [](const RansacSettings& s) {
        return fmt::format("k {} distance {} cluster {} normal {} probability {}", s.normal_neighbours, s.distance_m, s.cluster_m, s.normal_threshold, s.probability);
      },
      [&sweep, bare](const RansacSettings& s) { return ransac(sweep, *bare, s); });
  return parties;
}

}  // namespace berm::bench
