#include "machine_profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <toml.hpp>

namespace berm::kernel::test {
namespace {

constexpr double pi = 3.141592653589793;

int32_t scaled(const toml::value& v, double unit) {
  const double x = v.is_integer() ? static_cast<double>(v.as_integer()) : v.as_floating();
  return static_cast<int32_t>(std::lround(x * unit));
}

int32_t mm(const toml::value& v) { return scaled(v, 1e3); }
int32_t urad(const toml::value& degrees) { return scaled(degrees, 1e6 * pi / 180.0); }

Machine load(const std::filesystem::path& path) {
  const toml::value file = toml::parse(path.string());
  Machine machine{path.stem().string(), {}};
  berm_parameters& p = machine.parameters;
  const auto& k = file.at("kinematics");
  p.boom_pin_x_mm = mm(k.at("boom_pin_x"));
  p.boom_pin_z_mm = mm(k.at("boom_pin_z"));
  p.boom_length_mm = mm(k.at("boom"));
  p.stick_length_mm = mm(k.at("stick"));
  p.bucket_length_mm = mm(k.at("bucket"));
  p.own_body_radius_mm = mm(k.at("own_body_radius"));
  const char* joints[4] = {"swing", "boom", "stick", "bucket"};
  for (int j = 0; j < 4; ++j) {
    p.joint_low_urad[j] = urad(file.at("joint").at(joints[j]).at("range_deg").at(0));
    p.joint_high_urad[j] = urad(file.at("joint").at(joints[j]).at("range_deg").at(1));
  }
  for (const auto& part : file.at("part").as_array()) {
    berm_part& out = p.part[p.parts++];
    out.link = static_cast<int32_t>(std::find(joints, joints + 4, part.at("link").as_string().str) - joints);
    out.half_width_mm = mm(part.at("half_width"));
    for (const auto& corner : part.at("outline").as_array()) {
      out.vertex_mm[out.vertices][0] = mm(corner.at(0));
      out.vertex_mm[out.vertices++][1] = mm(corner.at(1));
    }
  }
  int head = 0;
  for (const auto& scanner : file.at("scanner").as_array()) {
    berm_scanner_mount& mount = p.scanner[head++];
    mount.x_mm = mm(scanner.at("position").at(0));
    mount.y_mm = mm(scanner.at("position").at(1));
    mount.z_mm = mm(scanner.at("position").at(2));
  }
  const auto& kernel = file.at("kernel");
  p.margin_mm = mm(kernel.at("margin"));
  p.self_margin_mm = mm(kernel.at("self_margin"));
  p.spurious_range_mm = mm(kernel.at("spurious_range"));
  p.range_min_mm = mm(kernel.at("range_min"));
  p.range_max_mm = mm(kernel.at("range_max"));
  p.fresh_us = scaled(kernel.at("fresh"), 1e6);
  return machine;
}

} // namespace

double uniform(std::mt19937_64& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

std::vector<Machine> machine_profiles() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(BERM_MACHINES))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Machine> out;
  for (const auto& file : files) out.push_back(load(file));
  return out;
}

Machine random_machine(std::mt19937_64& random) {
  const auto length = [&](double low, double high) { return static_cast<int32_t>(uniform(random, low, high)); };
  Machine machine{"random", {}};
  berm_parameters& p = machine.parameters;
  p.boom_pin_x_mm = length(-3000, 3000);
  p.boom_pin_z_mm = length(-1000, 3000);
  p.boom_length_mm = length(0, 6000);
  p.stick_length_mm = length(0, 4000);
  p.bucket_length_mm = length(0, 2000);
  for (int j = 0; j < 4; ++j) {
    p.joint_low_urad[j] = -6283185;
    p.joint_high_urad[j] = 6283185;
  }
  p.parts = BERM_PARTS;
  for (auto& part : p.part) {
    part.link = 1 + static_cast<int32_t>(random() % 3);
    part.half_width_mm = length(0, 1500);
    part.vertices = 3 + static_cast<int32_t>(random() % (BERM_PART_VERTICES - 2));
    const double x = uniform(random, -2000, 4000), z = uniform(random, -2000, 2000), radius = uniform(random, 0, 2000), turn = uniform(random, 0, 2 * pi);
    for (int i = 0; i < part.vertices; ++i) { // on a circle, hence convex
      const double angle = turn + 2.0 * pi * i / part.vertices;
      part.vertex_mm[i][0] = static_cast<int32_t>(std::lround(x + radius * std::cos(angle)));
      part.vertex_mm[i][1] = static_cast<int32_t>(std::lround(z + radius * std::sin(angle)));
    }
  }
  return machine;
}

sk_reach_box random_box(const berm_parameters& parameters, std::mt19937_64& random) {
  sk_reach_box box{};
  const bool single = random() % 8 == 0;
  for (int j = 0; j < 4; ++j) {
    const double widest = single ? 0.0 : (j == 0 ? 70.0 : 10.0) * 1e6 * pi / 180.0;
    const double width = random() % 6 == 0 ? 0.0 : uniform(random, 0.0, widest);
    const double low = uniform(random, parameters.joint_low_urad[j], parameters.joint_high_urad[j] - width);
    box.low_urad[j] = static_cast<int32_t>(low);
    box.high_urad[j] = static_cast<int32_t>(low + width);
  }
  return box;
}

long sample_count(long otherwise) {
  const char* text = std::getenv("BERM_SAMPLES");
  const long count = text != nullptr ? std::atol(text) : 0;
  return count > 0 ? count : otherwise;
}

} // namespace berm::kernel::test
