// Judges what the kernel did about the people and vehicles of a run, from the plant's truth: when each came into the safety region, when the kernel
// stopped for it, when the machine then stood. WATCH.md has the definitions.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "config/parameter_block.h"
#include "core/monitor_rules.h"
#include "io/workspace_watch.hpp"
#include "watch/footprint.hpp"

namespace berm::watch {

constexpr double alarm_within_m = 1.0;       // of the published cell: nobody nearer, and the alarm is false
constexpr double moved_m = 1.0;              // who is in the region from the first enters it when it has gone so far
constexpr double standstill_rad_s = 0.5 * 3.14159265358979323846 / 180.0, standstill_s = 0.2;

// What the kernel gave out and held in a cycle, and whether the machine's joints truly stand.
struct Moment {
  double time_s = 0.0;
  std::uint8_t kernel_state = 0, stop_reason = 0;  // BERM_STATE_*, BERM_STOP_*
  double cell_x = 0.0, cell_y = 0.0, cell_height = 0.0;  // published with a reason that has a cell, m
  bool still = false;                              // every joint slower than standstill_rad_s
  std::array<Held, 1 + BERM_LIDARS> monitors{};    // those that there are
  Region region;                                   // its rules: those that compare the least often
};

std::array<Held, 1 + BERM_LIDARS> monitors_of(const kernel::WorkspaceWatch& workspace);

// Where one of them truly is.
struct Presence {
  bool present = false;
  Footprint footprint;
  double implements_m = 0.0;                       // to the nearest implement, by the oracle
};

struct IntruderRecord {
  std::string name;
  std::optional<double> entered_s, detected_s, standstill_s;
  std::optional<double> stopped_s;                 // the kernel first left RUN after it had entered, for whatever reason
  std::uint8_t detected_by = 0, stopped_by = 0;    // BERM_STOP_*
  std::optional<double> distance_at_detection_m, distance_at_standstill_m;
  Footprint at_detection;
  double inside_s = 0.0;                           // how long its middle was in a watched cell
  bool stood_at_entry = false;                     // the kernel was not in RUN when it entered
  bool inside = false;                             // now
  std::optional<Footprint> stood;                  // where it was in the region from the first: the kernel takes it for ground there
};

struct Alarm {                                     // an intruder stop that begins
  double time_s, x, y, height;
  std::string nearest;                             // who was within alarm_within_m of the cell; empty: a false alarm
};

class IntruderWatch {
 public:
  explicit IntruderWatch(const std::vector<std::string>& names);

  // Once a cycle; one presence for each name, in their order.
  void step(const Moment& now, const std::vector<Presence>& presences);

  void rename(std::size_t i, const std::string& name) { records_[i].name = name; }
  const std::vector<IntruderRecord>& records() const { return records_; }
  const std::vector<Alarm>& alarms() const { return alarms_; }
  int false_alarms() const;
  // Every joint has been still for standstill_s.
  bool standing() const { return standing_; }

 private:
  struct Seen { double time_s; Footprint footprint; };
  double nearest_on_track(std::size_t i, double x, double y) const;
  void keep_track(const Moment& now, const std::vector<Presence>& presences);
  void enter(const Moment& now, const Presence& presence, IntruderRecord& record) const;
  void detect(const Moment& now, const Presence& presence, std::size_t i, bool stops_now);
  void stand(const Moment& now, const std::vector<Presence>& presences);
  void note_alarm(const Moment& now);

  std::vector<IntruderRecord> records_;
  std::vector<Alarm> alarms_;
  std::vector<std::deque<Seen>> track_;            // where each was while what a sensor saw may still be waiting for its comparison
  std::vector<double> distance_when_still_;
  double still_since_s_ = -1.0;
  bool standing_ = false;
  bool begun_ = false;
  std::uint8_t state_before_ = 0, reason_before_ = 0;
};

}  // namespace berm::watch
