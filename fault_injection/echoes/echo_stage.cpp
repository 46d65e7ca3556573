#include "echoes/echo_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berm::echoes {
namespace {

using plant::Ray;
using plant::Vec3;

// The scanners' height on the shipped machine; a tipper's rear, as large as the shipped scenarios' truck, on level ground.
constexpr double head_height = 3.3, side_m = 8.0, top_m = 4.0;
constexpr double bed_length = 4.88, bed_width = 2.44, bed_height = 1.22, wall_top = 2.6, wall_thickness = 0.06;
constexpr double cab_length = 2.0, cab_gap = 0.3, cab_top = 2.9;
// The cloud before the truck: 1.5 m thick, and 2 m of clear air behind it.
constexpr double before_thick = 1.5, before_gap = 2.0;

plant::TerrainConfig level_ground() {
  plant::TerrainConfig t;
  t.x_high = 40.0;
  t.crest_x = t.crest_y = 1000.0;
  t.toe_x = t.toe_y = 1001.0;
  return t;
}

plant::TruckConfig truck_at(double rear) {
  plant::TruckConfig t;
  t.x = rear + wall_thickness + bed_length / 2;
  t.length = bed_length, t.width = bed_width, t.height = bed_height, t.wall_top = wall_top, t.wall_thickness = wall_thickness;
  t.cab_length = cab_length, t.cab_gap = cab_gap, t.cab_top = cab_top;
  return t;
}

plant::ScannerConfig scanner_of(const StageOptions& o) {
  plant::ScannerConfig c;
  c.range_stddev = o.range_stddev;
  c.window_percent = o.window_percent;
  c.waveform_share = 1.0;
  c.reflectivity = o.reflectivity;
  return c;
}

plant::ScannerMount mount() {
  plant::ScannerMount m;
  m.position = {0.0, 0.0, head_height};
  return m;
}

}  // namespace

Stage::Stage(const StageOptions& options) : options_(options), scanner_(scanner_of(options)), terrain_(level_ground(), {}, options.seed) {
  truck_.emplace_back(truck_at(options.rear_m), plant::SoilConfig{}, "truck_1", 0.0, 0.0, 0.0, 0.0);
  truck_[0].call(0.0);
  std::vector<plant::Overflow> over;
  truck_[0].step(0.0, 0, over);
  with_truck_.place_site(terrain_, truck_, nobody_, {});
  without_.place_site(terrain_, {}, nobody_, {});
}

double Stage::head_z() const { return head_height; }

Box Stage::cloud_box(Place place) const {
  const double rear = options_.rear_m;
  if (place == Place::before) return {rear - before_gap - before_thick, rear - before_gap, 0.0, top_m};
  return {rear - options_.ahead_m, rear + bed_length + cab_gap + cab_length + 1.0, 0.0, top_m};
}

plant::SensorAir Stage::air(Place place, double extinction) const {
  plant::SensorAir a;
  const Box b = cloud_box(place);
  if (extinction > 0.0) a.clouds.push_back({{plant::PlanarFrame(), {b.x_low, -side_m / 2, b.z_low}, {b.x_high, side_m / 2, b.z_high}}, extinction});
  return a;
}

std::vector<Box> Stage::truck_boxes() const {
  std::vector<Box> out;
  const plant::PlanarFrame& f = truck_[0].frame();
  for (const plant::TruckPart& p : truck_[0].parts()) out.push_back({f.x + p.low.x, f.x + p.high.x, f.z + p.low.z, f.z + p.high.z});
  return out;
}

plant::PulsePath Stage::path(Place place, double extinction) const {
  const Box b = cloud_box(place);
  plant::PulsePath p;
  p.window_percent = scanner_.window_percent;
  p.clouds = {{b.x_low, std::min(b.x_high, options_.rear_m), extinction}};
  p.target = plant::HardTarget{options_.rear_m, scanner_.reflectivity, 1.0};
  return p;
}

std::vector<EchoSample> Stage::scan(plant::Ranging ranging, Place place, double extinction, int scanlines) const {
  plant::ScannerConfig config = scanner_;
  config.ranging = ranging;
  plant::Scanner scanner(config, mount(), 0, options_.seed);
  const plant::SensorAir dust = air(place, extinction);
  const double half = std::atan2(0.9 * bed_width / 2, options_.rear_m), turn = config.samples_per_revolution / config.sample_rate_hz;
  std::vector<EchoSample> out;
  for (int line = 0; line < scanlines; ++line) {
    const double pan = scanlines == 1 ? 0.0 : half * (2.0 * line / (scanlines - 1) - 1.0);
    std::vector<berm_scan_packet> packets;
    scanner.step(turn * (line + 1), turn, {0.0, pan}, {0.0, pan}, with_truck_, packets, plant::BaseFrame(), nullptr, dust);
    for (const berm_scan_packet& p : packets)
      for (int i = 0; i < p.count; ++i) {
        const int index = p.first_index + i;
        const Ray ray{{0.0, 0.0, head_height}, scanner.direction(index, pan)};
        const auto hit = with_truck_.cast(ray, ray, ray, config.range_max), ground = without_.cast(ray, ray, ray, config.range_max);
        EchoSample s;
        s.truth = hit.value_or(0.0);
        s.truck = hit && (!ground || *hit < *ground);
        s.rear = s.truck && ray.at(*hit).x < options_.rear_m + wall_thickness / 2;
        for (const plant::DustCloud& c : dust.clouds)
          if (const auto span = c.box.cross(ray, hit.value_or(config.range_max))) s.cloud_from = (*span)[0];
        for (int k = 0; k < BERM_SCAN_ECHOES && p.range[i][k] != 0; ++k) {
          s.range = p.range[i][k] * BERM_SCAN_RANGE_LSB_MM * 1e-3;
          s.echoes = k + 1;
        }
        s.elevation = 2 * std::numbers::pi * index / config.samples_per_revolution;
        out.push_back(s);
      }
  }
  return out;
}

}  // namespace berm::echoes
