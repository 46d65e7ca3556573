#include "planes_tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "run/percentile.hpp"

namespace berm::bench {
namespace {

using run::percentile_of;

constexpr double kDegrees = 180.0 / truck_world::pi;

void add(nlohmann::json& rows, const std::string& filter, const std::string& workload, const char* unit, double ours, const std::string& peer,
         double peer_value, double ratio, double reference) {
  if (workload.find(filter) == std::string::npos) return;
  rows.push_back({{"workload", workload}, {"unit", unit}, {"ours", ours}, {"peer", peer}, {"peer_value", peer_value}, {"ratio", ratio},
                  {"reference", reference}});
}

double over_same_scenes(const std::array<PlaneTally, 2>& both) {
  const auto scenes = static_cast<std::ptrdiff_t>(std::min(both[0].ms.size(), both[1].ms.size()));
  const auto first = [&](const PlaneTally& t) { return percentile_of({t.ms.begin(), t.ms.begin() + scenes}, 0.5); };
  return first(both[1]) / first(both[0]);
}

}  // namespace

std::size_t PlaneTally::matched() const {
  return static_cast<std::size_t>(std::count_if(faces.begin(), faces.end(), [](const FaceError& e) { return e.matched; }));
}

double PlaneTally::recall() const {
  return faces.empty() ? 0.0 : static_cast<double>(matched()) / static_cast<double>(faces.size());
}

CommonErrors common_errors(const PlaneTally& a, const PlaneTally& b) {
  CommonErrors out;
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    if (!a.faces[i].matched || !b.faces[i].matched) continue;
    ++out.faces;
    const FaceError* both[] = {&a.faces[i], &b.faces[i]};
    for (int k = 0; k < 2; ++k) {
      out.angle_deg[k].push_back(both[k]->angle * kDegrees);
      out.offset_m[k].push_back(both[k]->offset);
      out.bare_offset_m[k].push_back(both[k]->bare_offset);
    }
  }
  return out;
}

void print_tally(const PlaneTally& t) {
  const CommonErrors own = common_errors(t, t);
  const auto pair = [](const std::vector<double>& values, int digits) {
    return fmt::format("{:.{}f} {:.{}f}", percentile_of(values, 0.5), digits, percentile_of(values, 0.95), digits);
  };
  fmt::print("    {:<22} {:8.2f} ms ({:.2f} of it normals), {:.3f} of the faces; median and 95 %: {} deg, {} m, {} m from the bare wall; {:.1f} planes\n",
             t.name, percentile_of(t.ms, 0.5), percentile_of(t.normals_ms, 0.5), t.recall(), pair(own.angle_deg[0], 2), pair(own.offset_m[0], 4),
             pair(own.bare_offset_m[0], 4), static_cast<double>(t.planes) / static_cast<double>(t.ms.size()));
}

void add_rows(nlohmann::json& rows, const std::string& stage, int samples, double returns, const PlaneTally& ours, const PlaneTally& peer,
              const std::string& name) {
  const auto row = [&](const char* what, const char* unit, double a, double b, double ratio, double reference) {
    add(rows, name, fmt::format("{}_{}_{}", stage, what, samples), unit, a, peer.name, b, ratio, reference);
  };
  const double time = percentile_of(ours.ms, 0.5), its_time = percentile_of(peer.ms, 0.5);
  row("speed", "ms", time, its_time, its_time / time, returns);
  const double both_found = static_cast<double>(ours.matched() + 1) / static_cast<double>(peer.matched() + 1);
  row("recall", "share of faces", ours.recall(), peer.recall(), both_found, static_cast<double>(ours.faces.size()));
  const CommonErrors e = common_errors(ours, peer);
  if (e.faces == 0) return;
  const auto errors = [&](const char* what, const char* unit, const std::vector<double> both[2], double share) {
    const double a = percentile_of(both[0], share), b = percentile_of(both[1], share);
    row(what, unit, a, b, b / std::max(1e-9, a), static_cast<double>(e.faces));
  };
  errors("angle_error", "deg", e.angle_deg, 0.5);
  errors("angle_error_p95", "deg", e.angle_deg, 0.95);
  errors("offset_error", "m", e.offset_m, 0.5);
  errors("offset_error_p95", "m", e.offset_m, 0.95);
  errors("bare_wall_offset_error", "m", e.bare_offset_m, 0.5);
}

void add_scaling_row(nlohmann::json& rows, const std::string& stage, const std::array<PlaneTally, 2>& ours,
                     const std::array<PlaneTally, 2>& peer, double returns, const std::string& name) {
  const double a = over_same_scenes(ours), b = over_same_scenes(peer);
  add(rows, name, stage + "_scaling", "times", a, peer[0].name, b, b / a, returns);
}

}  // namespace berm::bench
