#include "planes_pcl_image.hpp"

#include <fmt/format.h>
#include <pcl/common/angles.h>
#include <pcl/features/integral_image_normal.h>
#include <pcl/search/brute_force.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include <cmath>
#include <limits>
#include <memory>

#include "timing.hpp"

namespace berm::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Estimation = pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal>;

// PCL's own comparator lets its distance grow with the square of z, as the noise of a depth camera does. A scanner's noise does not.
class SameDistance : public pcl::PlaneCoefficientComparator<pcl::PointXYZ, pcl::Normal> {
 public:
  [[nodiscard]] bool compare(int a, int b) const override {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    return std::abs((*plane_coeff_d_)[at(a)] - (*plane_coeff_d_)[at(b)]) < distance_threshold_ &&
           (*normals_)[at(a)].getNormalVector3fMap().dot((*normals_)[at(b)].getNormalVector3fMap()) > angular_threshold_;
  }
};

struct Image {
  Cloud::Ptr cloud{new Cloud};
  std::vector<std::size_t> point;  // of each pixel, in the sweep's points
};

// Rows are steps of the mirror from straight up over the rear, columns scanlines; seen by a camera that looks to the middle of the sector, as PCL
// takes depth along z.
Image image_of(const SweepPoints& sweep) {
  const truck_world::Sweep& s = sweep.scene->sweep;
  const double azimuth = s.swing_begin + s.pan_begin + (s.swing_rate + s.pan_rate) * s.duration() / 2;
  Eigen::Matrix3d camera;
  camera.row(0) << std::sin(azimuth), -std::cos(azimuth), 0.0;
  camera.row(1) << 0.0, 0.0, -1.0;
  camera.row(2) << std::cos(azimuth), std::sin(azimuth), 0.0;
  constexpr auto kRows = static_cast<std::uint32_t>(truck_world::samples_per_scanline);
  const std::uint32_t columns = (static_cast<std::uint32_t>(s.samples) + kRows - 1) / kRows;
  Image image;
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  image.cloud->assign(static_cast<pcl::index_t>(columns * kRows), pcl::PointXYZ(nothing, nothing, nothing));
  image.cloud->width = columns;
  image.cloud->height = kRows;
  image.cloud->is_dense = false;
  image.point.assign(image.cloud->size(), 0);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const std::uint32_t row = (sweep.samples[i] % kRows + kRows - kRows / 4) % kRows, column = sweep.samples[i] / kRows;
    const Eigen::Vector3f p = (camera * (sweep.points[i] - sweep.scene->truth.viewpoint)).cast<float>();
    (*image.cloud)(column, row) = {p.x(), p.y(), p.z()};
    image.point[row * columns + column] = i;
  }
  return image;
}

struct ImageSettings {
  Estimation::NormalEstimationMethod method;
  float smoothing_pixels, depth_change, angle_deg, distance_m, curvature;
  bool refined;
};

PlanesFound segmented(const SweepPoints& sweep, const Image& image, const ImageSettings& s) {
  const double begin = cpu_us();
  Estimation estimation;
  estimation.setNormalEstimationMethod(s.method);
  estimation.setMaxDepthChangeFactor(s.depth_change);
  estimation.setNormalSmoothingSize(s.smoothing_pixels);
  // It searches nothing, but would otherwise estimate the projection of a depth camera each time.
  estimation.setSearchMethod(pcl::make_shared<pcl::search::BruteForce<pcl::PointXYZ>>());
  estimation.setInputCloud(image.cloud);
  const Normals::Ptr normals(new Normals);
  estimation.compute(*normals);
  PlanesFound out;
  out.normals_us = cpu_us() - begin;
  pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label> segmentation;
  segmentation.setComparator(pcl::make_shared<SameDistance>());
  segmentation.setMinInliers(static_cast<unsigned>(least_returns(sweep)));
  segmentation.setAngularThreshold(static_cast<double>(pcl::deg2rad(s.angle_deg)));
  segmentation.setDistanceThreshold(static_cast<double>(s.distance_m));
  segmentation.setMaximumCurvature(static_cast<double>(s.curvature));
  segmentation.setInputNormals(normals);
  segmentation.setInputCloud(image.cloud);
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers;
  if (s.refined) {
    std::vector<pcl::PlanarRegion<pcl::PointXYZ>, Eigen::aligned_allocator<pcl::PlanarRegion<pcl::PointXYZ>>> regions;
    std::vector<pcl::PointIndices> labelled, boundaries;
    pcl::PointCloud<pcl::Label>::Ptr labels(new pcl::PointCloud<pcl::Label>);
    segmentation.segmentAndRefine(regions, planes, inliers, labels, labelled, boundaries);
  } else {
    segmentation.segment(planes, inliers);
  }
  for (const pcl::PointIndices& pixels : inliers) {
    std::vector<std::size_t> points;
    for (const auto i : pixels.indices) points.push_back(image.point[static_cast<std::size_t>(i)]);
    out.planes.push_back(plane_through(sweep.points, points));
  }
  return out;
}

// The first found the most faces in 30 sweeps of seed 2, of equals the fastest; measured are others.
constexpr ImageSettings kPclImage[] = {{Estimation::COVARIANCE_MATRIX, 3.0F, 0.1F, 20.0F, 1.0F, 0.05F, true},
                                     {Estimation::COVARIANCE_MATRIX, 3.0F, 0.1F, 20.0F, 1.0F, 0.05F, false},
                                     {Estimation::COVARIANCE_MATRIX, 3.0F, 0.1F, 15.0F, 0.5F, 0.05F, false},
                                     {Estimation::COVARIANCE_MATRIX, 3.0F, 0.1F, 15.0F, 0.5F, 0.05F, true},
                                     {Estimation::COVARIANCE_MATRIX, 3.0F, 0.2F, 20.0F, 1.0F, 0.05F, false},
                                     {Estimation::COVARIANCE_MATRIX, 3.0F, 0.1F, 20.0F, 0.5F, 0.05F, true},
                                     {Estimation::COVARIANCE_MATRIX, 3.0F, 0.1F, 20.0F, 1.0F, 0.02F, false},
                                     {Estimation::COVARIANCE_MATRIX, 5.0F, 0.1F, 20.0F, 0.5F, 0.05F, true},
                                     {Estimation::AVERAGE_3D_GRADIENT, 3.0F, 0.1F, 20.0F, 1.0F, 0.05F, false},
                                     {Estimation::AVERAGE_DEPTH_CHANGE, 3.0F, 0.1F, 20.0F, 1.0F, 0.05F, false}};

}  // namespace

std::vector<PlaneParty> pcl_image_parties(const SweepPoints& sweep, bool every_setting) {
  const auto image = std::make_shared<Image>(image_of(sweep));
  std::vector<PlaneParty> parties;
  add_parties(
      parties, "pcl_organized", kPclImage, every_setting,
      [](const ImageSettings& s) {
        return fmt::format("method {} smoothing {} depth {} angle {} distance {} curvature {} refined {}", static_cast<int>(s.method), s.smoothing_pixels, s.depth_change,
                           s.angle_deg, s.distance_m, s.curvature, s.refined);
      },
      [&sweep, image](const ImageSettings& s) { return segmented(sweep, *image, s); });
  return parties;
}

}  // namespace berm::bench
