#include "watch/intrusion_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "config/shell_word.hpp"
#include "run/contract_text.hpp"

namespace berm::watch {

namespace {

using nlohmann::ordered_json;
using Some = std::vector<const IntrusionResult*>;

constexpr int listed_most = 30;
constexpr std::size_t slowest_listed = 5;

// The value that share of them do not exceed; null of none.
ordered_json percentile(std::vector<double> values, double share) {
  if (values.empty()) return nullptr;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return std::round(values[std::clamp<std::size_t>(rank, 1, values.size()) - 1] * 1000.0) / 1000.0;
}

bool judged(const IntrusionResult& r) {
  return r.outcome == Outcome::detected || r.outcome == Outcome::stopped || r.outcome == Outcome::undetected || r.failed();
}

int count(const Some& some, Outcome outcome) {
  return static_cast<int>(std::count_if(some.begin(), some.end(), [outcome](const auto* r) { return r->outcome == outcome; }));
}

std::vector<double> detect_ms(const Some& some) {
  std::vector<double> ms;
  for (const auto* r : some)
    if (r->outcome == Outcome::detected) ms.push_back(1000.0 * (*r->record.detected_s - *r->record.entered_s));
  return ms;
}

// What it took once a sensor had seen it, if the monitor stopped for it after that.
std::optional<double> seen_to_stop_ms(const IntrusionResult& r) {
  const bool stopped = r.outcome == Outcome::detected && r.record.detected_by == BERM_STOP_INTRUDER;
  if (!stopped || !r.seen_s || *r.seen_s > *r.record.detected_s) return std::nullopt;
  return 1000.0 * (*r.record.detected_s - *r.seen_s);
}

std::vector<double> seen_to_stop_ms(const Some& some) {
  std::vector<double> ms;
  for (const auto* r : some)
    if (const auto one = seen_to_stop_ms(*r)) ms.push_back(*one);
  return ms;
}

ordered_json figures(const Some& some) {
  int unsafe = 0, contacts = 0, was_judged = 0, unseen = 0;
  for (const auto* r : some) {
    unsafe += r->unsafe_s ? 1 : 0;
    contacts += r->contact_s ? 1 : 0;
    was_judged += judged(*r) ? 1 : 0;
    unseen += r->outcome == Outcome::undetected && !r->seen_s ? 1 : 0;
  }
  const auto detect = detect_ms(some), seen = seen_to_stop_ms(some);
  return {{"runs", some.size()},
          {"judged", was_judged},
          {"unsafe", unsafe},
          {"contacts", contacts},
          {"undetected", count(some, Outcome::undetected)},
          {"undetected_never_seen", unseen},
          {"detected", count(some, Outcome::detected)},
          {"stopped_otherwise", count(some, Outcome::stopped)},
          {"brief", count(some, Outcome::brief)},
          {"false_alarm_runs", count(some, Outcome::false_alarm)},
          {"not_judged", count(some, Outcome::not_judged)},
          {"detect_ms_p50", percentile(detect, 0.5)},
          {"detect_ms_p95", percentile(detect, 0.95)},
          {"seen_to_stop_ms_p50", percentile(seen, 0.5)},
          {"seen_to_stop_ms_p95", percentile(seen, 0.95)},
          {"seen_to_stop_ms_max", percentile(seen, 1.0)}};
}

Some all_of(const Campaign& campaign) {
  Some all;
  for (const auto& r : campaign.results) all.push_back(&r);
  return all;
}

// From where it came, as seen from the machine at the dig.
const char* side_of(const IntrusionResult& r) {
  const auto& w = r.intrusion.mover.waypoints.front();
  const double bearing = std::atan2(w.y, w.x) * 180.0 / std::numbers::pi;
  return std::fabs(bearing) <= 45.0 ? "front" : std::fabs(bearing) >= 135.0 ? "behind" : bearing > 0.0 ? "left" : "right";
}

using Groups = std::map<std::string, std::map<std::string, Some>>;
Groups groups_of(const Campaign& campaign) {
  Groups groups;
  for (const auto& r : campaign.results) {
    groups["by_way"][name_of(r.intrusion.way)].push_back(&r);
    groups["by_size"][name_of(r.intrusion.who)].push_back(&r);
    groups["by_speed"][r.intrusion.running ? "running" : "walking"].push_back(&r);
    groups["by_side"][side_of(r)].push_back(&r);
    groups["by_merge"][r.intrusion.follows ? "figure_7_continuous" : "figure_8_as_first_seen"].push_back(&r);
  }
  return groups;
}

std::string kind_of(const IntrusionResult& r) {
  std::string kind = r.contact_s ? "CONTACT" : r.unsafe_s ? "UNSAFE" : "";
  if (r.outcome == Outcome::undetected) kind += kind.empty() ? "UNDETECTED" : ", UNDETECTED";
  return kind.empty() ? name_of(r.outcome) : kind;
}

ordered_json number(const std::optional<double>& value) { return value ? ordered_json(std::round(*value * 1000.0) / 1000.0) : ordered_json(nullptr); }

ordered_json one(const Campaign& campaign, const IntrusionResult& r) {
  return {{"run", r.intrusion.run},
          {"kind", kind_of(r)},
          {"outcome", name_of(r.outcome)},
          {"who", describe(r.intrusion)},
          {"entered_s", number(r.record.entered_s)},
          {"seen_s", number(r.seen_s)},
          {"detected_s", number(r.record.detected_s)},
          {"detected_by", r.record.detected_s ? run::stop_reason_name(r.record.detected_by) : ""},
          {"standstill_s", number(r.record.standstill_s)},
          {"unsafe_s", number(r.unsafe_s)},
          {"contact_s", number(r.contact_s)},
          {"inside_s", r.record.inside_s},
          {"command", command_of(campaign, r)}};
}

std::string in_ms(const ordered_json& value) { return value.is_number() ? fmt::format("{:.0f} ms", value.get<double>()) : "-"; }

std::string row_of(const std::string& name, const ordered_json& f) {
  return fmt::format("  {:<26}{:>5} {:>7} {:>7} {:>9} {:>11} {:>9} {:>10} {:>10}\n", name, f["runs"].get<int>(), f["judged"].get<int>(),
                     f["unsafe"].get<int>(), f["contacts"].get<int>(),
                     fmt::format("{} ({})", f["undetected"].get<int>(), f["undetected_never_seen"].get<int>()), f["detected"].get<int>(),
                     in_ms(f["detect_ms_p50"]), in_ms(f["detect_ms_p95"]));
}

ordered_json slowest_of(const Campaign& campaign, Some some) {
  some.erase(std::remove_if(some.begin(), some.end(), [](const auto* r) { return !seen_to_stop_ms(*r); }), some.end());
  std::stable_sort(some.begin(), some.end(), [](const auto* a, const auto* b) { return *seen_to_stop_ms(*a) > *seen_to_stop_ms(*b); });
  ordered_json slowest = ordered_json::array();
  for (std::size_t i = 0; i < std::min(some.size(), slowest_listed); ++i)
    slowest.push_back({{"run", some[i]->intrusion.run},
                       {"who", describe(some[i]->intrusion)},
                       {"seen_to_stop_ms", number(seen_to_stop_ms(*some[i]))},
                       {"command", command_of(campaign, *some[i])}});
  return slowest;
}

}  // namespace

std::string command_of(const Campaign& campaign, const IntrusionResult& r) {
  return fmt::format("./berm watch --intrusions {} --seed {} --only {} --machine {}{}{}", r.intrusion.run + 1, r.intrusion.seed, r.intrusion.run, config::shell_word(campaign.machine),
                     campaign.histogram ? " --histogram" : "", campaign.when == When::learning ? " --while-learning" : "");
}

ordered_json flat_json(const Campaign& campaign) {
  const Some all = all_of(campaign);
  ordered_json out{{"machine", campaign.machine}, {"histogram", campaign.histogram}, {"seed", campaign.seed},
                   {"while_learning", campaign.when == When::learning}, {"asked", campaign.asked}};
  out.update(figures(all));
  int false_alarms = 0, truck_side_undetected = 0;
  std::vector<double> truck_side;
  for (const auto* r : all) {
    false_alarms += r->false_alarms;
    if (r->intrusion.way != Way::truck_side) continue;
    truck_side_undetected += r->outcome == Outcome::undetected ? 1 : 0;
    if (r->outcome == Outcome::detected) truck_side.push_back(*r->truck_distance_m);
  }
  out["false_alarms"] = false_alarms;
  out["truck_side_detection_m_p95"] = percentile(truck_side, 0.95);
  out["truck_side_undetected"] = truck_side_undetected;
  std::map<std::string, int> by_reason;
  for (const auto* r : all)
    if (r->outcome == Outcome::detected) ++by_reason[run::stop_reason_name(r->record.detected_by)];
  out["detected_by"] = by_reason;
  for (const auto& [group, members] : groups_of(campaign))
    for (const auto& [name, some] : members) out[group][name] = figures(some);
  ordered_json failures = ordered_json::array(), quiet = ordered_json::array();
  for (const auto* r : all) {
    if (r->failed()) failures.push_back(one(campaign, *r));
    for (const Alarm& a : r->alarms)
      if (a.nearest.empty())
        quiet.push_back({{"run", r->intrusion.run},
                         {"time_s", a.time_s},
                         {"x_m", a.x},
                         {"y_m", a.y},
                         {"height_m", a.height},
                         {"command", command_of(campaign, *r)}});
  }
  out["failures"] = failures;
  out["false_alarm_list"] = quiet;
  out["slowest"] = slowest_of(campaign, all);
  out["wall_seconds"] = campaign.wall_seconds;
  return out;
}

std::string summary_text(const Campaign& campaign) {
  const ordered_json j = flat_json(campaign);
  std::string text = fmt::format("\nIntrusions ({}{}, seed {}; a simulation, judged by the plant's truth)\n", campaign.machine,
                                 campaign.histogram ? ", histograms" : "", campaign.seed);
  if (campaign.results.size() < static_cast<std::size_t>(campaign.asked)) text += fmt::format("  interrupted: {} of {}\n", campaign.results.size(), campaign.asked);
  text += fmt::format("  {:<26}{:>5} {:>7} {:>7} {:>9} {:>11} {:>9} {:>10} {:>10}\n", "", "runs", "judged", "unsafe", "contacts", "undetected*",
                      "detected", "p50", "p95");
  text += row_of("all", j);
  for (const char* group : {"by_way", "by_size", "by_speed", "by_side", "by_merge"})
    for (const auto& [name, f] : j[group].items()) text += row_of("  " + name, f);
  text += "  * in brackets: of them those that no sensor ever met within the region\n";
  const auto row = [&text](const std::string& name, const std::string& value) { text += fmt::format("  {:<34}{}\n", name, value); };
  row("from first return to stop", fmt::format("median {}, 95 % {}, longest {}", in_ms(j["seen_to_stop_ms_p50"]), in_ms(j["seen_to_stop_ms_p95"]),
                                               in_ms(j["seen_to_stop_ms_max"])));
  row("detected by", j["detected_by"].dump());
  const auto& side = j["truck_side_detection_m_p95"];
  row("beside the truck", fmt::format("95 % detected within {} of it, {} undetected",
                                      side.is_number() ? fmt::format("{:.2f} m", side.get<double>()) : "-", j["truck_side_undetected"].get<int>()));
  row("stopped for something else", j["stopped_otherwise"].dump());
  row("less than a second inside", j["brief"].dump());
  row("false alarms", fmt::format("{}; {} trials ended by one before anybody came", j["false_alarms"].get<int>(), j["false_alarm_runs"].get<int>()));
  row("not judged", j["not_judged"].dump());
  row("time", fmt::format("{:.0f} s", campaign.wall_seconds));
  int listed = 0;
  for (const auto& r : campaign.results) {
    if (!r.failed() || ++listed > listed_most) continue;
    text += fmt::format("{} in run {}: {}\n    {}\n", kind_of(r), r.intrusion.run, describe(r.intrusion), command_of(campaign, r));
  }
  if (listed > listed_most) text += fmt::format("  ... and {} more, in --json FILE\n", listed - listed_most);
  return text;
}

std::string detail_text(const IntrusionResult& r) {
  std::string text = fmt::format("run {}: {}\n  {}\n", r.intrusion.run, describe(r.intrusion), kind_of(r));
  const auto row = [&text](const char* name, const std::optional<double>& t, const std::string& more) {
    text += fmt::format("  {:<28}{}{}\n", name, t ? fmt::format("{:8.2f} s", *t) : "       -", t ? more : "");
  };
  const IntruderRecord& k = r.record;
  row("appeared", r.appeared_s, "");
  row("entered the region", k.entered_s, "");
  row("first return from within", r.seen_s, "");
  row("first stop of the kernel", k.stopped_s, fmt::format(", {}", run::stop_reason_name(k.stopped_by)));
  row("detected", k.detected_s,
      k.detected_s ? fmt::format(", {}, {:.2f} m from the implements", run::stop_reason_name(k.detected_by), *k.distance_at_detection_m) : "");
  row("standstill", k.standstill_s, k.standstill_s ? fmt::format(", {:.2f} m from the implements", *k.distance_at_standstill_m) : "");
  row("in the swept volume", r.unsafe_s, "");
  row("contact", r.contact_s, "");
  row("end", r.ended_s, fmt::format(", {:.2f} s in the region", k.inside_s));
  for (const Alarm& a : r.alarms)
    text += fmt::format("  alarm at {:.2f} s, cell ({:.2f}, {:.2f}), height {:.2f} m: {}\n", a.time_s, a.x, a.y, a.height,
                        a.nearest.empty() ? "FALSE, nobody near" : a.nearest);
  return text;
}

}  // namespace berm::watch
