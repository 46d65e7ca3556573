// One map size: ours, the plain loop and the peers on the same workloads in this one process. run_bench.py drives the programs of all sizes.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificate.hpp"
#include "column_mesh.hpp"
#include "config/compile_parameters.hpp"
#include "convex_body.hpp"
#include "grazing.hpp"
#include "insertion.hpp"
#include "peer_bullet.hpp"
#include "peer_fcl.hpp"
#include "plain_loop.hpp"
#include "terrain.hpp"
#include "timing.hpp"

namespace {

using namespace berm;
using namespace berm::bench;

constexpr int kRepetitions = 31;
constexpr std::uint32_t kSeed = 1;

struct Measured {
  std::string workload, unit, peer;
  double ours, peer_value, ratio, reference;
};

struct Options {
  std::string name, json;
  bool list = false;
};

bool wanted(const Options& options, const std::string& workload) { return workload.find(options.name) != std::string::npos; }

std::string sized(const std::string& name) { return name + "_" + std::to_string(SK_CELL_MM); }

struct Motion {
  Joints joints[kSteps + 1];
  sk_reach_box boxes[kSteps];
  Motion() {
    for (int i = 0; i <= kSteps; ++i) joints[i] = joints_at(i);
    for (int i = 0; i < kSteps; ++i) boxes[i] = box_of_step(i);
  }
};

int steps_with(const int* count) {
  int steps = 0;
  for (int i = 0; i < kSteps; ++i) steps += count[i] > 0 ? 1 : 0;
  return steps;
}

// Whoever answers "does body i of this step meet the map" for all of them; bodies stand step by step, `parts` a step.
template <class Ask>
void ask_all(int parts, int* hits_of_step, const Ask& ask) {
  for (int step = 0; step < kSteps; ++step) {
    hits_of_step[step] = 0;
    for (int p = 0; p < parts; ++p) hits_of_step[step] += ask(step * parts + p, step, p) ? 1 : 0;
  }
}

void certificate_workload(Kind kind, const berm_parameters& parameters, const Motion& motion, std::vector<Measured>& out) {
  const std::string workload = sized(std::string("certificate_") + name_of(kind));
  const std::vector<std::int32_t> heights = terrain(kind, parameters, SK_MAP_CELLS, SK_CELL_MM);
  Certificate certificate(parameters, heights);
  const PlainLoop plain(parameters, SK_MAP_CELLS, SK_CELL_MM, heights);
  const Mesh mesh = column_mesh(heights, SK_MAP_CELLS, SK_CELL_MM);
  FclMap fcl_discrete(mesh), fcl_hull(mesh);
  BulletMap bullet_discrete(mesh, -1.0), bullet_hull(mesh, -1.0), bullet_sweep(mesh, -1.0);
  const int parts = parameters.parts;
  std::vector<Pose> poses;  // [step][part], and one step more
  for (int step = 0; step <= kSteps; ++step)
    for (int p = 0; p < parts; ++p) poses.push_back(pose_of(parameters, parameters.part[p].link, motion.joints[step]));
  for (int step = 0; step < kSteps; ++step) {
    const kernel::SliceSet& set = certificate.slices_of(motion.boxes[step]);
    if (set.count != parts) throw std::runtime_error("not one slice a part");
    for (int p = 0; p < parts; ++p) {
      const ConvexBody prism = body_of(parameters, parameters.part[p], motion.joints[step + 1]), hull = body_of(set.slice[p]);
      fcl_discrete.add(prism);
      bullet_discrete.add(prism);
      fcl_hull.add(hull);
      bullet_hull.add(hull);
    }
  }
  for (int p = 0; p < parts; ++p) bullet_sweep.add(body_of(parameters.part[p]));

  int hits[8][kSteps];
  std::vector<Party> parties;
  parties.push_back({"ours", [&] { certificate.run(motion.boxes, hits[0]); }});
  parties.push_back({"plain loop", [&] { plain.run(motion.joints, hits[1]); }});
  parties.push_back({"slices only", [&] { certificate.slices_only(motion.boxes); }});
  parties.push_back({"fcl_discrete", [&] { ask_all(parts, hits[3], [&](int i, int, int) { return fcl_discrete.hits(i); }); }});
  parties.push_back({"fcl_swept_hull", [&] { ask_all(parts, hits[4], [&](int i, int, int) { return fcl_hull.hits(i); }); }});
  parties.push_back({"bullet_discrete", [&] { ask_all(parts, hits[5], [&](int i, int, int) { return bullet_discrete.hits(i); }); }});
  parties.push_back({"bullet_swept_hull", [&] { ask_all(parts, hits[6], [&](int i, int, int) { return bullet_hull.hits(i); }); }});
  parties.push_back({"bullet_convex_sweep_test", [&] { ask_all(parts, hits[7], [&](int i, int step, int p) { return bullet_sweep.sweep_hits(p, poses[i], poses[(step + 1) * parts + p]); }); }});
  measure(parties, kRepetitions);
  const double ours = parties[0].median(), reference = parties[1].median();
  fmt::print("{:<24} ours {:8.1f} us (slices {:.1f}) = {:.2f} x plain loop {:.1f}; blocked steps: ours {}, plain {}\n", workload, ours, parties[2].median(), ours / reference, reference,
             steps_with(hits[0]), steps_with(hits[1]));
  for (std::size_t i = 3; i < parties.size(); ++i) {
    const double value = parties[i].median();
    out.push_back({workload, "us", parties[i].name, ours, value, value / ours, reference});
    fmt::print("    {:<26} {:9.1f} us   {:7.1f} x ours   blocked steps {}\n", parties[i].name, value, value / ours, steps_with(hits[i]));
  }
  std::fflush(stdout);
}

void map_workload(const berm_parameters& parameters, std::vector<Measured>& out) {
  const std::string workload = sized("map_ready");
  const std::vector<std::int32_t> heights = terrain(Kind::kFree, parameters, SK_MAP_CELLS, SK_CELL_MM);
  Certificate certificate(parameters, heights);
  const Mesh mesh = column_mesh(heights, SK_MAP_CELLS, SK_CELL_MM);
  std::vector<std::int64_t> memory(SK_MAP_CELLS * SK_MAP_CELLS * 2, 1);
  std::int64_t sum = 0;
  std::vector<Party> parties;
  parties.push_back({"ours", [&] { certificate.prepare(); }});
  parties.push_back({"memory", [&] { for (const std::int64_t v : memory) sum += v; }});  // as many bytes as a map's cells have, read once
  parties.push_back({"fcl_bvh_build", [&] { FclMap map(mesh); }});
  parties.push_back({"bullet_bvh_build", [&] { BulletMap map(mesh, -1.0); }});
  measure(parties, 7);
  if (sum == 0) throw std::runtime_error("nothing read");
  const double ours = parties[0].median();
  fmt::print("{:<24} ours {:8.1f} us (once a cycle, columns from the map); reading as much memory {:.1f}\n", workload, ours, parties[1].median());
  for (std::size_t i = 2; i < parties.size(); ++i) {
    out.push_back({workload, "us", parties[i].name, ours, parties[i].median(), parties[i].median() / ours, parties[1].median()});
    fmt::print("    {:<26} {:9.1f} us   {:7.1f} x ours\n", parties[i].name, parties[i].median(), parties[i].median() / ours);
  }
}

void insert_workload(Scanner scanner, const std::string& workload, const berm_parameters& parameters, std::vector<Measured>& out) {
  const Scan scan = scan_of(scanner, terrain(Kind::kFree, parameters, SK_MAP_CELLS, SK_CELL_MM), SK_MAP_CELLS, SK_CELL_MM);
  const double points = static_cast<double>(scan.points());
  OurInsertion ours;
  PlainInsertion plain(SK_MAP_CELLS, SK_CELL_MM);
  const Scan crossed = plain.crossed(scan);
  OctoMapInsertion octomap(SK_CELL_MM), octomap_crossed(SK_CELL_MM);
  std::vector<Party> parties;
  parties.push_back({"ours", [&] { ours.run(scan); }});
  parties.push_back({"plain loop", [&] { plain.run(scan); }});
  parties.push_back({"octomap_update_node", [&] { octomap.run(scan); }});
  parties.push_back({"octomap_update_node_crossed_cells", [&] { octomap_crossed.run(crossed); }});
  measure(parties, kRepetitions);
  int seen = 0, differ = 0;  // heights that differ by more than the integers' rounding: where a point lies on a border, the plain loop takes one cell
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      if (ours.map().seen_us[iy][ix] < 0) continue;
      ++seen;
      if (std::fabs(static_cast<float>(sk_map_top(&ours.map(), iy, ix)) - plain.top(iy, ix)) > 2.0F) ++differ;
    }
  const double a = points / parties[0].median() * 1e6, b = points / parties[1].median() * 1e6;
  fmt::print("{:<24} ours {:.2e} points/s = {:.2f} x plain loop {:.2e} ({} points, {:.2f} cells crossed a point; {} of {} cells differ)\n", workload, a, a / b, b, scan.points(),
             static_cast<double>(crossed.points()) / points, differ, seen);
  for (std::size_t i = 2; i < parties.size(); ++i) {
    const double c = points / parties[i].median() * 1e6;
    out.push_back({workload, "points/s", parties[i].name, a, c, a / c, b});
    fmt::print("    {:<34} {:.2e} points/s   ours {:.1f} x\n", parties[i].name, c, a / c);
  }
}

