// Drawn scenes, with a truck and without: what was told scanline by scanline is answered as the whole sweep is, bit for bit, whatever its scanlines are.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "recognition/ongoing_recognition.hpp"
#include "truck_world/scene.hpp"

namespace berm::truck_world {
namespace {

constexpr std::uint64_t kSeed = 20261;
constexpr int kScenes = 6, kSamples = 36000;

void expect_same(const app::RecognisedTruck& a, const app::RecognisedTruck& b) {
  EXPECT_EQ(a.found, b.found);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.truck_class, b.truck_class);
  for (std::size_t i = 0; i < 4 && a.found; ++i) EXPECT_EQ(a.corners[i], b.corners[i]);
  EXPECT_EQ(a.yaw, b.yaw);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.pose.middle, b.pose.middle);
  EXPECT_EQ(a.evidence.score, b.evidence.score);
  EXPECT_EQ(a.cab, b.cab);
}

// The sweep and what is made of it: scanlines without a point, with one, with their points in any order, or missing.
std::vector<app::ScanPoint> spoilt(std::vector<app::ScanPoint> points, std::mt19937_64& random) {
  std::vector<app::ScanPoint> out;
  app::visit_scanlines(points, [&](std::span<const app::ScanPoint> scanline) {
    std::vector<app::ScanPoint> own(scanline.begin(), scanline.end());
    switch (random() % 12) {
      case 0: return;
      case 1: own.resize(1); break;
      case 2: std::shuffle(own.begin(), own.end(), random); break;
      default: break;
    }
    out.insert(out.end(), own.begin(), own.end());
  });
  return out;
}

TEST(AsItArrives, TheAnswerIsThatToTheScanlinesSoFar) {
  std::cout << "seed " << kSeed << "\n";
  const std::vector<TruckClass> classes = read_truck_classes(BERM_TRUCK_CLASSES);
  const app::TruckRangeSet ranges = app::read_truck_ranges(BERM_TRUCK_RANGES);
  std::mt19937_64 random(kSeed);
  int found = 0, swings = 0, part_found = 0;
  for (int k = 0; k < kScenes; ++k)
    for (const Content content : {Content::truck, Content::no_truck}) {
      SceneOptions options;
      options.content = content;
      options.samples = kSamples * (k % 2 + 1);
      options.swinging_share = 0.5;
      const Scene scene = draw_scene(classes, options, kSeed, k);
      swings += scene.truth.swing_rate != 0.0 ? 1 : 0;
      const Vector3d& v = scene.truth.viewpoint;
      const std::array<double, 3> viewpoint{v.x(), v.y(), v.z()};
      const std::vector<app::ScanPoint> points = k % 3 == 2 ? spoilt(scene.cloud, random) : scene.cloud;
      app::OngoingRecognition ongoing(viewpoint, ranges);
      std::size_t told = 0, part = points.size() * (3 + random() % 5) / 10;
      app::visit_scanlines(points, [&](std::span<const app::ScanPoint> scanline) {
        ongoing.take({});
        ongoing.take(scanline);
        const bool first_beyond = told < part && told + scanline.size() >= part;
        told += scanline.size();
        if (!first_beyond) return;
        const app::RecognisedTruck batch = app::recognise_truck(std::span(points).first(told), viewpoint, ranges);
        expect_same(ongoing.ask(), batch);
        part_found += batch.found ? 1 : 0;
      });
      const app::RecognisedTruck whole = app::recognise_truck(points, viewpoint, ranges);
      expect_same(ongoing.ask(), whole);
      found += whole.found ? 1 : 0;
    }
  EXPECT_GE(found, kScenes / 2) << "mostly nothing was found: the comparison shows little";
  EXPECT_LT(found, 2 * kScenes);
  EXPECT_GE(swings, 2);
  EXPECT_GE(part_found, 1);
}

}  // namespace
}  // namespace berm::truck_world
