#include "plant/process/run_record.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

#include "config/json_text.hpp"
#include "plant/process/output_file.hpp"

namespace berm::plant {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kNothing = 1e8;  // the oracle gives 1e9 where there is nothing to measure to

// Microunits: enough for any reader, and the text does not depend on the last bit.
double rounded(double x) { return std::round(x * 1e6) / 1e6; }

Json maybe(const std::optional<double>& x) { return x ? Json(rounded(*x)) : Json(nullptr); }

}  // namespace

bool RunRecord::judge(double t, const OracleVerdict& verdict) {
  if (verdict.ground_gap_m < kNothing && (!ground_gap_m_ || verdict.ground_gap_m < *ground_gap_m_)) ground_gap_m_ = verdict.ground_gap_m;
  if (verdict.closest_m < kNothing && (!closest_m_ || verdict.closest_m < *closest_m_)) {
    closest_m_ = verdict.closest_m;
    closest_time_s_ = t;
    closest_what_ = verdict.what;
  }
  const bool begins = verdict.contact && !in_contact_;
  if (begins) contacts_.push_back({t, verdict.what});
  in_contact_ = verdict.contact;
  return begins;
}

void RunRecord::fault(double t, const std::string& what) {
  if (fault_s_) return;
  fault_s_ = t;
  fault_what_ = what;
}

void RunRecord::standstill(double t, bool standing) {
  if (fault_s_ && !standstill_s_ && standing) standstill_s_ = t;
}

void RunRecord::truck_left(double t, const Truth& truth) {
  const std::size_t index = departures_.size();
  const double load = index < truth.truck_load_kg.size() ? truth.truck_load_kg[index] : 0.0;
  departures_.push_back({t, load, truth.load_centre_offset_m, truth.load_height_stddev_m});
}

void RunRecord::write(const std::string& path, const End& end) const {
  // Of the truck that was loaded last: one that has only just come, or never came, has no load whose centre could be off.
  const bool loading = departures_.size() < end.truth.truck_load_kg.size() && end.truth.truck_load_kg[departures_.size()] > 0.0;
  const Departure newest = loading || departures_.empty() ? Departure{end.time_s, 0.0, end.truth.load_centre_offset_m, end.truth.load_height_stddev_m} : departures_.back();
  Json list = Json::array();
  for (const Contact& c : contacts_) list.push_back({{"time_s", rounded(c.time_s)}, {"what", c.what}});
  Json loads = Json::array();
  for (const double kg : end.truth.truck_load_kg) loads.push_back(rounded(kg));
  Json beds = Json::array();
  for (const BedTruth& b : end.truth.truck_bed) {
    beds.push_back({{"x_m", rounded(b.x)}, {"y_m", rounded(b.y)}, {"yaw_deg", rounded(b.yaw * 180.0 / std::numbers::pi)}, {"length_m", rounded(b.length)},
                    {"width_m", rounded(b.width)}, {"wall_top_m", rounded(b.wall_top)}});
  }
  Json trucks = Json::array();
  for (const Departure& d : departures_) {
    trucks.push_back({{"left_s", rounded(d.time_s)}, {"load_kg", rounded(d.load_kg)}, {"load_centre_offset_m", rounded(d.centre_offset_m)},
                      {"load_height_stddev_m", rounded(d.height_stddev_m)}});
  }
  Json disturbed = Json::array();
  for (const Disturbance& d : end.disturbances) disturbed.push_back({{"what", d.what}, {"from_s", rounded(d.from_s)}, {"to_s", maybe(d.to_s)}});
  Json truth;
  truth["schema"] = 1;
  truth["scenario"] = end.scenario;
  truth["seed"] = end.seed;
  truth["simulated_seconds"] = rounded(end.time_s);
  truth["end_reason"] = end.reason;
  truth["contacts"] = contacts_.size();
  truth["contact_list"] = list;
  truth["closest_approach_m"] = maybe(closest_m_);
  truth["closest_approach_time_s"] = closest_m_ ? Json(rounded(closest_time_s_)) : Json(nullptr);
  truth["closest_approach_what"] = closest_what_;
  truth["least_ground_gap_m"] = maybe(ground_gap_m_);
  truth["target_kg"] = rounded(end.target_kg);
  truth["truck_load_kg"] = loads;
  truth["truck_bed"] = beds;
  truth["trucks_left"] = trucks;
  truth["dug_kg"] = rounded(end.truth.dug_kg);
  truth["spill_kg"] = rounded(end.truth.spilled_kg);
  truth["spill_fraction"] = end.truth.dug_kg > 0.0 ? rounded(end.truth.spilled_kg / end.truth.dug_kg) : 0.0;
  truth["payload_kg"] = rounded(end.truth.payload_kg);
  truth["load_centre_offset_m"] = rounded(newest.centre_offset_m);
  truth["load_height_stddev_m"] = rounded(newest.height_stddev_m);
  truth["fault"] = fault_s_ ? Json(fault_what_) : Json(nullptr);
  truth["fault_s"] = maybe(fault_s_);
  truth["first_standstill_after_fault_s"] = maybe(standstill_s_);
  truth["disturbances"] = disturbed;
  Json moves = Json::array();
  for (const BenchMove& m : end.moves)
    moves.push_back({{"from_s", rounded(m.from_s)}, {"to_s", rounded(m.to_s)}, {"distance_m", rounded(m.distance_m)}, {"x_m", rounded(m.x_m)}, {"y_m", rounded(m.y_m)}});
  truth["bench_moves"] = moves;
  Json lifts = Json::array();
  for (const HandLiftTime& l : end.hand_lifts) lifts.push_back({{"from_s", rounded(l.from_s)}, {"to_s", rounded(l.to_s)}});
  truth["hand_lifts"] = lifts;
  Json presses = Json::array();
  for (const Operator::Press& p : end.presses)
    presses.push_back({{"time_s", rounded(p.time_s)}, {"keys", p.reset ? "relearn and reset" : "relearn"}, {"stop_reason", p.reason}});
  truth["operator_presses"] = presses;
  truth["refused_frames"] = end.refused_frames;
  truth["scan_packets"] = end.scan_packets;
  OutputFile file(path);
  file.write(config::json_text(truth, 2));
  file.finish();
}

}  // namespace berm::plant
