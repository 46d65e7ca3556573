#include "echoes/echo_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace berm::echoes {
namespace {

// The value below which a share of them lies.
double of_share(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

std::string name_of(plant::Ranging ranging) { return ranging == plant::Ranging::last_pulse ? "last pulse" : "trailing edge"; }
std::string name_of(Place place) { return place == Place::about ? "about the truck" : "before the truck"; }

EchoRow row_of(const std::vector<EchoSample>& samples, Place place, double extinction, plant::Ranging ranging) {
  EchoRow row;
  row.place = place;
  row.extinction = extinction;
  row.ranging = ranging;
  std::vector<double> error, size;
  int met = 0, front = 0, none = 0, flagged = 0, unflagged = 0;
  for (const EchoSample& s : samples) {
    if (!s.rear) continue;
    ++row.samples;
    flagged += s.echoes > 1 ? 1 : 0;
    if (s.echoes == 0) {
      ++none;
      continue;
    }
    error.push_back(s.range - s.truth);
    size.push_back(std::abs(s.range - s.truth));
    if (size.back() < met_m) {
      ++met;
      continue;
    }
    front += s.cloud_from > 0.0 && std::abs(s.range - s.cloud_from) < front_m ? 1 : 0;
    unflagged += s.echoes == 1 ? 1 : 0;
  }
  const double all = std::max(1, row.samples);
  row.met = met / all;
  row.front = front / all;
  row.none = none / all;
  row.elsewhere = (row.samples - met - front - none) / all;
  row.flagged = flagged / all;
  row.wrong_unflagged = unflagged / all;
  row.median_error_m = of_share(error, 0.5);
  row.p95_error_m = of_share(size, 0.95);
  if (!error.empty()) row.farthest_m = *std::max_element(error.begin(), error.end());
  return row;
}

std::vector<EchoRow> sweep(const Stage& stage, const std::vector<double>& extinctions, int scanlines) {
  constexpr plant::Ranging both[] = {plant::Ranging::last_pulse, plant::Ranging::trailing_edge};
  std::vector<EchoRow> rows;
  for (const plant::Ranging r : both) rows.push_back(row_of(stage.scan(r, Place::about, 0.0, scanlines), Place::about, 0.0, r));
  for (const Place place : {Place::about, Place::before})
    for (const double extinction : extinctions)
      for (const plant::Ranging r : both) rows.push_back(row_of(stage.scan(r, place, extinction, scanlines), place, extinction, r));
  return rows;
}

std::string text_of(const std::vector<EchoRow>& rows) {
  std::string text = fmt::format("{:<17} {:>5} {:<14} {:>7} {:>8} {:>10} {:>10} {:>9} {:>7} {:>11} {:>7} {:>11}\n", "cloud", "1/m", "receiver", "rear %",
                                 "front %", "between %", "nothing %", "median m", "p95 m", "farthest m", "dust %", "unmarked %");
  for (const EchoRow& r : rows)
    text += fmt::format("{:<17} {:>5.2f} {:<14} {:>7.1f} {:>8.1f} {:>10.1f} {:>10.1f} {:>+9.3f} {:>7.3f} {:>+11.3f} {:>7.1f} {:>11.1f}\n",
                        r.extinction > 0.0 ? name_of(r.place) : "none", r.extinction, name_of(r.ranging), 100 * r.met, 100 * r.front,
                        100 * r.elsewhere, 100 * r.none, r.median_error_m, r.p95_error_m, r.farthest_m, 100 * r.flagged, 100 * r.wrong_unflagged);
  return text;
}

nlohmann::json json_of(const std::vector<EchoRow>& rows, const StageOptions& o, int scanlines) {
  nlohmann::json out{{"schema", 1}, {"seed", o.seed}, {"scanlines", scanlines}, {"rear_m", o.rear_m}, {"ahead_m", o.ahead_m},
                     {"reflectivity", o.reflectivity}, {"range_stddev_m", o.range_stddev}, {"window_percent", o.window_percent},
                     {"met_within_m", met_m}, {"front_within_m", front_m}};
  for (const EchoRow& r : rows)
    out["rows"].push_back({{"cloud", r.extinction > 0.0 ? name_of(r.place) : "none"}, {"extinction_per_m", r.extinction},
                           {"receiver", name_of(r.ranging)},
                           {"samples", r.samples}, {"rear_share", r.met}, {"front_share", r.front}, {"between_share", r.elsewhere},
                           {"nothing_share", r.none}, {"median_error_m", r.median_error_m}, {"p95_error_m", r.p95_error_m}, {"farthest_error_m", r.farthest_m},
                           {"dust_share", r.flagged}, {"wrong_without_dust_share", r.wrong_unflagged}});
  return out;
}

}  // namespace berm::echoes
