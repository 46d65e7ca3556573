#include "figures.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "core/sk_common.h"

namespace berm::kernel::test {

namespace {

constexpr const char* kPage = "safety_kernel/requirements/filters.md";
constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr double kSlowestPan = 1.0 * kDegree;  // app and commander ask for no less
constexpr double kCellDiagonal = SK_CELL_MM * 1e-3 * 1.41421356237309515;

std::string text_of(const std::string& file) {
  std::ifstream stream(std::string(BERM_SOURCE) + "/" + file);
  if (!stream) throw std::runtime_error(file + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The rate stands in the sources of app and commander, which no test of the kernel may be built with.
double rate_in(const std::string& file, const std::string& pattern) {
  const std::string text = text_of(file);
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(pattern))) throw std::runtime_error(file + ": no azimuth_rate as expected");
  return std::stod(found[1]) * kDegree;
}

double head_height(const berm_parameters& parameters) { return parameters.scanner[0].z_mm * 1e-3; }

// By how much a joint's angle, as reported, can be off while it moves at full speed.
double angle_lag(const berm_parameters& p, int joint) {
  return (p.angle_error_urad[joint] + p.velocity_max_urad_s[joint] * (p.state_latency_us * 1e-6)) * 1e-6;
}

// The farthest vertex of the link's parts from its near pin.
double link_extent(const berm_parameters& p, int link) {
  double most = 0.0;
  for (int i = 0; i < p.parts; ++i)
    for (int v = 0; v < p.part[i].vertices && p.part[i].link == link; ++v) most = std::max(most, std::hypot(p.part[i].vertex_mm[v][0], p.part[i].vertex_mm[v][1]) * 1e-3);
  return most;
}

Hidden narrow(double width) { return {width, Hidden::kAny}; }
Hidden low(double height) { return {Hidden::kAny, height}; }

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(' '), to = text.find_last_not_of(' ');
  return from == std::string::npos ? std::string() : text.substr(from, to - from + 1);
}

Hidden parse(const std::string& cell, const std::string& line) {
  if (cell == "none") return {};
  static const std::regex kForm(R"((any|[0-9.]+) x (any|[0-9.]+)(, ([0-9.]+) s)?)");
  std::smatch found;
  if (!std::regex_match(cell, found, kForm)) throw std::runtime_error("filters.md: \"" + cell + "\" in: " + line);
  const auto side = [](const std::string& text) { return text == "any" ? Hidden::kAny : std::stod(text); };
  return {side(found[1]), side(found[2]), found[4].matched ? std::stod(found[4]) : Hidden::kAny};
}

}  // namespace

PanRates pan_rates(const berm_parameters& parameters) {
  PanRates rates{};
  rates.app = rate_in("planning_app/perception/lookahead_table.hpp", R"(azimuth_rate = radians\(([0-9.]+)\))");
  rates.commander = rate_in("fault_injection/validate/commander.cpp", R"(azimuth_rate = ([0-9.]+) \* degree)");
  rates.full_swing = parameters.velocity_max_urad_s[0] * 1e-6 + kSlowestPan;
  rates.limit = parameters.velocity_max_urad_s[0] * 1e-6 + parameters.scanner[0].pan_rate_max_urad_s * 1e-6;
  return rates;
}

// Two neighbouring lines turn by the rate times a turn of the mirror; a line leans by a 400th of that from sample to sample.
double line_gap(double distance, double azimuth_rate) { return distance * azimuth_rate * kLinePeriod * (1.0 + 1.0 / kSamplesPerTurn); }

double row_height(const berm_parameters& parameters, double distance, int rows) {
  const double foot = std::atan2(head_height(parameters), distance);
  return distance * (std::tan(foot) - std::tan(foot - rows * 2.0 * kPi / kSamplesPerTurn));
}

double own_layer(const berm_parameters& p, double distance) {
  if (distance > implement_reach(p) + 1.0) return 0.0;
  const double boom_lever = std::hypot(distance - p.boom_pin_x_mm * 1e-3, p.boom_pin_z_mm * 1e-3);  // to what stands on the ground, or lies lower than twice the pin
  const double stick_lever = p.stick_length_mm * 1e-3 + link_extent(p, 3);
  return p.self_margin_mm * 1e-3 + boom_lever * angle_lag(p, 1) + stick_lever * angle_lag(p, 2) + link_extent(p, 3) * angle_lag(p, 3);
}

double implement_reach(const berm_parameters& p) { return (p.boom_pin_x_mm + p.boom_length_mm + p.stick_length_mm) * 1e-3 + link_extent(p, 3); }

// The cell that holds the middle reaches no farther than its diagonal from there.
double whole_cell() { return 2.0 * kCellDiagonal; }

double beam_width(const berm_parameters& parameters, double distance) { return kBeamWidth * std::hypot(distance, head_height(parameters)); }

