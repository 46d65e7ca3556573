#include "truck_world/scene_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

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
  namespace fs = std::filesystem;
  const std::string name = scene_name(scene.truth.scene), part = folder + "/" + name + ".part", base = part + "/" + name;
  std::vector<std::string> endings{".pcd", ".labels.csv"};
  if (picture) endings.push_back(".svg");
  endings.push_back(".json");
  for (const std::string& ending : endings)
    if (const std::string file = folder + "/" + name + ending; fs::is_directory(file)) throw std::runtime_error(file + ": cannot be written: is a folder");
  try {
    fs::create_directory(part);
    const Vector3d& eye = scene.truth.viewpoint;
    app::write_pcd(base + ".pcd", scene.cloud, {eye.x(), eye.y(), eye.z()});
    config::write_whole_file(base + ".labels.csv", label_lines(scene.point_truth));
    if (picture) write_picture(base + ".svg", scene);
    config::write_whole_file(base + ".json", config::json_text(json_of(scene.truth), 1));
    for (const std::string& ending : endings) fs::rename(base + ending, folder + "/" + name + ending);
    fs::remove(part);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
}

std::string of_another_run(const std::string& folder, std::uint64_t seed, bool adds) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("scene_")) continue;
    if (!adds) return fmt::format("{}: holds scenes of an earlier run ({}): name another folder, or remove them", folder, name);
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path());
    const auto truth = nlohmann::json::parse(file, nullptr, false);
    if (!truth.is_object() || !truth.contains("seed") || truth["seed"] != seed)
      return fmt::format("{}: holds scenes that are not of seed {} ({}): name another folder, or remove them", folder, seed, name);
  }
  return "";
}

}  // namespace berm::truck_world
