// The sequencer's look ahead: the running script is simulated from where the machine is, and what it will meet is seen before guard or kernel must slow it.
#include <cmath>

#include "app/sequencer.hpp"

namespace berm::app {

namespace {

constexpr double ahead_period = 0.25;  // s, of the skyline: as often as the kernel's map is taken

}  // namespace

// What was never seen, or too long ago, is taken as it was or as level: the scanners lead the swing over it, and the guard waits for them. False in a cycle
// in which it would be built beside the guard's.
bool Sequencer::look_for_foresight(const Observation& o) {
  if (ahead_ && o.time_s - ahead_from_s_ < ahead_period) return true;
  if (skyline_s_ == o.time_s) return ahead_.has_value();
  ahead_.emplace(machine_, site_, kernel_map_.ground(KernelMap::Unseen::level), Skyline::OverHigh::refused);
  ahead_from_s_ = o.time_s;
  return true;
}

// Not while a part of a load is poured, or the arm is drawn in to reach out again: then the goals are not the script's.
void Sequencer::foresee(const Observation& o, std::uint32_t events) {
  const bool as_script = stage_ != Stage::pass || !(load_check_.pours_part() || load_check_.keeps_rest() || reach_again_.active());
  if (!o.running() || !as_script || !look_for_foresight(o)) {
    look_ahead_.rest();
    return;
  }
  const PassCourse course{carried_kg(), brakes_.known(), poses_.dump[bucket], events};
  const LookAhead::Now now{o.time_s, &script_, &arm_, o.angle, o.velocity, course, ahead_pass_ ? &*ahead_pass_ : nullptr, &*ahead_};
  const auto change = look_ahead_.step(now);
  if (!change) return;
  tell_change(o, *change);
  if (change->what != LookAhead::Change::What::later) return;
  ahead_pass_->thresholds = change->rules.thresholds;
  script_.wait_as(pass_script(scripts_, machine_, ahead_pass_->task, ahead_pass_->poses, ahead_pass_->thresholds));
}

void Sequencer::tell_change(const Observation& o, const LookAhead::Change& change) const {
  using What = LookAhead::Change::What;
  nlohmann::ordered_json fields{{"time_s", o.time_s}, {"phase", phase_name(phase_)}};
  if (change.what == What::full_pace) {
    fields["what"] = "full pace";
  } else if (change.what == What::slowed) {
    fields.update({{"what", "slowed"}, {"swing_share", look_ahead_.shares().swing}, {"arm_share", look_ahead_.shares().arm}});
  } else {
    const PassThresholds &was = ahead_pass_->thresholds, &to = change.rules.thresholds;
    fields.update({{"what", "later"}, {"rule", change.rules.what}, {"later_deg", degrees(std::fabs(to.*change.rules.threshold - was.*change.rules.threshold))}});
  }
  if (change.what != What::full_pace) {
    const LookAhead::Foreseen& f = change.foreseen;
    fields.update({{"ahead_s", f.seconds}, {"part", name_of(f.part)}, {"by", f.by.name()}});
    if (f.by.of_ground()) fields.update({{"bearing_deg", degrees(f.by.bearing)}, {"distance_m", f.by.distance}, {"height_m", f.by.height}});
  }
  log_.event("look_ahead", fields);
}

}  // namespace berm::app
