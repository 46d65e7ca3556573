// The recogniser's plane stage and the whole recogniser against PCL's and CGAL's plane extraction: drawn sweeps of a truck, the time for each, and
// how well what is found agrees with the walls that the sweep shows.
#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "config/standard_error.hpp"
#include "planes_parties.hpp"
#include "planes_tally.hpp"
#include "timing.hpp"
#include "run/percentile.hpp"
#include "truck_world/truck_class.hpp"

namespace {

using namespace berm;
using namespace berm::bench;

struct PlaneOptions {
  std::string name, json;
  bool list = false, every_setting = false;
  std::uint64_t seed = 1;
  int sparse_scenes = 100, scenes = 100, dense_scenes = 6;
};

// What one party gives back the next would have to ask the system for again: up to 40 us a page, as the computer's memory happens to be, and seven times
// pcl_organized's own time. So the process keeps it, for all parties alike.
void keep_memory() {
  constexpr int most = 1 << 30;  // bytes
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
}

constexpr std::array<int, 3> kSamples{kUsualSamples, 4 * kUsualSamples, 10 * kUsualSamples};  // the second has some 37,600 returns
constexpr std::array<const char*, 2> kStages{"planes", "recognition"};

std::vector<std::string> workloads(std::size_t density) {
  std::vector<std::string> out;
  for (const char* stage : kStages) {
    for (const char* what : {"speed", "recall", "angle_error", "angle_error_p95", "offset_error", "offset_error_p95", "bare_wall_offset_error"})
      out.push_back(fmt::format("{}_{}_{}", stage, what, kSamples[density]));
    out.push_back(fmt::format("{}_scaling", stage));
  }
  return out;
}

struct Density {
  std::vector<PlaneTally> parties;  // the first two are ours
  std::vector<double> returns;      // of each sweep
};

Density measure(const PlaneOptions& o, int samples, int scenes) {
  const std::vector<truck_world::TruckClass> classes = truck_world::read_truck_classes(BERM_TRUCK_CLASSES);
  const app::TruckRangeSet ranges = app::read_truck_ranges(BERM_TRUCK_RANGES);
  truck_world::SceneOptions drawn;
  drawn.content = truck_world::Content::truck;
  drawn.samples = samples;
  Density out;
  for (int number = 0; number < scenes; ++number) {
    const truck_world::Scene scene = truck_world::draw_scene(classes, drawn, o.seed, number);
    const std::vector<WallFace> faces = faces_seen(scene, classes);
    const SweepPoints sweep = sweep_points(scene);
    std::vector<PlaneParty> parties = our_parties(sweep, ranges);
    for (auto& peers : {pcl_parties(sweep, o.every_setting), cgal_parties(sweep, o.every_setting)})
      parties.insert(parties.end(), peers.begin(), peers.end());
    out.returns.push_back(static_cast<double>(sweep.points.size()));
    out.parties.resize(parties.size());
    for (std::size_t k = 0; k < parties.size(); ++k) {
      if (number == 0) parties[k].run();  // warm-up
      const double begin = cpu_us();
      const PlanesFound found = parties[k].run();
      PlaneTally& tally = out.parties[k];
      tally.name = parties[k].name;
      tally.ms.push_back((cpu_us() - begin) * 1e-3);
      tally.normals_ms.push_back(found.normals_us * 1e-3);
      tally.planes += found.planes.size();
      for (const WallFace& face : faces) tally.faces.push_back(match(face, found.planes));
    }
  }
  fmt::print("planes, seed {}: {} sweeps of {} samples, {:.0f} returns each, {} faces of walls in them\n", o.seed, scenes, samples,
             run::percentile_of(out.returns, 0.5), out.parties[0].faces.size());
  for (const PlaneTally& t : out.parties) print_tally(t);
  return out;
}

int measure_all(const PlaneOptions& o) {
  std::array<Density, kSamples.size()> measured;
  const std::array<int, kSamples.size()> scenes_of{o.sparse_scenes, o.scenes, o.dense_scenes};
  auto rows = nlohmann::json::array();
  for (std::size_t i = 0; i < kSamples.size(); ++i) {
    const std::vector<std::string> names = workloads(i);
    const int scenes = scenes_of[i];
    if (scenes == 0 || std::none_of(names.begin(), names.end(), [&](const std::string& n) { return n.find(o.name) != std::string::npos; })) continue;
    const Density& now = measured[i] = measure(o, kSamples[i], scenes);
    for (std::size_t stage = 0; stage < kStages.size(); ++stage)
      for (std::size_t k = kStages.size(); k < now.parties.size(); ++k)
        add_rows(rows, kStages[stage], kSamples[i], run::percentile_of(now.returns, 0.5), now.parties[stage], now.parties[k], o.name);
  }
  if (!measured.front().parties.empty() && !measured.back().parties.empty()) {
    const double returns = run::percentile_of(measured.back().returns, 0.5) / run::percentile_of(measured.front().returns, 0.5);
    const auto both = [&](std::size_t k) { return std::array{measured.front().parties[k], measured.back().parties[k]}; };
    for (std::size_t stage = 0; stage < kStages.size(); ++stage)
      for (std::size_t k = kStages.size(); k < measured.front().parties.size(); ++k)
        add_scaling_row(rows, kStages[stage], both(stage), both(k), returns, o.name);
  }
  if (!o.json.empty() && !(std::ofstream(o.json) << rows.dump(1) << "\n")) throw std::runtime_error(o.json + ": cannot be written");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  PlaneOptions o;
  CLI::App app{"Extraction of planes from drawn sweeps of a truck: ours against PCL and CGAL"};
  app.add_option("--name", o.name, "only workloads whose name contains this");
  app.add_option("--json", o.json, "write the rows");
  app.add_flag("--list", o.list, "names of the workloads, and stop");
  app.add_option("--seed", o.seed, "seed of every draw")->capture_default_str();
  app.add_option("--sparse-scenes", o.sparse_scenes, "sweeps of 36,000 samples")->check(CLI::Range(0, 100000))->capture_default_str();
  app.add_option("--scenes", o.scenes, "sweeps of 144,000 samples")->check(CLI::Range(0, 100000))->capture_default_str();
  app.add_option("--dense-scenes", o.dense_scenes, "sweeps of 360,000 samples")->check(CLI::Range(0, 100000))->capture_default_str();
  app.add_flag("--every-setting", o.every_setting, "the peers with every setting that was tried, not with the best alone");
  CLI11_PARSE(app, argc, argv);
  keep_memory();
  if (o.list) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < kSamples.size(); ++i)
      for (const std::string& n : workloads(i)) names.insert(n);
    for (const std::string& n : names) fmt::print("{}\n", n);
    return 0;
  }
  try {
    return measure_all(o);
  } catch (const std::exception& error) {
    berm::config::print_error("berm_bench_planes: {}\n", error.what());
    return 2;
  }
}
