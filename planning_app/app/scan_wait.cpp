#include "app/scan_wait.hpp"

namespace berm::app {

namespace {

nlohmann::ordered_json fields(double time_s, const Lead& lead, const char* way, double waited_s) {
  return {{"time_s", time_s}, {"way", way}, {"ahead_deg", degrees(lead.ahead)}, {"trigger_deg", degrees(lead.needed.trigger)}, {"lookahead_deg", degrees(lead.needed.lookahead)}, {"waited_s", waited_s}};
}

}  // namespace

bool ScanWait::step(double time_s, const Lead& lead, bool awaited, const char* way, const ProgressLog& log) {
  if (lead.triggered || late_) return true;
  if (!awaited) {
    since_s_ = -1.0;
    return false;
  }
  if (since_s_ < 0.0) since_s_ = time_s;
  if (time_s - since_s_ < at_most_s) return false;
  late_ = true;
  log.event("scanner_late", fields(time_s, lead, way, time_s - since_s_));
  return true;
}

void ScanWait::swing_began(double time_s, const Lead& lead, const char* way, const ProgressLog& log) {
  log.event("leads", fields(time_s, lead, way, since_s_ < 0.0 ? 0.0 : time_s - since_s_));
  since_s_ = -1.0;
  late_ = false;
}

}  // namespace berm::app
