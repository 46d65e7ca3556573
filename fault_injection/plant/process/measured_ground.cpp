#include "plant/process/measured_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "plant/process/point_file.hpp"
#include "plant/process/triangulated_surface.hpp"

namespace berm::plant {

namespace {

constexpr double kSurvey_m = 1e6;    // no coordinate of a survey lies farther out
constexpr double kGap_m = 4.0;       // a longer side of a triangle spans what was not measured
constexpr double kBeyond_m = 5.0;    // points so far outside the terrain still shape its rim
constexpr double kHighest_m = 20.0;  // of the ground, either way: where the plant counts volumes from
constexpr std::size_t kMostLevelled = 8;

// Where the machine's base frame lies in the survey's.
struct BaseInSurvey {
  double x = 0, y = 0, cosine = 1, sine = 0, level = 0;
  [[nodiscard]] MeasuredPoint in_base(const MeasuredPoint& p) const {
    const double dx = p[0] - x, dy = p[1] - y;
    return {cosine * dx + sine * dy, -sine * dx + cosine * dy, p[2] - level};
  }
};

// Ground that was cut and filled to a level, with banks of a slope round it.
struct Levelled {
  double x_low, x_high, y_low, y_high, z, slope;
  [[nodiscard]] double graded(double x, double y, double height) const {
    const double away = std::hypot(std::max({x_low - x, 0.0, x - x_high}), std::max({y_low - y, 0.0, y - y_high}));
    return std::clamp(height, z - slope * away, z + slope * away);
  }
};

std::vector<Levelled> read_levelled(StrictTable& table) {
  std::vector<Levelled> all;
  for (StrictTable& t : table.tables("levelled")) {
    const auto x = t.interval("x", -100.0, 100.0, 0.1), y = t.interval("y", -100.0, 100.0, 0.1);
    const double z = t.number("z", -10.0, 10.0), slope = std::tan(t.degrees("slope_deg", 5.0, 80.0));
    t.finish();
    all.push_back({x[0], x[1], y[0], y[1], z, slope});
  }
  if (all.size() > kMostLevelled) table.fail("levelled", fmt::format("at most {}", kMostLevelled));
  return all;
}

std::vector<MeasuredPoint> points_about(const TerrainConfig& terrain, const BaseInSurvey& base, const std::string& path) {
  const auto about = [](double p, double low, double high) { return p > low - kBeyond_m && p < high + kBeyond_m; };
  std::vector<MeasuredPoint> near;
  for (const MeasuredPoint& survey : read_point_file(path)) {
    const MeasuredPoint p = base.in_base(survey);
    if (about(p[0], terrain.x_low, terrain.x_high) && about(p[1], terrain.y_low, terrain.y_high)) near.push_back(p);
  }
  return near;
}

}  // namespace

std::string recording_path(const std::string& name) {
  const char* folder = std::getenv("BERM_REAL_DATA");
  return (std::filesystem::path(folder != nullptr && *folder != '\0' ? folder : BERM_REAL_DATA) / name).string();
}

MeasuredGround read_measured_ground(StrictTable table, const TerrainConfig& terrain) {
  const std::string path = recording_path(table.text("file"));
  const auto origin = table.array<2>("origin", -kSurvey_m, kSurvey_m);
  const double yaw = table.degrees("yaw_deg", -360.0, 360.0);
  const BaseInSurvey base{origin[0], origin[1], std::cos(yaw), std::sin(yaw), table.number("level", -kSurvey_m, kSurvey_m)};
  const std::vector<Levelled> levelled = read_levelled(table);
  table.finish();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    table.fail("file", fmt::format("there is no {} (BERM_REAL_DATA names the folder of recordings)", path));

  TriangulatedSurface surface(points_about(terrain, base, path), kGap_m);
  MeasuredGround ground;
  const int count_x = terrain.count_x(), count_y = terrain.count_y();
  ground.height.reserve(static_cast<std::size_t>(count_x) * static_cast<std::size_t>(count_y));
  std::vector<double> rim;
  for (int iy = 0; iy < count_y; ++iy) {
    for (int ix = 0; ix < count_x; ++ix) {
      const double x = terrain.x_low + (ix + 0.5) * terrain.cell, y = terrain.y_low + (iy + 0.5) * terrain.cell;
      const std::optional<double> measured = surface.height(x, y);
      if (!measured) table.fail("file", fmt::format("nothing was measured within {:g} m at x {:.2f}, y {:.2f} of the base frame", kGap_m, x, y));
      double height = *measured;
      for (const Levelled& place : levelled) height = place.graded(x, y, height);
      if (std::abs(height) > kHighest_m)
        table.fail("level", fmt::format("leaves ground at height {:.1f} m, at x {:.2f}, y {:.2f}: it is outside -20 .. 20", height, x, y));
      ground.height.push_back(height);
      if (ix == 0 || iy == 0 || ix == count_x - 1 || iy == count_y - 1) rim.push_back(height);
    }
  }
  std::nth_element(rim.begin(), rim.begin() + static_cast<std::ptrdiff_t>(rim.size() / 2), rim.end());
  ground.beyond = rim[rim.size() / 2];
  return ground;
}

}  // namespace berm::plant
