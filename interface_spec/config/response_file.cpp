#include "config/response_file.hpp"

#include "config/strict_table.hpp"

namespace berm::config {

const std::array<const char*, 2> kDirectionNames{"up", "down"};

namespace {

constexpr std::size_t kReachesMax = 8;

std::array<std::vector<double>, 2> read_rates(StrictTable& table, const std::string& key, std::size_t reaches) {
  const auto rows = table.matrix(key, 2, reaches, 0.01, 20.0);
  return {rows[0], rows[1]};
}

StepResponseFile read_step_response(StrictTable table, std::size_t reaches) {
  StepResponseFile r;
  r.dead_time = table.number("dead_time_s", 0.0, 1.0);
  r.lag = table.number("lag_s", 0.0, 2.0);
  r.stop_lag = table.number("stop_lag_s", 0.0, 2.0);
  r.gain = table.number("gain", 0.5, 1.5);
  r.speeding = read_rates(table, "speeding_rad_s2", reaches);
  r.slowing = read_rates(table, "slowing_rad_s2", reaches);
  table.finish();
  return r;
}

}  // namespace

ResponseFile read_response(StrictTable table, const std::array<const char*, 4>& joint_names) {
  ResponseFile r;
  r.provenance = table.text("provenance");
  r.payload = table.number("payload_kg", 1.0, 50000.0);
  r.reach = table.numbers("reach_m", 1, kReachesMax, 0.1, 30.0);
  for (std::size_t i = 1; i < r.reach.size(); ++i)
    if (r.reach[i] <= r.reach[i - 1]) table.fail("reach_m", "must rise");
  for (std::size_t j = 0; j < joint_names.size(); ++j) {
    StrictTable joint = table.table(joint_names[j]);
    for (std::size_t d = 0; d < kDirectionNames.size(); ++d) r.joint[j][d] = read_step_response(joint.table(kDirectionNames[d]), j == 0 ? r.reach.size() : 1);
    joint.finish();
  }
  table.finish();
  return r;
}

}  // namespace berm::config
