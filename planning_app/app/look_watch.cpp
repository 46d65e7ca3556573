#include "app/look_watch.hpp"

#include <algorithm>
#include <string>

namespace berm::app {

namespace {

struct Call { std::string reason, advice; };

Call call_for(Awaited awaited) {
  const auto pan = [](const std::string& whose, const std::string& turns) {
    return Call{whose, "look whether " + turns + " from end to end, with nothing in the way, and at power and cable; the app goes on as soon as that is so"};
  };
  switch (awaited) {
    case Awaited::nothing: break;
    case Awaited::left_pan: return pan("left scanner's pan", "the left scanner's pan turns");
    case Awaited::right_pan: return pan("right scanner's pan", "the right scanner's pan turns");
    case Awaited::both_pans: return pan("both scanners' pans", "the scanners' pans turn");
    case Awaited::standstill: return {"swing creeps", "the upper body turns while the truck is looked at: look whether the machine stands level and its swing brake holds"};
    case Awaited::recogniser: return {"truck recogniser", "the app's truck recogniser does not answer: look what keeps the app's computer busy; if it stays so, end the app and start it anew"};
  }
  return {};
}

}  // namespace

bool LookWatch::step(const Observation& o, Awaited awaited, const ProgressLog& log) {
  if (awaited == Awaited::nothing) {
    told_.clear();
    since_s_ = -1.0;
    return false;
  }
  if (since_s_ < 0.0) since_s_ = o.time_s;
  if (o.time_s - since_s_ < patience) return false;
  const Call call = call_for(awaited);
  log.event("look_stands", {{"time_s", o.time_s}, {"waits", call.reason}, {"stood_s", o.time_s - since_s_}});
  if (std::find(told_.begin(), told_.end(), awaited) == told_.end()) {
    told_.push_back(awaited);
    log.event("operator_needed", {{"time_s", o.time_s}, {"reason", call.reason}, {"stopped_s", o.time_s - since_s_}, {"advice", call.advice}});
  }
  since_s_ = o.time_s;
  return true;
}

}  // namespace berm::app
