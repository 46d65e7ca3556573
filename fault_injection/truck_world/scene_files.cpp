#include "truck_world/scene_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>

#include "config/json_text.hpp"
#include "config/whole_file.hpp"
#include "points/pcd.hpp"
#include "run/svg.hpp"
#include "truck_world/scene_picture.hpp"

namespace berm::truck_world {
namespace {

std::string label_lines(const std::vector<PointTruth>& points) {
  std::string text = "label,sample\n";
  text.reserve(points.size() * 20);
  for (const PointTruth& p : points) {
    const std::string_view label = p.outlier ? "outlier" : name_of(p.surface);
    fmt::format_to(std::back_inserter(text), "{},{}\n", label, p.sample);
  }
  return text;
}

}  // namespace

std::string scene_name(int number) { return fmt::format("scene_{:06d}", number); }

void write_scene(const std::string& folder, const Scene& scene, bool picture) {
  const std::string base = folder + "/" + scene_name(scene.truth.scene);
  const std::array<std::string, 4> files{base + ".pcd", base + ".labels.csv", base + ".svg", base + ".json"};
  std::size_t begun = 0;
  try {
    const Vector3d& eye = scene.truth.viewpoint;
    ++begun;
    app::write_pcd(files[0], scene.cloud, {eye.x(), eye.y(), eye.z()});
    ++begun;
    config::write_whole_file(files[1], label_lines(scene.point_truth));
    ++begun;
    if (picture) write_picture(files[2], scene);
    ++begun;
    config::write_whole_file(files[3], config::json_text(json_of(scene.truth), 1));
  } catch (...) {
    // The last one begun never came to be; a file of an earlier run under its name stays.
    for (std::size_t i = 0; i + 1 < begun; ++i) std::remove(files[i].c_str());
    throw;
  }
}

}  // namespace berm::truck_world
