// A kernel that does not get as far as RUN and publishes no reason: it stays in INIT, where a pressed stop or a sensor that was never heard keeps it
// (SK-CY-1, SK-ST-4), or stands by for a run switch or a request that it takes. The operator is told, once of each thing. A machine that was at work and
// is paused by the switch is nobody's trouble.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/observation.hpp"
#include "app/progress_log.hpp"

namespace berm::app {

class StartCall {
public:
  static constexpr double patience = 30.0;  // s
  void step(const Observation& o, const ProgressLog& log);

private:
  struct Call { std::string reason, advice; };
  void watch_pans(const Observation& o);
  Call call_for(const Observation& o);
  Call not_started(const Observation& o) const;

  std::string due_;                           // the advice that is going to be given ...
  double since_s_ = 0.0;                      // ... if it is the right one for so long
  std::vector<std::string> told_;             // since the kernel last ran
  bool ran_ = false;                          // since the start, or the last stop that latched
  std::uint8_t refused_ = BERM_REQUEST_NONE;  // the newest request that was not taken
  std::array<double, 2> pan_{};               // rad, when it was last seen to turn
  std::array<double, 2> turned_s_{-1.0, -1.0};  // negative: never
};

}  // namespace berm::app
