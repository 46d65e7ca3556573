#include "truck_world/trial.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "config/csv_field.hpp"
#include "run/percentile_json.hpp"

namespace berm::truck_world {
namespace {

using config::csv_field;
using Json = nlohmann::ordered_json;
constexpr double kNormal95 = 1.96;  // standard deviations

using Vector8d = Eigen::Matrix<double, 8, 1>;

app::BedPose pose_of(const TruckTruth& k) {
  app::BedPose pose;
  for (const Vector3d& corner : k.corners) pose.middle += corner / 4.0;
  pose.yaw = k.yaw;
  pose.pitch = k.pitch;
  pose.roll = k.roll;
  pose.length = k.inside_length;
  pose.width = k.inside_width;
  pose.thickness = k.wall_thickness;
  pose.open_end = k.tailgate == name_of(Tailgate::up) ? 0 : -1;
  return pose;
}

Json accuracy(const std::vector<Trial>& trials) {
  std::vector<double> corner, yaw, size, length, width, height;
  int trucks = 0, recognised = 0;
  double nees = 0.0;
  int within = 0, height_within = 0;
  for (const Trial& t : trials) {
    trucks += t.truck ? 1 : 0;
    if (!t.recognised) continue;
    ++recognised;
    corner.insert(corner.end(), t.corner_errors.begin(), t.corner_errors.end());
    yaw.push_back(std::abs(t.yaw_error) * 180.0 / pi);
    for (const double e : {t.length_error, t.width_error}) size.push_back(std::abs(e));
    length.push_back(std::abs(t.length_error));
    width.push_back(std::abs(t.width_error));
    height.push_back(std::abs(t.height_error));
    height_within += std::abs(t.height_error) <= kNormal95 * t.height_deviation ? 1 : 0;
    nees += t.nees / 8.0;
    within += t.nees < 15.507 ? 1 : 0;  // chi-square, 8 degrees of freedom, 95 %
  }
  Json json;
  json["trucks"] = trucks;
  json["recognised"] = recognised;
  json["corner_error_m_p50"] = run::percentile_or_null(corner, 0.5);
  json["corner_error_m_p95"] = run::percentile_or_null(corner, 0.95);
  json["yaw_error_deg_p95"] = run::percentile_or_null(yaw, 0.95);
  json["dimension_error_m_p95"] = run::percentile_or_null(size, 0.95);
  json["length_error_m_p95"] = run::percentile_or_null(length, 0.95);
  json["width_error_m_p95"] = run::percentile_or_null(width, 0.95);
  json["height_error_m_p50"] = run::percentile_or_null(height, 0.5);
  json["height_error_m_p95"] = run::percentile_or_null(height, 0.95);
  json["height_within_95"] = recognised > 0 ? Json(static_cast<double>(height_within) / recognised) : Json(nullptr);
  json["nees_ratio"] = recognised > 0 ? Json(nees / recognised) : Json(nullptr);
  json["nees_within_95"] = recognised > 0 ? Json(static_cast<double>(within) / recognised) : Json(nullptr);
  return json;
}

}  // namespace

std::array<double, 3> viewpoint_of(const Scene& scene) {
  const Vector3d& v = scene.truth.viewpoint;
  return {v.x(), v.y(), v.z()};
}

Trial judge(const Scene& scene, const app::RecognisedTruck& answer) {
  const SceneTruth& truth = scene.truth;
  const TruckTruth& k = truth.of_truck;
  Trial t;
  t.scene = truth.scene;
  t.truck = truth.truck;
  t.found = answer.found;
  t.truck_class = k.truck_class;
  t.tailgate = k.tailgate;
  t.fill = k.fill;
  t.look_alike = truth.look_alike;
  t.reason = answer.reason;
  t.wall_hidden = k.wall_hidden;
  t.hidden_share = k.hidden_share;
  t.occluded_share = k.occluded_share;
  t.milliseconds = answer.milliseconds;
  t.evidence = answer.evidence;
  t.cab = answer.cab;
  t.pose = answer.pose;
  t.planes = answer.planes;
  t.true_height = k.wall_height;
  t.told_class = answer.truck_class;
  if (!t.truck) return t;
  const app::BedPose true_pose = pose_of(k);
  app::FanSweep sweep = app::thinned(app::make_fans(scene.cloud, viewpoint_of(scene)));
  app::upright_segments(sweep);  // marks what is upright
  app::BedInterpretation truly;
  truly.pose = true_pose;
  app::weigh_whole(sweep, truly);
  t.true_cab = truly.cab_seen;
  t.true_score = truly.evidence.score;
  if (!t.found) return t;
  Vector3d middle = Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    t.corner_errors[i] = (answer.corners[i] - k.corners[i]).norm();
    middle += k.corners[i] / 4.0;
  }
  t.yaw_error = std::remainder(answer.yaw - k.yaw, 2 * pi);
  t.length_error = answer.length - k.inside_length;
  t.width_error = answer.width - k.inside_width;
  t.height_error = answer.height - k.wall_height;
  t.height_deviation = answer.height_deviation;
  Vector8d error;
  error << answer.pose.middle - middle, t.yaw_error, answer.pose.pitch - k.pitch, answer.pose.roll - k.roll, t.length_error, t.width_error;
  for (int i = 0; i < 8; ++i) {
    t.error[static_cast<std::size_t>(i)] = error[i];
    t.deviation[static_cast<std::size_t>(i)] = std::sqrt(answer.pose_covariance(i, i));
  }
  t.nees = error.dot(answer.pose_covariance.ldlt().solve(error));
  t.recognised = *std::max_element(t.corner_errors.begin(), t.corner_errors.end()) <= kCornerGate;
  return t;
}

