// Trucks loaded with nobody there, run after run of the whole stack, until so many hours are simulated: every alarm is false.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace berm::watch {

struct QuietOptions {
  double hours = 1.0;
  std::uint64_t seed = 1;      // of the first run; the next has the next
  std::string machine;         // name or file
  bool histogram = false;
  std::string profiles;
  int jobs = 0;                // runs at a time; 0: one a core. The result does not depend on it
};

struct QuietAlarm {
  std::uint64_t seed = 1;
  double time_s = 0.0, for_s = 0.0;  // when it began, and how long the kernel said intruder
  double x = 0.0, y = 0.0, height = 0.0;
  std::string what;            // stood there, by the plant's truth
};

struct QuietRun {
  std::uint64_t seed = 1;
  double seconds = 0.0, held_s = 0.0;  // simulated; of them with the machine held by an alarm
  double idle_s = 0.0;                 // and standing for another reason for more than 30 s, from then on
  int trucks_loaded = 0, contacts = 0, other_stops = 0;
  std::string end_reason;
  std::vector<QuietAlarm> alarms;
};

struct QuietResult {
  QuietOptions options;
  std::vector<QuietRun> runs;
  double wall_seconds = 0.0;
  double seconds() const;      // in which an alarm could begin: simulated, less those with the machine held by one, or standing for long
  int false_alarms() const;
  int contacts() const;
};

// told: after each round of runs, what there is so far; may be empty.
QuietResult watch_quiet_hours(const QuietOptions& options, const std::function<void(const QuietResult&)>& told);
nlohmann::ordered_json flat_json(const QuietResult& result);
std::string summary_text(const QuietResult& result);

}  // namespace berm::watch
