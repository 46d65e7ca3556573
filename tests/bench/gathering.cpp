// Point-cloud gathering against OctoMap on one stream: two panning scanners over a yard; a truck stands there, then elsewhere. Points a second,
// memory, and what is left where nothing stands any more, by the scene's own geometry.
#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "config/standard_error.hpp"
#include "gathering/gatherer.hpp"
#include "timing.hpp"

namespace {

using namespace berm;
using namespace berm::app;
using Eigen::Vector3d;

constexpr double kVoxelM = 0.15, kFarM = 20.0, kOffM = 0.3;
constexpr int kSweeps = 6, kScansOfSweep = 120;

struct Truck {
  Vector3d low, high;
};

// Ground at z = 0 with a bank of 2 m beyond x = 8, walls at 18 m, one truck.
struct Yard {
  Truck truck;

  double range(const Vector3d& from, const Vector3d& beam) const {
    double met = kFarM;
    const auto plane = [&](double t) {
      if (t > 1e-6 && t < met) met = t;
    };
    plane(-from.z() / beam.z());
    const double bank = (2.0 - from.z()) / beam.z();
    if (from.x() + bank * beam.x() > 8.0) plane(bank);
    const double face = (8.0 - from.x()) / beam.x();
    if (const double z = from.z() + face * beam.z(); z > 0.0 && z < 2.0) plane(face);
    for (int i = 0; i < 2; ++i) plane(((beam[i] > 0 ? 18.0 : -18.0) - from[i]) / beam[i]);
    double enter = 0.0, leave = met;
    for (int i = 0; i < 3; ++i) {
      const double a = (truck.low[i] - from[i]) / beam[i], b = (truck.high[i] - from[i]) / beam[i];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter < leave ? enter : met;
  }
  // From the nearest surface.
  double distance(const Vector3d& p) const {
    double nearest =
        std::min({std::abs(18.0 - std::abs(p.x())), std::abs(18.0 - std::abs(p.y())), p.x() < 8.0 ? std::abs(p.z()) : std::abs(p.z() - 2.0)});
    if (p.z() > -kOffM && p.z() < 2.0 + kOffM) nearest = std::min(nearest, std::abs(p.x() - 8.0));
    const Vector3d outside = (truck.low - p).cwiseMax(p - truck.high);
    const double to_truck = outside.maxCoeff() > 0.0 ? outside.cwiseMax(0.0).norm() : -outside.maxCoeff();
    return std::min(nearest, to_truck);
  }
};

struct Scan {
  std::size_t scanner;
  Eigen::Isometry3d frame;
  std::vector<PolarReturn> returns;
  octomap::Pointcloud cloud;
};

std::vector<Scan> stream(std::size_t& points) {
  constexpr double kHalfTurn = 3.14159265358979323846;
  Yard yard{{{4.0, 2.0, 0.0}, {7.0, 5.0, 2.5}}};
  const DhLink pan{0.0, 3.0, 0.0, 0.0, DhLink::Joint::kRevolute, 0};
  const KinematicChain chain[] = {KinematicChain({pan, {0.0, 0.0, 0.6, kHalfTurn / 2}}), KinematicChain({pan, {0.4, 0.0, 0.6, kHalfTurn / 2 - 0.3}})};
  std::mt19937_64 engine(1);
  std::normal_distribution<double> noise(0.0, 0.012);
  std::vector<Scan> out;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    if (sweep == kSweeps / 2) yard.truck = {{4.0, -5.0, 0.0}, {7.0, -2.0, 2.5}};
    for (int i = 0; i < kScansOfSweep; ++i) {
      const double share = static_cast<double>(i) / (kScansOfSweep - 1), encoder[] = {1.2 * (sweep % 2 == 0 ? 2.0 * share - 1.0 : 1.0 - 2.0 * share)};
      for (std::size_t s = 0; s < 2; ++s) {
        Scan scan{s, chain[s].pose(encoder), {}, {}};
        for (int step = -140; step <= 60; ++step) {
          const double angle = 0.5 * step * kHalfTurn / 180.0;
          const double met = yard.range(scan.frame.translation(), scan.frame.linear() * Vector3d(std::cos(angle), std::sin(angle), 0.0));
          if (met >= kFarM) continue;
          scan.returns.push_back({angle, met + noise(engine)});
          const Vector3d p = scan.frame * (scan.returns.back().range_m * Vector3d(std::cos(angle), std::sin(angle), 0.0));
          scan.cloud.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
        }
        points += scan.returns.size();
        out.push_back(std::move(scan));
      }
    }
  }
  return out;
}

struct Outcome {
  std::vector<double> us{};
  double bytes = 0.0, stale = 0.0, kept = 0.0;
};

void ours(const std::vector<Scan>& scans, const Yard& now, Outcome& out) {
  const double begin = bench::cpu_us();
  PointCloudGatherer gatherer(GatheringOptions{});
  gatherer.add_scanner({0.012, 0.002, 0.004});
  gatherer.add_scanner({0.012, 0.002, 0.004});
  for (const Scan& scan : scans) gatherer.add_scan(scan.scanner, scan.frame, scan.returns, 0.0);
  out.us.push_back(bench::cpu_us() - begin);
  out.bytes = static_cast<double>(gatherer.bytes());
  out.kept = static_cast<double>(gatherer.store().size());
  out.stale = 0.0;
  for (const ScanPoint& p : gatherer.points())
    out.stale += now.distance(Vector3d(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z))) > kOffM ? 1 : 0;
}

