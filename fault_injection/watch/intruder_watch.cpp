#include "watch/intruder_watch.hpp"

#include <algorithm>
#include <cmath>

#include "contract/berm_contract.h"

namespace berm::watch {

namespace {
constexpr double cycle_s = 0.01, rounding_s = 1e-6;
constexpr double track_every_s = 0.1;
}  // namespace

std::array<Held, 1 + BERM_LIDARS> monitors_of(const kernel::WorkspaceWatch& workspace) {
  std::array<Held, 1 + BERM_LIDARS> monitors{};
  for (int i = 0; i < workspace.monitors(); ++i) monitors[static_cast<std::size_t>(i)] = {&workspace.monitor(i), workspace.histogram(i)};
  return monitors;
}

IntruderWatch::IntruderWatch(const std::vector<std::string>& names) : track_(names.size()), distance_when_still_(names.size(), 0.0) {
  for (const auto& name : names) {
    records_.emplace_back();
    records_.back().name = name;
  }
}

int IntruderWatch::false_alarms() const {
  return static_cast<int>(std::count_if(alarms_.begin(), alarms_.end(), [](const Alarm& a) { return a.nearest.empty(); }));
}

// What a cell shows may be as old as the monitor lets it wait, and two comparisons.
void IntruderWatch::keep_track(const Moment& now, const std::vector<Presence>& presences) {
  const double oldest_s = now.time_s - (now.region.rules->wait_us + 2.0 * now.region.rules->period_us) * 1e-6;
  for (std::size_t i = 0; i < track_.size(); ++i) {
    auto& track = track_[i];
    while (!track.empty() && track.front().time_s < oldest_s) track.pop_front();
    const bool due = track.empty() || now.time_s - track.back().time_s > track_every_s - rounding_s;
    if (presences[i].present && due) track.push_back({now.time_s, presences[i].footprint});
  }
}

double IntruderWatch::nearest_on_track(std::size_t i, double x, double y) const {
  double least = 1e9;
  for (const Seen& seen : track_[i]) least = std::min(least, distance(seen.footprint, x, y));
  return least;
}

void IntruderWatch::enter(const Moment& now, const Presence& presence, IntruderRecord& record) const {
  record.inside = presence.present && meets_region(presence.footprint, now.region);
  if (presence.present && watched_at(now.region, presence.footprint.x, presence.footprint.y)) record.inside_s += cycle_s;
  if (!begun_ && record.inside) record.stood = presence.footprint;
  if (!record.inside) record.stood.reset();
  if (!record.inside || record.entered_s) return;
  if (record.stood && std::hypot(presence.footprint.x - record.stood->x, presence.footprint.y - record.stood->y) < moved_m) return;
  record.entered_s = now.time_s;
  record.stood_at_entry = state_before_ != BERM_STATE_RUN;
}

void IntruderWatch::detect(const Moment& now, const Presence& presence, std::size_t i, bool stops_now) {
  IntruderRecord& record = records_[i];
  if (!record.entered_s) return;
  if (stops_now && !record.stopped_s) {
    record.stopped_s = now.time_s;
    record.stopped_by = now.stop_reason;
  }
  if (record.detected_s) return;
  bool found = false;
  if (now.stop_reason == BERM_STOP_INTRUDER) {
    found = nearest_on_track(i, now.cell_x, now.cell_y) <= alarm_within_m || std::any_of(track_[i].begin(), track_[i].end(), [&](const Seen& s) {
              return std::any_of(now.monitors.begin(), now.monitors.end(), [&](const Held& held) {
                return somebody_near(s.footprint, alarm_within_m, held, *now.region.rules);
              });
            });
  } else if (stops_now && BERM_STOP_HAS_CELL(now.stop_reason)) {
    found = nearest_on_track(i, now.cell_x, now.cell_y) <= alarm_within_m;
  }
  if (!found) return;
  record.detected_s = now.time_s;
  record.detected_by = now.stop_reason;
  record.distance_at_detection_m = presence.implements_m;
  record.at_detection = presence.footprint;
}

void IntruderWatch::stand(const Moment& now, const std::vector<Presence>& presences) {
  if (!now.still) still_since_s_ = -1.0;
  if (now.still && still_since_s_ < 0.0) {
    still_since_s_ = now.time_s;
    for (std::size_t i = 0; i < presences.size(); ++i) distance_when_still_[i] = presences[i].implements_m;
  }
  standing_ = now.still && now.time_s - still_since_s_ > standstill_s - rounding_s;
  for (std::size_t i = 0; i < records_.size() && standing_; ++i) {
    IntruderRecord& record = records_[i];
    if (!record.detected_s || record.standstill_s) continue;
    const bool stood_before = still_since_s_ <= *record.detected_s;
    record.standstill_s = stood_before ? *record.detected_s : still_since_s_;
    record.distance_at_standstill_m = stood_before ? *record.distance_at_detection_m : distance_when_still_[i];
  }
}

void IntruderWatch::note_alarm(const Moment& now) {
  Alarm alarm{now.time_s, now.cell_x, now.cell_y, now.cell_height, {}};
  double least = alarm_within_m;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const double away = nearest_on_track(i, now.cell_x, now.cell_y);
    if (away > least) continue;
    least = away;
    alarm.nearest = records_[i].name;
  }
  alarms_.push_back(alarm);
}

void IntruderWatch::step(const Moment& now, const std::vector<Presence>& presences) {
  keep_track(now, presences);
  for (std::size_t i = 0; i < records_.size(); ++i) enter(now, presences[i], records_[i]);
  const bool stops_now = state_before_ == BERM_STATE_RUN && now.kernel_state != BERM_STATE_RUN && now.stop_reason != BERM_STOP_NONE;
  if (now.stop_reason == BERM_STOP_INTRUDER && reason_before_ != BERM_STOP_INTRUDER) note_alarm(now);
  for (std::size_t i = 0; i < records_.size(); ++i) detect(now, presences[i], i, stops_now);
  stand(now, presences);
  begun_ = true;
  state_before_ = now.kernel_state;
  reason_before_ = now.stop_reason;
}

}  // namespace berm::watch
