// A scene as files: what is read again is what was drawn, and a folder that cannot be written to stays empty.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "points/pcd.hpp"
#include "scratch.hpp"
#include "truck_scenes.hpp"
#include "truck_world/scene_files.hpp"

namespace berm::truck_world {
namespace {

TEST(TruckWorldFiles, WhatIsReadAgainIsWhatWasDrawn) {
  const test::Scratch scratch;
  const std::string& folder = scratch.folder();
  const Scene scene = draw_scene(shipped_classes(), coarse(Content::truck), 13, 17);
  write_scene(folder, scene, true);
  const std::string base = folder + "/scene_000017";
  const app::PointCloud cloud = app::read_pcd_cloud(base + ".pcd");
  ASSERT_EQ(cloud.points.size(), scene.cloud.size());
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    const app::ScanPoint &a = cloud.points[i], &b = scene.cloud[i];
    ASSERT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z && a.scanline == b.scanline && a.time_s == b.time_s) << i;
  }
  EXPECT_NEAR(cloud.viewpoint[2], scene.truth.viewpoint.z(), 1e-5);

  std::ifstream labels(base + ".labels.csv");
  std::string line;
  std::getline(labels, line);
  EXPECT_EQ(line, "label,sample");
  for (const PointTruth& p : scene.point_truth) {
    ASSERT_TRUE(std::getline(labels, line));
    ASSERT_EQ(line, std::string(p.outlier ? "outlier" : name_of(p.surface)) + "," + std::to_string(p.sample));
  }
  EXPECT_FALSE(std::getline(labels, line));

  std::ifstream truth_file(base + ".json");
  const auto truth = nlohmann::json::parse(truth_file);
  EXPECT_EQ(truth["truck"]["class"], scene.truth.of_truck.truck_class);
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(truth["truck"]["corners"][i][static_cast<std::size_t>(k)], scene.truth.of_truck.corners[i][k]);
  EXPECT_EQ(truth["returns"], scene.cloud.size());
  EXPECT_TRUE(truth["look_alike"].is_null());
  EXPECT_GT(std::filesystem::file_size(base + ".svg"), 10000U);
}

TEST(TruckWorldFiles, AFileThatCannotBeWrittenLeavesNothingOfItsScene) {
  const test::Scratch scratch;
  const std::string& folder = scratch.folder();
  std::filesystem::create_directories(folder + "/scene_000003.json/in_the_way");  // a folder under the last file's name
  const Scene scene = draw_scene(shipped_classes(), coarse(Content::no_truck), 13, 3);
  EXPECT_THROW(write_scene(folder, scene, false), std::runtime_error);
  int left = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) left += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(left, 0);
}

TEST(TruckWorldFiles, ASceneThatCannotBeWrittenLeavesAnEarlierOneAsItWas) {
  const test::Scratch scratch;
  scratch.write("scene_000003.pcd", "former");
  scratch.write("scene_000003.labels.csv", "former");
  std::filesystem::create_directories(scratch.path("scene_000003.json/in_the_way"));
  EXPECT_THROW(write_scene(scratch.folder(), draw_scene(shipped_classes(), coarse(Content::no_truck), 13, 3), false), std::runtime_error);
  EXPECT_EQ(scratch.names(), (std::vector<std::string>{"scene_000003.json", "scene_000003.labels.csv", "scene_000003.pcd"}));
  EXPECT_EQ(std::filesystem::file_size(scratch.path("scene_000003.pcd")), 6U);
}

TEST(TruckWorldFiles, AFolderHoldsOneRun) {
  const test::Scratch scratch;
  scratch.write("notes.txt", "");
  EXPECT_EQ(of_another_run(scratch.folder(), 13, false), "");
  write_scene(scratch.folder(), draw_scene(shipped_classes(), coarse(Content::no_truck), 13, 3), false);
  EXPECT_NE(of_another_run(scratch.folder(), 13, false), "");
  EXPECT_EQ(of_another_run(scratch.folder(), 13, true), "") << "one scene more of the same";
  EXPECT_NE(of_another_run(scratch.folder(), 14, true), "");
}

}  // namespace
}  // namespace berm::truck_world
