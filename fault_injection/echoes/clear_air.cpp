#include "echoes/clear_air.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "echoes/echo_table.hpp"
#include "plant/world/echo_receiver.hpp"
#include "plant/world/random.hpp"

namespace berm::echoes {
namespace {

constexpr std::array<double, 6> ranges_m{2.0, 6.0, 15.0, 30.0, 40.0, 50.0};
constexpr std::array<double, 2> reflectivities{0.1, 0.5};
constexpr double about_m = 0.3;  // targets lie evenly over this from each range: four samples
constexpr double gate_m = 0.3;   // the shipped scenarios' least range

ClearRow measured(ClearRow row, const plant::PulsePath& clear, std::uint64_t seed, int pulses) {
  const plant::EchoReceiver receiver(plant::PulseLidar{}, row.ranging, gate_m);
  plant::ReturnWaveform wave;
  plant::Random random(seed);  // the same pulses for both receivers
  double sum = 0.0, sum2 = 0.0;
  int none = 0;
  for (int i = 0; i < pulses; ++i) {
    plant::PulsePath path = clear;
    path.target = plant::HardTarget{row.range_m + about_m * random.uniform(), row.reflectivity, 1.0};
    wave.sample(path, static_cast<std::uint64_t>(random.uniform() * 0x1p53));
    const plant::Echoes e = receiver.receive(wave);
    if (e.count == 0) {
      ++none;
      continue;
    }
    const double error = e.range[static_cast<std::size_t>(e.count - 1)] - path.target->range;
    sum += error;
    sum2 += error * error;
  }
  const double n = std::max(1, pulses - none);
  row.mean_m = sum / n;
  row.rms_m = std::sqrt(sum2 / n);
  row.none = 1.0 * none / pulses;
  return row;
}

}  // namespace

std::vector<ClearRow> clear_air(double window_percent, std::uint64_t seed, int pulses) {
  std::vector<ClearRow> rows;
  for (const double reflectivity : reflectivities)
    for (const double range : ranges_m)
      for (const plant::Ranging r : {plant::Ranging::last_pulse, plant::Ranging::trailing_edge})
        rows.push_back(measured({range, reflectivity, r}, {window_percent, {}, std::nullopt}, seed, pulses));
  return rows;
}

std::string text_of(const std::vector<ClearRow>& rows) {
  std::string text = fmt::format("{:<17} {:>7} {:<14} {:>9} {:>9} {:>9}\n", "clear air: range", "reflect", "receiver", "mean mm", "rms mm", "nothing %");
  for (const ClearRow& r : rows)
    text += fmt::format("{:<17} {:>7.1f} {:<14} {:>+9.2f} {:>9.2f} {:>9.1f}\n", fmt::format("{:g} m", r.range_m), r.reflectivity, name_of(r.ranging),
                        1000 * r.mean_m, 1000 * r.rms_m, 100 * r.none);
  return text;
}

nlohmann::json json_of(const std::vector<ClearRow>& rows) {
  nlohmann::json out = nlohmann::json::array();
  for (const ClearRow& r : rows)
    out.push_back({{"range_m", r.range_m}, {"reflectivity", r.reflectivity}, {"receiver", name_of(r.ranging)}, {"mean_error_m", r.mean_m},
                   {"rms_error_m", r.rms_m}, {"nothing_share", r.none}});
  return out;
}

}  // namespace berm::echoes
