#include "plant/process/operator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contract/berm_contract.h"

namespace berm::plant {

namespace {

constexpr std::uint8_t kHeld = 2;            // berm_contract.h, stop_category: resumes by itself
constexpr double kRock = 2.0 * std::numbers::pi / 180, kRock_s = 0.6;  // the upper body nods when tracks start and stop
constexpr double kBeforeTram_s = 1.0, kAfterTram_s = 2.0, kKey_s = 0.5, kBetween_s = 1.0;
constexpr double kHeldPatience_s = 45.0;     // a stop that should resume by itself and does not: the app has called after 30 s
constexpr double kThick = 0.3;               // dust in which he cannot see what he would do
constexpr double kMoved = 3.0 * std::numbers::pi / 180;  // of any joint: the last press helped
constexpr double kRounding = 1e-6;

bool latched(const berm_heartbeat& panel) {
  return panel.kernel_state == BERM_STATE_FAULT || (panel.kernel_state == BERM_STATE_STOPPED && panel.stop_category != kHeld);
}

bool moved_since(const std::array<double, 4>& then, const std::array<double, 4>& now) {
  for (std::size_t j = 0; j < now.size(); ++j)
    if (std::abs(now[j] - then[j]) > kMoved) return true;
  return false;
}

}  // namespace

std::optional<OperatorConfig> read_operator(StrictTable& file) {
  if (!file.has("operator")) return std::nullopt;
  StrictTable t = file.table("operator");
  OperatorConfig c;
  const auto span = [&t](const char* key) {
    const auto range = t.array<2>(key, 0.0, 3600.0);
    if (range[0] > range[1]) t.fail(key, "low must not be above high");
    return range;
  };
  c.reaction_s = span("reaction_s");
  c.tram_speed = t.number("tram_speed", 0.1, 3.0);
  c.farthest_back_m = t.number("farthest_back_m", 0.0, 200.0);
  if (t.has("resets_after_s")) c.resets_after_s = span("resets_after_s");
  t.finish();
  return c;
}

Operator::Operator(const OperatorConfig& config, std::uint64_t seed) : config_(config), random_(seed ^ 0x6F70657261746F72u) {}

void Operator::enter(Stage stage, double t) {
  stage_ = stage;
  since_s_ = t;
}

// A stop that latches, or one that should have ended by itself long ago.
void Operator::attend(double t, const Sees& sees) {
  const berm_heartbeat* panel = sees.panel;
  // Standing by, with the run switch on, it should be running.
  const bool stands_by = panel != nullptr && sees.run_switch && panel->kernel_state == BERM_STATE_STANDBY;
  const bool stopped = stands_by || (panel != nullptr && (panel->kernel_state == BERM_STATE_STOPPED || panel->kernel_state == BERM_STATE_FAULT));
  if (!config_.resets_after_s || !stopped) {
    stopped_since_s_ = -1.0;
    return;
  }
  const bool now_held = !latched(*panel);
  // A map that is learned in thick dust is empty: he waits until he sees again.
  if (stopped_since_s_ < 0.0 || now_held != held_ || (now_held && sees.dust >= kThick)) {
    stopped_since_s_ = t;
    held_ = now_held;
    acts_s_.reset();
  }
  const double notices_s = stopped_since_s_ + (held_ ? kHeldPatience_s : 0.0);
  if (t < notices_s) return;
  if (!acts_s_) acts_s_ = notices_s + drawn(*config_.resets_after_s);
  if (t < *acts_s_) return;
  presses_.push_back({t, !held_, panel->stop_reason});
  stopped_since_s_ = -1.0;
  // The kernel goes on only where it sees the run switch off after a reset, and so at a start. A held machine needs no more than its map anew.
  if (!held_ || stands_by) run_ = false;
  lifting_ = pressed_at_ && !moved_since(*pressed_at_, sees.angle) && (stands_by || BERM_STOP_HAS_CELL(panel->stop_reason));
  pressed_at_ = sees.angle;
  if (lifting_) {
    run_ = false;
    hand_lifts_.push_back({t, t});
  }
  enter(lifting_ ? Stage::takes : Stage::looks, t);
}

void Operator::roll(double t, double yaw) {
  const double whole_s = distance_m_ / config_.tram_speed, gone_s = t - since_s_;
  const double way = distance_m_ * std::clamp(gone_s / whole_s, 0.0, 1.0);
  base_ = {from_.x - way * std::cos(yaw), from_.y - way * std::sin(yaw), 0, 0, 0};
  const auto nod = [gone_s](double at_s) {
    const double u = (gone_s - at_s) / kRock_s;
    return u > 0 && u < 1 ? kRock * std::sin(std::numbers::pi * u) : 0.0;
  };
  base_.pitch = nod(0.0) - nod(whole_s);
  if (gone_s < whole_s + kRock_s) return;
  base_.pitch = 0;
  back_m_ += distance_m_;
  moves_.push_back({off_s_, t, base_.x, base_.y, distance_m_});
  moved_ = true;
  enter(Stage::rests, t);
}

void Operator::step(double t, const HornSignal& signal, const Sees& sees) {
  const double gone_s = t - since_s_ + kRounding;
  moved_ = reset_ = relearn_ = false;
  switch (stage_) {
    case Stage::works:
      if (signal.what == HornSignal::What::move_back) {
        asked_s_ = t;
        refuses_ = back_m_ + signal.distance_m > config_.farthest_back_m + kRounding;
        if (refuses_) return;
        distance_m_ = signal.distance_m;
        delay_s_ = drawn(config_.reaction_s);
        enter(Stage::heard, t);
        return;
      }
      attend(t, sees);
      return;
    case Stage::heard:
      if (gone_s >= delay_s_) {
        run_ = false;
        trams_ = true;
        off_s_ = t;
        enter(Stage::stops, t);
      }
      return;
    case Stage::stops:
      if (sees.standing && gone_s >= kBeforeTram_s) enter(Stage::clears, t);
      return;
    case Stage::clears:
      if (sees.truck_about) return;
      from_ = base_;
      enter(Stage::rolls, t);
      return;
    case Stage::rolls: roll(t, sees.base_yaw); return;
    case Stage::rests:
      if (gone_s >= kAfterTram_s) enter(Stage::relearns, t);
      return;
    case Stage::looks:  // the map is learned anew where nobody stands
    case Stage::relearns:
      relearn_ = true;
      if (gone_s >= kKey_s) enter(stage_ == Stage::looks ? Stage::presses : Stage::waits, t);
      return;
    case Stage::waits:
      if (gone_s >= kBetween_s) enter(Stage::resets, t);
      return;
    case Stage::resets:
      reset_ = true;
      if (gone_s >= kKey_s) enter(Stage::run_on, t);
      return;
    case Stage::run_on:
      if (gone_s < kBetween_s) return;
      run_ = true;
      if (lifting_) hand_lifts_.back().to_s = t;
      if (trams_) moves_.back().to_s = t;
      lifting_ = trams_ = false;
      enter(Stage::works, t);
      return;
    case Stage::takes:
      if (sees.standing && gone_s >= kBetween_s) enter(Stage::lifts, t);
      return;
    case Stage::lifts:
      if (sees.implements_up && gone_s >= kBetween_s) enter(Stage::rests, t);
      return;
    case Stage::presses:
      reset_ = gone_s >= kBetween_s;
      if (gone_s >= kBetween_s + kKey_s) enter(run_ ? Stage::works : Stage::run_on, t);
      return;
  }
}

}  // namespace berm::plant