double lidar_step(double distance) { return distance * 2.0 * kPi * kLidarTurnsPerSecond * kLidarFiring; }

// Between two beams of which the upper is over the ground and no higher than a scanner's head; or under the lowest.
double lidar_gap(double distance) {
  double widest = 0.0, below = kLidarHeight - distance * std::tan(15.0 * kDegree);
  widest = below;
  for (int elevation = -13; elevation <= 15; elevation += 2) {
    const double z = kLidarHeight + distance * std::tan(elevation * kDegree);
    if (z > 0.0 && z <= 3.3) widest = std::max(widest, z - below);
    below = z;
  }
  return widest;
}

double silent_gap(const berm_parameters& parameters, double distance, double azimuth_rate) {
  return distance * azimuth_rate * (parameters.scanner_silent_us * 1e-6 + kPacketTime + kLinePeriod);
}

double cell_crossing(double distance, double azimuth_rate) { return kCellDiagonal / (distance * azimuth_rate) + kLinePeriod + kPacketTime; }

std::vector<Row> computed_rows(const berm_parameters& p) {
  const PanRates rates = pan_rates(p);
  const Hidden all{Hidden::kAny, Hidden::kAny, p.fresh_us * 1e-6};
  const Hidden cell = narrow(whole_cell());
  std::vector<Row> rows = {
      {"SK-FI-1", "lines of a sweep: app", {}},
      {"SK-FI-1", "lines of a sweep: validation", {}},
      {"SK-FI-1", "lines of a sweep: full swing", {}},
      {"SK-FI-1", "lines of a sweep: fastest", {}},
      {"SK-FI-2", "samples of a line", {}},
      {"SK-FI-3", "spurious filter", {}},
      {"SK-FI-4", "self filter", {}},
      {"SK-FI-5", "own body, own cells", {}},
      {"SK-FI-6", "shadow, range limits", {{all, all, all}}},
      {"SK-FI-7", "no return", {{cell, cell, cell}}},
      {"SK-FI-8", "last echo", {}},
      {"SK-FI-9", "VLP-16: firings", {}},
      {"SK-FI-9", "VLP-16: channels", {}},
      {"SK-FI-10", "packets refused or lost", {}},
      {"SK-FI-11", "freshness", {{all, all, all}}},
      {"SK-FI-12", "sweeps that end in a cell", {{cell, cell, cell}}},
      {"SK-FI-13", "generations that part a sweep", {}},
      {"SK-FI-14", "clamps and borders of the map", {}},
  };
  for (std::size_t i = 0; i < kDistances.size(); ++i) {
    const double d = kDistances[i];
    const Hidden layer = own_layer(p, d) > 0.0 ? Hidden{p.self_margin_mm * 1e-3, own_layer(p, d)} : Hidden{};
    const Hidden blind{Hidden::kAny, Hidden::kAny, cell_crossing(d, rates.app)};
    const Hidden of[] = {narrow(line_gap(d, rates.app)), narrow(line_gap(d, rates.commander)), narrow(line_gap(d, rates.full_swing)), narrow(line_gap(d, rates.limit)),
                         low(row_height(p, d, 1)), low(row_height(p, d, 2)), layer};
    for (std::size_t k = 0; k < std::size(of); ++k) rows[k].at[i] = of[k];
    rows[10].at[i] = narrow(beam_width(p, d));
    rows[11].at[i] = narrow(lidar_step(d));
    rows[12].at[i] = low(lidar_gap(d));
    rows[13].at[i] = narrow(silent_gap(p, d, rates.full_swing));
    rows[16].at[i] = blind;
  }
  return rows;
}

std::vector<Row> page_rows() {
  std::istringstream page(text_of(kPage));
  std::vector<Row> rows;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("| SK-FI-", 0) != 0) continue;
    std::vector<std::string> cell;
    std::istringstream parts(line.substr(1));
    for (std::string part; std::getline(parts, part, '|');) cell.push_back(trimmed(part));
    if (cell.size() < 6) throw std::runtime_error("filters.md: too few columns in: " + line);
    rows.push_back({cell[0], cell[1], {parse(cell[3], line), parse(cell[4], line), parse(cell[5], line)}});
  }
  return rows;
}

std::array<double, 3> child_rates() {
  const std::string page = text_of(kPage);
  std::smatch found;
  if (!std::regex_search(page, found, std::regex(R"(no more than ([0-9.]+) deg/s over the ground at 5 m, ([0-9.]+) deg/s at 10 m, ([0-9.]+) deg/s at 15 m)")))
    throw std::runtime_error("filters.md: no sentence on a child's rates");
  return {std::stod(found[1]), std::stod(found[2]), std::stod(found[3])};
}

Hidden stated(const std::string& what, std::size_t distance) {
  for (const Row& row : page_rows())
    if (row.what == what) return row.at[distance];
  throw std::runtime_error("filters.md: no row \"" + what + "\"");
}

}  // namespace berm::kernel::test
