#include "perception/scan_scheduler.hpp"

#include <algorithm>
#include <cmath>

#include "contract/berm_contract.h"

namespace berm::app {

namespace {

constexpr std::size_t left = 0, right = 1;
constexpr double at_end = radians(1.5);
constexpr double narrowest = radians(4.0);
constexpr double under_boom = radians(42.0);   // inwards, to the ground below the boom that only the heads beside it can see
constexpr double beyond_dig = radians(90.0);    // the stop beyond the dig, seen from a head at the side of near ground
constexpr double lead_near = radians(45.0), lead_far = radians(85.0);  // ahead of a moving swing: its stop angle, and the parallax of near ground
constexpr double past_truck = radians(55.0);    // the implements' width, the overshoot of a stop, parallax
constexpr double pi = std::numbers::pi;
constexpr double beyond_truck = radians(50.0);
constexpr double before_dig = radians(60.0);    // the columns beyond the last dig, the implements' width

}  // namespace

ScanScheduler::ScanScheduler(const MachineModel& machine) : machine_(machine) {}

void ScanScheduler::begin_full_sweep() {
  for (Head& h : head_) h.low_seen = h.high_seen = false;
  was_slowed_ = false;
  at_end_s_ = 0.0;
}

bool ScanScheduler::full_sweep_done() const {
  return std::all_of(head_.begin(), head_.end(), [](const Head& h) { return h.low_seen && h.high_seen; });
}

PanSector ScanScheduler::sector(std::size_t scanner, std::uint16_t phase, double dig, double truck, double swing_angle) const {
  const ScannerMount& mount = machine_.scanner[scanner];
  const PanSector whole{mount.pan_low, mount.pan_high};
  const bool truck_left = truck >= dig;
  const std::size_t ahead = truck_left ? left : right;  // the scanner on the truck's side leads on the way there
  const double side = truck_left ? 1.0 : -1.0;
  PanSector bearings;  // base frame
  switch (phase) {
    case BERM_PHASE_DIG:
      if (scanner == ahead) bearings = {swing_angle - side * under_boom, swing_angle + side * radians(120.0)};
      else bearings = {dig + side * under_boom, dig - side * beyond_dig};
      break;
    case BERM_PHASE_LIFT:
      // Before the swing begins the leading scanner must have passed over what comes first, out to its far end: the pan cannot outrun the swing.
      if (scanner == ahead) bearings = {swing_angle + side * lead_near, swing_angle + side * pi};
      else bearings = {dig + side * under_boom, dig - side * beyond_dig};
      break;
    case BERM_PHASE_SWING_TO_TRUCK:
      // At its far end until the swing has carried it past the truck; then ahead of the stop angle.
      if (scanner == ahead) bearings = far_seen_ ? PanSector{swing_angle + side * lead_near, swing_angle + side * lead_far} : PanSector{swing_angle + side * pi, swing_angle + side * pi};
      else bearings = {swing_angle + side * radians(15.0), dig - side * radians(40.0)};
      break;
    case BERM_PHASE_DUMP:
      if (scanner == ahead) bearings = {swing_angle - side * under_boom, truck + side * beyond_truck};
      else bearings = {swing_angle - side * radians(5.0), swing_angle - side * radians(75.0)};  // where the swing back begins, seen just before
      break;
    case BERM_PHASE_SWING_TO_DIG:
      if (scanner == ahead) bearings = {swing_angle - side * radians(20.0), truck + side * radians(25.0)};
      else bearings = {swing_angle - side * lead_near, swing_angle - side * lead_far};
      break;
    default: return whole;
  }
  return to_pans(scanner, bearings, swing_angle);
}

bool ScanScheduler::end_beyond_dig_seen(std::size_t scanner) const { return scanner == right ? head_[right].low_seen : head_[left].high_seen; }

PanSector ScanScheduler::end_beyond_dig(std::size_t scanner) const {
  const ScannerMount& mount = machine_.scanner[scanner];
  return scanner == right ? PanSector{mount.pan_low, mount.pan_low + narrowest} : PanSector{mount.pan_high - narrowest, mount.pan_high};
}

// beyond_dig_by: of where a scanner looks, rad. One that goes beyond the dig has seen its end there when the swing has carried it past, or will not.
void ScanScheduler::note_seen(std::size_t scanner, double pan, bool goes_beyond, double beyond_dig_by) {
  constexpr double waits_at_most_s = 3.0;
  const ScannerMount& mount = machine_.scanner[scanner];
  const bool at_low = pan < mount.pan_low + 2.0 * at_end, at_high = pan > mount.pan_high - 2.0 * at_end;
  const bool waits = goes_beyond && (scanner == right ? at_low : at_high);
  if (waits) at_end_s_ += machine_.cycle;
  if (waits && beyond_dig_by < before_dig && at_end_s_ < waits_at_most_s) return;
  head_[scanner].low_seen = head_[scanner].low_seen || at_low;
  head_[scanner].high_seen = head_[scanner].high_seen || at_high;
}

// While the other scanner looks at the truck.
PanSector ScanScheduler::beside_look(std::size_t scanner, double dig, double truck, double swing_angle) const {
  const double side = truck >= dig ? 1.0 : -1.0;
  return to_pans(scanner, {swing_angle + side * under_boom, dig - side * before_dig}, swing_angle);
}

PanSector ScanScheduler::to_pans(std::size_t scanner, const PanSector& bearings, double swing_angle) const {
  const ScannerMount& mount = machine_.scanner[scanner];
  const PanSector whole{mount.pan_low, mount.pan_high};
  PanSector s{std::min(bearings.low, bearings.high) - swing_angle, std::max(bearings.low, bearings.high) - swing_angle};
  s.low = std::clamp(s.low, whole.low, whole.high);
  s.high = std::clamp(s.high, whole.low, whole.high);
  if (s.high - s.low < narrowest) {
    const double middle = std::clamp(0.5 * (s.low + s.high), whole.low + 0.5 * narrowest, whole.high - 0.5 * narrowest);
    s = {middle - 0.5 * narrowest, middle + 0.5 * narrowest};
  }
  return s;
}

void ScanScheduler::begin_look(std::size_t scanner, const PanSector& bearings) {
  looker_ = scanner;
  look_bearings_ = bearings;
  look_ = Look::goes;
  const std::size_t other = scanner == left ? right : left;
  head_[other].up = other == right;
  feet_seen_ = false;
}

PanRequest ScanScheduler::look(double swing_angle, double pan) {
  constexpr double there = radians(0.5);
  const ScannerMount& mount = machine_.scanner[looker_];
  const auto to_pan = [&](double bearing) { return std::clamp(bearing - swing_angle, mount.pan_low, mount.pan_high); };
  const double low = to_pan(look_bearings_.low), high = to_pan(look_bearings_.high);
  if (look_ == Look::goes) {
    look_up_ = pan < 0.5 * (low + high);
    if (std::fabs(pan - (look_up_ ? low : high)) < there) look_ = Look::sweeps;
  }
  if (look_ == Look::goes) return {look_up_ ? low : high, std::min(azimuth_rate, mount.pan_rate_max)};
  const double end = look_up_ ? high : low;
  if (std::fabs(pan - end) < there) look_ = Look::done;
  return {end, std::min(look_rate, mount.pan_rate_max)};
}

std::array<PanRequest, 2> ScanScheduler::step(std::uint16_t phase, double dig, double truck, double swing_angle, double swing_speed, const std::array<double, 2>& pan,
                                              bool slowed) {
  std::array<PanRequest, 2> request;
  const std::size_t ahead = truck >= dig ? left : right;
  const double side = truck >= dig ? 1.0 : -1.0;
  if (slowed) begin_full_sweep();
  was_slowed_ = was_slowed_ || slowed;
  const bool back_soon = was_slowed_ && !slowed && (phase == BERM_PHASE_DUMP || phase == BERM_PHASE_SWING_TO_DIG);
  if (phase != BERM_PHASE_SWING_TO_TRUCK) far_seen_ = false;
  else if (side * (pan[ahead] + swing_angle - truck) > past_truck) far_seen_ = true;
  for (std::size_t i = 0; i < head_.size(); ++i) {
    const ScannerMount& mount = machine_.scanner[i];
    Head& head = head_[i];
    if (look_ != Look::none && i == looker_) {
      request[i] = look(swing_angle, pan[i]);
      continue;
    }
    if (!slowed) note_seen(i, pan[i], back_soon && i != ahead, side * (dig - pan[i] - swing_angle));
    const bool whole = !(head.low_seen && head.high_seen);
    // On the swing back the ground beyond the dig comes first, on which only the looks of a dig fall: the swing does not wait until it comes in its turn.
    const bool end_first = whole && i != ahead && (back_soon || phase == BERM_PHASE_SWING_TO_DIG) && !end_beyond_dig_seen(i);
    const PanSector beside = beside_look(i, dig, truck, swing_angle);
    if (i != looker_ && (i == right ? pan[i] > beside.high - at_end : pan[i] < beside.low + at_end)) feet_seen_ = true;
    const PanSector s = end_first ? end_beyond_dig(i) : whole ? PanSector{mount.pan_low, mount.pan_high} : look_ != Look::none ? beside : sector(i, phase, dig, truck, swing_angle);
    if (pan[i] > s.high - at_end) head.up = false;
    if (pan[i] < s.low + at_end) head.up = true;
    const double direction = head.up ? 1.0 : -1.0;
    const bool hurries = end_first && back_soon && (pan[i] < s.low || pan[i] > s.high);
    const double rate = hurries ? mount.pan_rate_max : std::max(radians(1.0), azimuth_rate - direction * swing_speed);
    request[i] = {head.up ? s.high : s.low, std::min(rate, mount.pan_rate_max)};
  }
  return request;
}

}  // namespace berm::app
