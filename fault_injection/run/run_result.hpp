// The result of one run, merged from the plant's ground truth, the kernel's report, the app's log and the recorder.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/memory_watch.hpp"
#include "run/recorder.hpp"
#include "run/run_options.hpp"
#include "run/shift_measures.hpp"

namespace berm::run {

struct RunResult {
  RunOptions options;
  nlohmann::json truth;                     // truth.json of the plant
  nlohmann::json kernel;                    // report of the kernel at its end; null when it was killed
  std::vector<nlohmann::json> app_events;
  double wall_seconds = 0.0;
  std::string interrupted;                  // the signal that ended the run: "Interrupt", "Terminated"; empty: none did
  bool fault_struck = false;                // that of --fault
  int contacts = 0;
  int pids[4] = {};                         // plant, kernel, app, journal
  std::map<std::string, int> stops;
  std::vector<StopEvent> stop_events;
  int kernel_faults = 0;
  std::string first_fault;
  std::uint64_t journal_lost = 0;           // cycles whose record did not reach the journal
  ShiftMeasures measures;
  MemoryGrowth memory;
  std::vector<std::string> notes;           // things a person should know
};

// What an app's event "held" names: what stands in the way, and where.
std::string held_by(const nlohmann::json& held);
// What an app's event "operator_needed" is for: the stop's reason, how long, and where.
std::string operator_needed_for(const nlohmann::json& event);
// The largest of that key in the plant's truth of the trucks that left; nothing before one has.
std::optional<double> worst_of_trucks_left(const nlohmann::json& truth, const char* key);
// The documented flat object.
nlohmann::json flat_json(const RunResult& result);
// What a person reads.
std::string summary_text(const RunResult& result);
// Whether the run did what the command is for; otherwise the reasons.
std::vector<std::string> shortcomings(const RunResult& result);

}  // namespace berm::run
