// PCL's plane extraction as the distribution packages it: over unordered points (normals by neighbours; region growing; repeated RANSAC), and over
// the sweep as an image of mirror steps by scanlines.
#include <fmt/format.h>
#include <pcl/common/angles.h>
#include <pcl/console/print.h>
#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <memory>

#include "planes_parties.hpp"
#include "planes_pcl_image.hpp"
#include "timing.hpp"

namespace berm::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Tree = pcl::search::KdTree<pcl::PointXYZ>;

Cloud::Ptr cloud_of(const SweepPoints& sweep) {
  const Cloud::Ptr cloud(new Cloud);
  for (const Eigen::Vector3d& p : sweep.points) cloud->push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  return cloud;
}

Normals::Ptr normals_of(const SweepPoints& sweep, const Cloud::Ptr& cloud, const Tree::Ptr& tree, int neighbours_usual) {
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  const truck_world::Vector3d& v = sweep.scene->truth.viewpoint;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(tree);
  estimation.setViewPoint(static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
  estimation.setKSearch(neighbours(sweep, neighbours_usual));
  const Normals::Ptr normals(new Normals);
  estimation.compute(*normals);
  return normals;
}

struct GrowingSettings {
  int normal_neighbours, growing_neighbours;
  float smoothness_deg, curvature, residual_m;  // residual 0: not tested
};

PlanesFound grown(const SweepPoints& sweep, const Cloud::Ptr& cloud, const GrowingSettings& s) {
  const double begin = cpu_us();
  const Tree::Ptr tree(new Tree);
  tree->setInputCloud(cloud);
  const Normals::Ptr normals = normals_of(sweep, cloud, tree, s.normal_neighbours);
  PlanesFound out;
  out.normals_us = cpu_us() - begin;
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setInputCloud(cloud);
  growing.setInputNormals(normals);
  growing.setSearchMethod(tree);
  growing.setMinClusterSize(static_cast<pcl::uindex_t>(least_returns(sweep)));
  growing.setNumberOfNeighbours(static_cast<unsigned>(neighbours(sweep, s.growing_neighbours)));
  growing.setSmoothnessThreshold(pcl::deg2rad(s.smoothness_deg));
  growing.setCurvatureThreshold(s.curvature);
  growing.setResidualTestFlag(s.residual_m > 0.0F);
  if (s.residual_m > 0.0F) growing.setResidualThreshold(s.residual_m);
  std::vector<pcl::PointIndices> clusters;
  growing.extract(clusters);
  for (const pcl::PointIndices& c : clusters) out.planes.push_back(plane_through(sweep.points, c.indices));
  return out;
}

struct RansacSettings {
  bool by_normals;
  float distance_m, normal_weight, sample_reach_m;
  int iterations, rounds;
};

// The largest plane of what is left, again and again.
PlanesFound ransac(const SweepPoints& sweep, const Cloud::Ptr& cloud, const RansacSettings& s) {
  const double begin = cpu_us();
  PlanesFound out;
  Normals::Ptr normals;
  if (s.by_normals) {
    const Tree::Ptr tree(new Tree);
    tree->setInputCloud(cloud);
    normals = normals_of(sweep, cloud, tree, 16);
    out.normals_us = cpu_us() - begin;
  }
  const pcl::IndicesPtr left(new pcl::Indices(cloud->size()));
  for (std::size_t i = 0; i < left->size(); ++i) (*left)[i] = static_cast<pcl::index_t>(i);
  for (int round = 0; round < s.rounds && static_cast<int>(left->size()) > least_returns(sweep); ++round) {
    const Tree::Ptr near(new Tree);  // of what is left: a sample is drawn from it
    near->setInputCloud(cloud, left);
    const auto largest = [&](auto& segmentation, int model) {
      segmentation.setModelType(model);
      segmentation.setMethodType(pcl::SAC_RANSAC);
      segmentation.setDistanceThreshold(static_cast<double>(s.distance_m));
      segmentation.setMaxIterations(s.iterations);
      segmentation.setSamplesMaxDist(static_cast<double>(s.sample_reach_m), near);
      segmentation.setInputCloud(cloud);
      segmentation.setIndices(left);
      pcl::PointIndices inliers;
      pcl::ModelCoefficients plane;
      segmentation.segment(inliers, plane);
      return inliers;
    };
    pcl::PointIndices inliers;
    if (s.by_normals) {
      pcl::SACSegmentationFromNormals<pcl::PointXYZ, pcl::Normal> segmentation;
      segmentation.setInputNormals(normals);
      segmentation.setNormalDistanceWeight(static_cast<double>(s.normal_weight));
      inliers = largest(segmentation, pcl::SACMODEL_NORMAL_PLANE);
    } else {
      pcl::SACSegmentation<pcl::PointXYZ> segmentation;
      inliers = largest(segmentation, pcl::SACMODEL_PLANE);
    }
    if (static_cast<int>(inliers.indices.size()) < least_returns(sweep)) break;
    out.planes.push_back(plane_through(sweep.points, inliers.indices));
    std::vector<bool> taken(cloud->size(), false);
    for (const auto i : inliers.indices) taken[static_cast<std::size_t>(i)] = true;
    std::erase_if(*left, [&](pcl::index_t i) { return taken[static_cast<std::size_t>(i)]; });
  }
  return out;
}

// The first found the most faces in 30 sweeps of seed 2, of equals the fastest; measured are others.
constexpr GrowingSettings kPclGrowing[] = {{12, 12, 10.0F, 0.03F, 0.0F},
                                           {12, 12, 8.0F, 0.05F, 0.0F},
                                           {12, 8, 12.0F, 0.03F, 0.0F},
                                           {16, 12, 10.0F, 0.03F, 0.0F},
                                           {20, 20, 8.0F, 0.05F, 0.0F},
                                           {12, 12, 8.0F, 0.05F, 0.06F}};
constexpr RansacSettings kPclRansac[] = {{true, 0.12F, 0.2F, 1.0F, 100, 25},
                                         {true, 0.08F, 0.1F, 1.0F, 300, 25},
                                         {true, 0.12F, 0.2F, 0.6F, 300, 25},
                                         {false, 0.06F, 0.0F, 1.0F, 300, 25},
                                         {false, 0.08F, 0.0F, 0.6F, 300, 25}};

}  // namespace

std::vector<PlaneParty> pcl_parties(const SweepPoints& sweep, bool every_setting) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // writing warnings would be timed
  std::vector<PlaneParty> parties = pcl_image_parties(sweep, every_setting);
  const Cloud::Ptr cloud = cloud_of(sweep);
  add_parties(
      parties, "pcl_region_growing", kPclGrowing, every_setting,
      [](const GrowingSettings& s) {
        return fmt::format("k {} {} smooth {} curvature {} residual {}", s.normal_neighbours, s.growing_neighbours, s.smoothness_deg, s.curvature, s.residual_m);
      },
      [&sweep, cloud](const GrowingSettings& s) { return grown(sweep, cloud, s); });
  add_parties(
      parties, "pcl_ransac", kPclRansac, every_setting,
      [](const RansacSettings& s) {
        return fmt::format("normals {} distance {} weight {} reach {} iterations {} rounds {}", s.by_normals, s.distance_m, s.normal_weight, s.sample_reach_m, s.iterations, s.rounds);
      },
      [&sweep, cloud](const RansacSettings& s) { return ransac(sweep, cloud, s); });
  return parties;
}

}  // namespace berm::bench