std::string table(const std::vector<Trial>& trials) {
  std::string out = "scene,truck,found,recognised,class,tailgate,fill,wall_hidden,look_alike,hidden_share,occluded_share,corner_0_m,corner_1_m,corner_2_m,corner_3_m";
  for (const char* what : {"error", "deviation"})
    for (const char* of : {"x_m", "y_m", "z_m", "yaw_rad", "pitch_rad", "roll_rad", "length_m", "width_m"}) out += fmt::format(",{}_{}", what, of);
  out += ",height_error_m,height_deviation_m,nees,evidence,cab,true_evidence,true_cab,milliseconds,reason\n";
  for (const Trial& t : trials) {
    out += fmt::format("{},{:d},{:d},{:d},{},{},{},{},{},{:.3f},{:.3f}", t.scene, t.truck, t.found, t.recognised, csv_field(t.truck_class),
                       csv_field(t.tailgate), csv_field(t.fill), csv_field(t.wall_hidden), csv_field(t.look_alike), t.hidden_share, t.occluded_share);
    for (const double e : t.corner_errors) out += fmt::format(",{:.4f}", e);
    for (const auto& all : {t.error, t.deviation})
      for (const double e : all) out += fmt::format(",{:.5f}", e);
    out += fmt::format(",{:.3f},{:.3f},{:.2f},{:.1f},{:.1f},{:.1f},{:.1f},{:.2f},{}\n", t.height_error, t.height_deviation, t.nees, t.evidence.score, t.cab, t.true_score, t.true_cab, t.milliseconds,
                       csv_field(t.reason));
  }
  return out;
}

Json summary(const std::vector<Trial>& trials) {
  std::vector<Trial> with;
  std::map<std::string, std::vector<Trial>> classes;
  std::vector<double> milliseconds;
  int without = 0, accepted = 0;
  for (const Trial& t : trials) {
    milliseconds.push_back(t.milliseconds);
    if (t.truck) {
      with.push_back(t);
      classes[t.truck_class].push_back(t);
      classes["tailgate " + t.tailgate].push_back(t);
      classes["load " + t.fill].push_back(t);
      classes[t.wall_hidden.empty() ? "both ends in sight" : "an end hidden"].push_back(t);
    } else {
      ++without;
      accepted += t.found ? 1 : 0;
    }
  }
  Json json = accuracy(with);
  json["non_trucks"] = without;
  json["false_accepts"] = accepted;
  json["ms_p50"] = run::percentile_or_null(milliseconds, 0.5);
  json["ms_max"] = run::percentile_or_null(milliseconds, 1.0);
  json["by_class"] = Json::object();
  for (const auto& [name, own] : classes) json["by_class"][name] = accuracy(own);
  return json;
}

}  // namespace berm::truck_world