void grazing_workload(std::vector<Measured>& out) {
  const std::string workload = sized("grazing_decisions");
  int wrong[4] = {};
  fmt::print("{:<24} called contact, of the cases of a row (touching is contact)\n    {:<26} {:>20} {:>6} {:>6} {:>6} {:>6} {:>8} {:>16}\n", workload, "distance", "micrometres", "truth", "cases", "ours",
             "FCL", "Bullet", "Bullet no margin");
  for (const GrazingRow& r : grazing_table(kSeed)) {
    fmt::print("    {:<26} {:>9.2f} .. {:>7.2f} {:>6} {:>6} {:>6} {:>6} {:>8} {:>16}\n", r.distance, r.micrometres_least, r.micrometres_most, r.contact ? "yes" : "no", r.cases, r.ours, r.fcl, r.bullet,
               r.bullet_no_margin);
    const int said[4] = {r.ours, r.fcl, r.bullet, r.bullet_no_margin};
    for (int i = 0; i < 4; ++i) wrong[i] += r.contact ? r.cases - said[i] : said[i];
  }
  const char* peer[4] = {"ours", "fcl", "bullet", "bullet_no_margin"};
  for (int i = 1; i < 4; ++i) out.push_back({workload, "wrong decisions", peer[i], 1.0 * wrong[0], 1.0 * wrong[i], (wrong[i] + 1.0) / (wrong[0] + 1.0), 0.0});
  fmt::print("    wrong: ours {}, FCL {}, Bullet {}, Bullet without margin {} (seed {})\n", wrong[0], wrong[1], wrong[2], wrong[3], kSeed);
}