void octomap_tree(const std::vector<Scan>& scans, const Yard& now, bool discretize, Outcome& out) {
  const double begin = bench::cpu_us();
  octomap::OcTree tree(kVoxelM);
  for (const Scan& scan : scans) {
    const Vector3d o = scan.frame.translation();
    tree.insertPointCloud(scan.cloud, {static_cast<float>(o.x()), static_cast<float>(o.y()), static_cast<float>(o.z())}, -1.0, false, discretize);
  }
  out.us.push_back(bench::cpu_us() - begin);
  out.bytes = static_cast<double>(tree.memoryUsage());
  out.stale = out.kept = 0.0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    out.kept += 1.0;
    out.stale += now.distance(Vector3d(leaf.getX(), leaf.getY(), leaf.getZ())) > kOffM + 0.5 * kVoxelM ? 1 : 0;
  }
}

int run(const std::string& name, const std::string& json) {
  std::size_t points = 0;
  const std::vector<Scan> scans = stream(points);
  const Yard now{{{4.0, -5.0, 0.0}, {7.0, -2.0, 2.5}}};
  const char* peers[] = {"octomap_insert_point_cloud", "octomap_insert_point_cloud_discretized"};
  Outcome mine, peer[2];
  for (int repetition = 0; repetition < 3; ++repetition) {
    ours(scans, now, mine);
    for (int k = 0; k < 2; ++k) octomap_tree(scans, now, k == 1, peer[k]);
  }
  const auto rate = [&](Outcome& o) {
    std::sort(o.us.begin(), o.us.end());
    return static_cast<double>(points) / (o.us[o.us.size() / 2] * 1e-6);
  };
  const double my_rate = rate(mine);
  fmt::print("gathering, {} points: ours {:.0f} points/s, {:.2f} MB, {} points kept, {} of them stale\n", points, my_rate, mine.bytes * 1e-6,
             mine.kept, mine.stale);
  auto rows = nlohmann::json::array();
  for (int k = 0; k < 2; ++k) {
    const double its = rate(peer[k]);
    fmt::print("    {:<40} {:9.0f} points/s, {:.2f} MB, {} voxels occupied, {} of them stale: ours {:.1f} times as fast, {:.2f} of the memory\n",
               peers[k], its, peer[k].bytes * 1e-6, peer[k].kept, peer[k].stale, my_rate / its, mine.bytes / peer[k].bytes);
    const auto row = [&](const char* workload, const char* unit, double a, double b, double ratio, double reference) {
      if (std::string(workload).find(name) != std::string::npos)
        rows.push_back(
            {{"workload", workload}, {"unit", unit}, {"ours", a}, {"peer", peers[k]}, {"peer_value", b}, {"ratio", ratio}, {"reference", reference}});
    };
    row("gathering_speed_150", "points/s", my_rate, its, my_rate / its, static_cast<double>(points));
    row("gathering_memory_150", "bytes", mine.bytes, peer[k].bytes, peer[k].bytes / mine.bytes, static_cast<double>(points));
    row("gathering_stale_150", "points or voxels", mine.stale, peer[k].stale, (peer[k].stale + 1.0) / (mine.stale + 1.0), mine.kept);
  }
  if (!json.empty() && !(std::ofstream(json) << rows.dump(1) << "\n")) throw std::runtime_error(json + ": cannot be written");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Point-cloud gathering against OctoMap"};
  std::string name, json;
  bool list = false;
  app.add_option("--name", name);
  app.add_option("--json", json);
  app.add_flag("--list", list);
  CLI11_PARSE(app, argc, argv);
  if (list) {
    fmt::print("gathering_speed_150\ngathering_memory_150\ngathering_stale_150\n");
    return 0;
  }
  try {
    return run(name, json);
  } catch (const std::exception& error) {
    berm::config::print_error("berm_bench_gathering: {}\n", error.what());
    return 2;
  }
}
