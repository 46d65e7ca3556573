#include "app/start_call.hpp"

#include <algorithm>
#include <cmath>

#include "app/operator_advice.hpp"

namespace berm::app {

namespace {

constexpr double turns = radians(1.0);  // more than a pan's noise
constexpr double pan_silent = 5.0;      // s: the app has both sweep, and the kernel has them from the scanners' packets

}  // namespace

void StartCall::watch_pans(const Observation& o) {
  for (std::size_t i = 0; i < pan_.size(); ++i) {
    if (std::fabs(o.pan[i] - pan_[i]) < turns) continue;
    pan_[i] = o.pan[i];
    turned_s_[i] = o.time_s;
  }
}

// What the kernel's state shows of what it does not hear; of stop keys, panel, inclination and lidars it shows nothing.
StartCall::Call StartCall::not_started(const Observation& o) const {
  const std::string keys = "release the emergency stop and the stop keys of operator and spotter";
  std::string look;
  if (o.angle == Joints{}) look = "no joint angles come: look at the machine's bus and the joint sensors; ";
  else
    for (std::size_t i = 0; i < pan_.size(); ++i)
      if (turned_s_[i] < 0.0 || o.time_s - turned_s_[i] > pan_silent)
        look += "the " + eye_names(BERM_SIGHT_BLOCKED(i)) + " sends nothing or its pan does not turn: look at its power and cable; ";
  if (o.blocked_eyes != 0) look += "something lies on a window (" + eye_names(o.blocked_eyes) + "): clean it; ";
  const std::string rest = look.empty() ? "; look whether panel, machine, emergency stop receiver, inclination and azimuth sensors and each lidar are on and send" : "";
  return {"kernel not started", "the kernel does not start: " + look + keys + rest};
}

StartCall::Call StartCall::call_for(const Observation& o) {
  if (o.kernel_state == BERM_STATE_INIT) return not_started(o);
  if (o.kernel_state != BERM_STATE_STANDBY) return {};
  if (!o.run_switch) return ran_ ? Call{} : Call{"run switch off", "look whether the machine may start, then switch run on"};  // whatever else keeps it
  if (o.release_awaited || o.stop_reason != BERM_STOP_NONE) return {};  // RestartCall's, Recovery's
  return {"requests refused", std::string("the kernel takes no request of the app (") + request_result_name(refused_) +
                                  "): look whether kernel and app are of one version and have the same machine file, then end the app and start it anew"};
}

void StartCall::step(const Observation& o, const ProgressLog& log) {
  watch_pans(o);
  if (o.request_result != BERM_REQUEST_NONE && o.request_result != BERM_REQUEST_ACCEPTED) refused_ = o.request_result;
  if (o.running()) ran_ = true;
  else if (o.latched || o.kernel_state == BERM_STATE_INIT) ran_ = false;
  if (o.running() || o.latched) told_.clear();
  const Call call = call_for(o);
  if (call.advice != due_) {
    due_ = call.advice;
    since_s_ = o.time_s;
  }
  if (due_.empty() || o.time_s - since_s_ < patience || std::find(told_.begin(), told_.end(), due_) != told_.end()) return;
  told_.push_back(due_);
  log.event("operator_needed", {{"time_s", o.time_s}, {"reason", call.reason}, {"stopped_s", o.time_s - since_s_}, {"advice", due_}});
}

}  // namespace berm::app
