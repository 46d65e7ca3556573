#include "run/dig_surface.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace berm::run {

namespace {

using nlohmann::json;

std::vector<double> numbers_of(const std::string& line, const std::string& path) {
  std::vector<double> values;
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, ',');) {
    char* end = nullptr;
    values.push_back(std::strtod(cell.c_str(), &end));
    if (end == cell.c_str()) throw std::runtime_error(path + ": '" + cell + "' is no number");
  }
  return values;
}

double to_segment(double r, double z, const std::array<double, 2>& a, const std::array<double, 2>& b) {
  const double dr = b[0] - a[0], dz = b[1] - a[1], length2 = dr * dr + dz * dz;
  const double s = length2 > 0 ? std::clamp(((r - a[0]) * dr + (z - a[1]) * dz) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(r - a[0] - s * dr, z - a[1] - s * dz);
}

double to_shape(double r, double z, const std::vector<std::array<double, 2>>& shape) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < shape.size(); ++i) nearest = std::min(nearest, to_segment(r, z, shape[i], shape[i + 1]));
  return nearest;
}

}  // namespace

HeightField read_height_field(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error(path + ": cannot be read");
  const auto head = numbers_of(line, path);
  if (head.size() != 5) throw std::runtime_error(path + ": no x0,y0,cell,nx,ny in its first line");
  HeightField field{head[0], head[1], head[2], static_cast<int>(head[3]), static_cast<int>(head[4]), {}};
  while (std::getline(file, line)) {
    const auto row = numbers_of(line, path);
    field.height.insert(field.height.end(), row.begin(), row.end());
  }
  if (field.height.size() != static_cast<std::size_t>(field.nx) * static_cast<std::size_t>(field.ny))
    throw std::runtime_error(path + ": not as many heights as its first line says");
  return field;
}

std::vector<PlannedDig> planned_digs(const std::vector<json>& app_events) {
  std::vector<PlannedDig> digs;
  bool open = false;
  for (const json& event : app_events) {
    const std::string name = event.value("event", "");
    if (name == "dig" && event.contains("shape")) {
      PlannedDig dig{event.value("bearing_deg", 0.0) * std::numbers::pi / 180, event["shape"].get<std::vector<std::array<double, 2>>>()};
      open = dig.shape.size() >= 2;
      if (!open) continue;
      dig.reached_r = dig.shape.back()[0];
      digs.push_back(std::move(dig));
    } else if (name == "dug" && open) {
      digs.back().reached_r = std::max(digs.back().reached_r, event.value("r_m", 0.0));
      digs.back().time_s = event.value("time_s", 0.0);
      open = false;
    }
  }
  return digs;
}

void place_digs(std::vector<PlannedDig>& digs, const json& truth) {
  const auto moves = truth.find("bench_moves");
  if (moves == truth.end()) return;
  for (PlannedDig& dig : digs)
    for (const json& move : *moves) {
      if (move.value("to_s", 0.0) > dig.time_s) break;
      dig.base_x = move.value("x_m", 0.0);
      dig.base_y = move.value("y_m", 0.0);
    }
}

std::optional<double> dig_surface_error_m(const HeightField& surface, const std::vector<PlannedDig>& digs, double half_width) {
  double sum = 0.0;
  int cells = 0;
  for (int iy = 0; iy < surface.ny; ++iy) {
    for (int ix = 0; ix < surface.nx; ++ix) {
      const double x = surface.x0 + (ix + 0.5) * surface.cell, y = surface.y0 + (iy + 0.5) * surface.cell;
      const auto last = std::find_if(digs.rbegin(), digs.rend(), [&](const PlannedDig& dig) {
        const double c = std::cos(dig.bearing), s = std::sin(dig.bearing), dx = x - dig.base_x, dy = y - dig.base_y, r = dx * c + dy * s;
        return std::abs(dy * c - dx * s) <= half_width && r <= dig.shape.front()[0] && r >= dig.reached_r;
      });
      if (last == digs.rend()) continue;
      const double r = (x - last->base_x) * std::cos(last->bearing) + (y - last->base_y) * std::sin(last->bearing);
      const double z = surface.height[static_cast<std::size_t>(iy) * static_cast<std::size_t>(surface.nx) + static_cast<std::size_t>(ix)];
      sum += to_shape(r, z, last->shape);
      ++cells;
    }
  }
  if (cells == 0) return std::nullopt;
  return sum / cells;
}

}  // namespace berm::run