Options options_of(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--list") options.list = true;
    else if (argument == "--json" && i + 1 < argc) options.json = argv[++i];
    else if (argument == "--name" && i + 1 < argc) options.name = argv[++i];
    else throw std::runtime_error(fmt::format("unknown argument {}", argument));
  }
  return options;
}

int run(const Options& options) {
  std::vector<std::string> names;
  for (const Kind kind : kKinds) names.push_back(sized(std::string("certificate_") + name_of(kind)));
  for (const char* name : {"map_ready", "insert_vlp16", "insert_panning", "grazing_decisions"}) names.push_back(sized(name));
  if (options.list) {
    for (const std::string& name : names) fmt::print("{}\n", name);
    return 0;
  }
  const berm_parameters parameters = config::compile_parameters(config::load_machine_file(BERM_CONFIG "/machines/zx200.toml"), config::load_site_file(BERM_CONFIG "/sites/bench.toml"));
  const Motion motion;
  std::vector<Measured> measured;
  for (const Kind kind : kKinds)
    if (wanted(options, sized(std::string("certificate_") + name_of(kind)))) certificate_workload(kind, parameters, motion, measured);
  if (wanted(options, sized("map_ready"))) map_workload(parameters, measured);
  if (wanted(options, sized("insert_vlp16"))) insert_workload(Scanner::kVlp16, sized("insert_vlp16"), parameters, measured);
  if (wanted(options, sized("insert_panning"))) insert_workload(Scanner::kPanning, sized("insert_panning"), parameters, measured);
  if (wanted(options, sized("grazing_decisions"))) grazing_workload(measured);
  if (options.json.empty()) return 0;
  nlohmann::json list = nlohmann::json::array();
  for (const Measured& m : measured)
    list.push_back({{"workload", m.workload}, {"unit", m.unit}, {"ours", m.ours}, {"peer", m.peer}, {"peer_value", m.peer_value}, {"ratio", m.ratio}, {"reference", m.reference}});
  std::ofstream file(options.json);
  file << list.dump(1) << "\n";
  file.close();
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", options.json));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(options_of(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "berm bench: %s\n", error.what());
    return 1;
  }
}
