// berm recognize: a truck in one recorded sweep.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "config/command_line.hpp"
#include "config/json_text.hpp"
#include "config/standard_error.hpp"
#include "points/file_bytes.hpp"
#include "points/pcd.hpp"
#include "recognition/recognition_picture.hpp"

namespace berm::app {
namespace {

struct Options {
  std::string file, json, picture, classes = BERM_TRUCK_RANGES;
};

template <typename Matrix>
nlohmann::ordered_json rows_of(const Matrix& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.push_back(nlohmann::ordered_json::array());
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) rows.back().push_back(matrix(i, k));
  }
  return rows;
}

nlohmann::ordered_json json_of(const RecognisedTruck& truck) {
  constexpr double kDegrees = 180.0 / 3.14159265358979323846;
  nlohmann::ordered_json json;
  json["found"] = truck.found;
  json["reason"] = truck.reason;
  for (const char* key : {"class", "corners_m", "yaw_deg", "length_m", "width_m", "height_m", "height_sd_m", "open_rear", "floor_m", "canopy_m", "covariance", "pose_covariance"})
    json[key] = nullptr;
  if (truck.found) {
    json["class"] = truck.truck_class;
    json["corners_m"] = nlohmann::ordered_json::array();
    for (const Eigen::Vector3d& c : truck.corners) json["corners_m"].push_back({c.x(), c.y(), c.z()});
    json["yaw_deg"] = truck.yaw * kDegrees;
    json["length_m"] = truck.length;
    json["width_m"] = truck.width;
    json["height_m"] = truck.height;
    json["height_sd_m"] = truck.height_deviation;
    json["open_rear"] = truck.open_rear;
    if (truck.planes.floor) json["floor_m"] = truck.planes.floor->depth;
    if (truck.planes.canopy) json["canopy_m"] = truck.planes.canopy->length;
    json["covariance"] = rows_of(truck.covariance);
    json["pose_covariance"] = rows_of(truck.pose_covariance);
  }
  json["milliseconds"] = truck.milliseconds;
  return json;
}

int run(const Options& options) {
  const TruckRangeSet ranges = read_truck_ranges(options.classes);
  const PointCloud cloud = read_pcd_cloud(options.file);
  for (const auto& [there, field] : {std::pair(cloud.scanlines, "scanline"), std::pair(cloud.times, "time")})
    if (!there) throw PointFileError(fmt::format("{}: {}: is missing", options.file, field));
  const RecognisedTruck truck = recognise_truck(cloud.points, cloud.viewpoint, ranges);
  if (!options.json.empty()) write_file_bytes(options.json, config::json_text(json_of(truck), 1));
  if (truck.found) {
    fmt::print("{}: opening {:.2f} by {:.2f} m, yaw {:.1f} degrees, walls {:.2f} m high (standard deviation {:.2f}); {:.1f} ms\n", truck.truck_class, truck.length, truck.width,
               json_of(truck)["yaw_deg"].get<double>(), truck.height, truck.height_deviation, truck.milliseconds);
    for (const Eigen::Vector3d& c : truck.corners) fmt::print("  corner {:8.3f} {:8.3f} {:8.3f}\n", c.x(), c.y(), c.z());
  } else {
    fmt::print("no truck: {}; {:.1f} ms\n", truck.reason, truck.milliseconds);
  }
  if (!options.picture.empty()) write_recognition_picture(options.picture, cloud.points, cloud.viewpoint, truck);
  return truck.found ? 0 : 1;
}

}  // namespace
}  // namespace berm::app

int main(int argc, char** argv) {
  berm::app::Options options;
  CLI::App app{
      "Finds a truck in one sweep of a panning scanner: the four corners of its opening with their covariance, or why there is none. FILE is a PCD "
      "with scanline and time; its VIEWPOINT is the sensor's place in the middle of the sweep. Exit status 0: found; 1: no truck; 2: bad input.",
      "berm recognize"};
  app.add_option("FILE", options.file, "the sweep (PCD)")->required();
  berm::config::output(app.add_option("--json", options.json,
                 "write found, reason, class, corners_m, yaw_deg, length_m, width_m, height_m, height_sd_m, open_rear, covariance (12 x 12, of the corners), "
                 "pose_covariance (8 x 8: middle x y z, yaw, pitch, roll, length, width; m, rad), milliseconds"));
  berm::config::output(app.add_option("--picture", options.picture, "write a view from above (SVG)"));
  app.add_option("--classes", options.classes, "file of truck classes")->capture_default_str();
  if (const auto status = berm::config::parse_options(app, argc, argv)) return *status;
  try {
    return berm::app::run(options);
  } catch (const std::exception& error) {
    berm::config::print_error("berm recognize: {}\n", error.what());
    return 2;
  }
}
