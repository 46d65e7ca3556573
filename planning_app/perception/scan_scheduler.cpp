#include "perception/scan_scheduler.hpp"

#include <algorithm>
#include <cmath>

#include "contract/berm_contract.h"
#include "motion/joint_response.hpp"

namespace berm::app {

namespace {

constexpr std::size_t left = 0, right = 1;
constexpr double at_end = radians(1.5);
constexpr double narrowest = radians(4.0);
constexpr double under_boom = radians(42.0);   // inwards, to the ground below the boom that only the heads beside it can see
constexpr double beyond_dig = radians(90.0);    // the stop beyond the dig, seen from a head at the side of near ground
constexpr double lead_width = radians(40.0);     // of the leading scanner's sector during a swing, outwards from what the swing needs
constexpr double spare_s = 0.3;                 // a dig may end so much sooner than it is expected to
constexpr double back_least = radians(12.0);     // ahead of a swing back that is slow yet: the implements' width, parallax
constexpr double back_faster = 0.1;             // rad/s: than it is now it soon will be
constexpr double past_truck = radians(55.0);    // the implements' width, the overshoot of a stop, parallax
constexpr double pi = std::numbers::pi;
constexpr double beyond_truck = radians(50.0);
constexpr double before_dig = radians(60.0);    // the columns beyond the last dig, the implements' width
constexpr double bed_half = radians(25.0);      // of the bed, to either side of its middle
constexpr double waits_within = radians(6.0);   // of where the sweep over the face begins
constexpr double face_half = radians(20.0);     // of the face to either side of the next dig

bool swings(std::uint16_t phase) { return phase == BERM_PHASE_SWING_TO_TRUCK || phase == BERM_PHASE_SWING_TO_DIG; }

}  // namespace

ScanScheduler::ScanScheduler(const MachineModel& machine) : machine_(machine), table_(machine_) {}

void ScanScheduler::learn_braking(double empty_brake) {
  constexpr double noticeable = 0.05;
  if (std::fabs(empty_brake - table_.empty_brake()) > noticeable * std::max(empty_brake, table_.empty_brake())) table_ = LookaheadTable(machine_, empty_brake);
}

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
      if (scanner == ahead) bearings = {swing_angle + side * inner_, swing_angle + side * radians(120.0)};
      else bearings = {dig + side * under_boom, dig - side * beyond_dig};
      break;
    case BERM_PHASE_LIFT:
      // Before the swing begins the leading scanner must have passed over what comes first, out to its far end: the pan cannot outrun the swing.
      if (scanner == ahead) bearings = {swing_angle + side * inner_, swing_angle + side * pi};
      else bearings = {dig + side * (face_half + waits_within), dig + side * face_half};  // where its sweep over the face begins
      break;
    case BERM_PHASE_SWING_TO_TRUCK:
      // At its far end until the swing has carried it past the truck; then ahead of the stop angle.
      if (scanner == ahead) bearings = far_seen_ ? PanSector{swing_angle + side * inner_, swing_angle + side * (inner_ + lead_width)} : PanSector{swing_angle + side * pi, swing_angle + side * pi};
      else if (!face_bare_) bearings = {dig + side * (face_half + waits_within), dig + side * face_half};
      else bearings = {face_.seen ? swing_angle + side * radians(15.0) : dig + side * face_half, dig - side * radians(40.0)};
      break;
    case BERM_PHASE_DUMP:
      if (scanner == ahead) bearings = {swing_angle - side * under_boom, truck + side * beyond_truck};
      else bearings = {swing_angle - side * radians(5.0), swing_angle - side * radians(75.0)};  // where the swing back begins, seen just before
      break;
    case BERM_PHASE_SWING_TO_DIG:
      if (scanner == ahead) bearings = {bed_.seen ? swing_angle - side * radians(20.0) : truck - side * bed_half, truck + side * bed_half};
      else bearings = {swing_angle - side * inner_, swing_angle - side * (inner_ + lead_width)};
      break;
    default: return whole;
  }
  return to_pans(scanner, bearings, swing_angle);
}

// Before a swing the leading scanner's sector begins no farther inward than it can come out from to the trigger angle until the swing begins; during one at what
// its speed, and what it may yet speed up to, need.
void ScanScheduler::plan_lead(std::uint16_t phase, double dig, double truck, double swing_angle, double swing_speed, const ComingSwing& coming) {
  const std::size_t to_truck = truck >= dig ? left : right;
  const bool back = phase == BERM_PHASE_DUMP || phase == BERM_PHASE_SWING_TO_DIG;
  lead_.scanner = back ? (to_truck == left ? right : left) : to_truck;
  // A swing that goes on is one from a standstill that has come to its speed: a full bucket's takes the longest way.
  const double sped_up = swings(phase) ? 0.5 * swing_speed * swing_speed / responses_of(machine_, swing, machine_.braking.reach.back(), machine_.bucket_payload_kg).up.acceleration : 0.0;
  lead_.needed = table_.of(lead_.scanner, std::fabs((back ? dig : truck) - swing_angle) + sped_up, coming.reach_m);
  lead_.required = table_.required(lead_.scanner, swing_speed, coming.reach_m);
  const double way_out = azimuth_rate * std::max(0.0, coming.begins_in_s - spare_s), turned = lead_.needed.trigger + table_.turn_way() + at_end;
  if (phase == BERM_PHASE_SWING_TO_DIG) inner_ = std::max(back_least, table_.required(lead_.scanner, std::fabs(swing_speed) + back_faster, coming.reach_m));
  else if (swings(phase)) inner_ = std::max(lead_.needed.lookahead, lead_.required);
  else if (phase == BERM_PHASE_LIFT) inner_ = turned;
  else inner_ = std::max(-under_boom, turned - way_out);
}

void ScanScheduler::Stretch::look(double bearing, const PanSector& wanted) {
  from = std::min(from, bearing);
  to = std::max(to, bearing);
  seen = seen || (from < wanted.low + at_end && to > wanted.high - at_end);
}

// What was poured, on the swing back. The scanner begins towards the bed's end that is nearer: else it would come inward with the swing, and see nothing of the rest.
void ScanScheduler::note_bed(std::size_t scanner, double truck, double swing_angle, double pan) {
  if (phase_ != BERM_PHASE_SWING_TO_DIG) {
    bed_.begin(pan + swing_angle);
    head_[scanner].up = pan + swing_angle > truck;
  }
  const PanSector bed = to_pans(scanner, {truck - bed_half, truck + bed_half}, swing_angle);
  bed_.look(pan + swing_angle, {bed.low + swing_angle, bed.high + swing_angle});
}

// What was dug, once the swing to the truck has left it: outwards over it, against the swing, with which a scanner that came inward would only go along.
void ScanScheduler::note_face(std::size_t scanner, double dig, double truck, double swing_angle, double pan) {
  constexpr double away = radians(30.0);
  const double side = truck >= dig ? 1.0 : -1.0;
  if (phase_ != BERM_PHASE_SWING_TO_TRUCK) {
    left_at_ = swing_angle;
    face_bare_ = false;
  }
  if (!face_bare_ && side * (swing_angle - left_at_) > away) {
    face_bare_ = true;
    face_.begin(pan + swing_angle);
    head_[scanner].up = scanner == left;
  }
  if (face_bare_) face_.look(pan + swing_angle, {dig - face_half, dig + face_half});
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
  look_on_the_way_ = false;
  const std::size_t other = scanner == left ? right : left;
  head_[other].up = other == right;
  feet_seen_ = false;
}

void ScanScheduler::begin_look_on_the_way(std::size_t scanner, const PanSector& bearings) {
  begin_look(scanner, bearings);
  look_on_the_way_ = true;
}

PanRequest ScanScheduler::look(double swing_angle, double swing_speed, double pan) {
  constexpr double there = radians(0.5), nearly_there = radians(2.0);
  const ScannerMount& mount = machine_.scanner[looker_];
  const auto to_pan = [&](double bearing) { return std::clamp(bearing - swing_angle, mount.pan_low, mount.pan_high); };
  const double low = to_pan(look_bearings_.low), high = to_pan(look_bearings_.high);
  if (look_ == Look::goes) {
    look_up_ = look_on_the_way_ ? looker_ == right : pan < 0.5 * (low + high);
    // The pan's range may end before it, until the machine has swung to where it waits.
    const double begin = look_on_the_way_ ? (look_up_ ? look_bearings_.low : look_bearings_.high) - swing_angle : look_up_ ? low : high;
    if (std::fabs(pan - begin) < (look_on_the_way_ ? nearly_there : there)) look_ = Look::sweeps;
  }
  if (look_ == Look::goes) return {look_up_ ? low : high, look_on_the_way_ ? mount.pan_rate_max : std::min(azimuth_rate, mount.pan_rate_max)};
  const double end = look_up_ ? high : low, sense = look_up_ ? 1.0 : -1.0;
  // A swing carries the end past it.
  if (std::fabs(pan - end) < there || (look_on_the_way_ && sense * (pan - end) > 0.0)) look_ = Look::done;
  if (!look_on_the_way_ || look_ == Look::done) return {end, std::min(look_rate, mount.pan_rate_max)};
  const double rate = look_rate - sense * swing_speed;  // negative: the swing alone is faster than the sweep
  return {rate > 0.0 ? end : look_up_ ? mount.pan_low : mount.pan_high, std::min(std::fabs(rate), mount.pan_rate_max)};
}

std::array<PanRequest, 2> ScanScheduler::step(std::uint16_t phase, double dig, double truck, double swing_angle, double swing_speed, const std::array<double, 2>& pan,
                                              bool slowed, const ComingSwing& coming) {
  std::array<PanRequest, 2> request;
  const std::size_t ahead = truck >= dig ? left : right;
  const double side = truck >= dig ? 1.0 : -1.0;
  if (slowed) begin_full_sweep();
  was_slowed_ = was_slowed_ || slowed;
  const bool back_soon = was_slowed_ && !slowed && (phase == BERM_PHASE_DUMP || phase == BERM_PHASE_SWING_TO_DIG);
  if (phase != BERM_PHASE_SWING_TO_TRUCK) far_seen_ = false;
  else if (side * (pan[ahead] + swing_angle - truck) > past_truck) far_seen_ = true;
  plan_lead(phase, dig, truck, swing_angle, swing_speed, coming);
  const std::size_t other = ahead == left ? right : left;
  if (phase == BERM_PHASE_SWING_TO_DIG) note_bed(ahead, truck, swing_angle, pan[ahead]);
  if (phase == BERM_PHASE_SWING_TO_TRUCK) note_face(other, dig, truck, swing_angle, pan[other]);
  if (slowed && look_ == Look::none && phase == BERM_PHASE_SWING_TO_DIG && phase_ != phase) head_[other].up = other == left;  // beyond the dig first
  phase_ = phase;
  for (std::size_t i = 0; i < head_.size(); ++i) {
    const ScannerMount& mount = machine_.scanner[i];
    Head& head = head_[i];
    if (look_ != Look::none && i == looker_) {
      request[i] = look(swing_angle, swing_speed, pan[i]);
      continue;
    }
    if (!slowed) note_seen(i, pan[i], back_soon && i != ahead, side * (dig - pan[i] - swing_angle));
    const bool whole = !(head.low_seen && head.high_seen) && !(slowed && look_ != Look::none);  // a slow look goes on beside the way
    // On the swing back the ground beyond the dig comes first, on which only the looks of a dig fall: the swing does not wait until it comes in its turn.
    const bool end_first = whole && !slowed && i != ahead && (back_soon || phase == BERM_PHASE_SWING_TO_DIG) && !end_beyond_dig_seen(i);
    const PanSector beside = beside_look(i, dig, truck, swing_angle);
    if (i != looker_ && (i == right ? pan[i] > beside.high - at_end : pan[i] < beside.low + at_end)) feet_seen_ = true;
    const PanSector s = end_first ? end_beyond_dig(i) : whole ? PanSector{mount.pan_low, mount.pan_high} : look_ != Look::none ? beside : sector(i, phase, dig, truck, swing_angle);
    if (pan[i] > s.high - at_end) head.up = false;
    if (pan[i] < s.low + at_end) head.up = true;
    const double direction = head.up ? 1.0 : -1.0;
    const bool hurries = end_first && back_soon && (pan[i] < s.low || pan[i] > s.high);
    request[i] = {head.up ? s.high : s.low, hurries ? mount.pan_rate_max : LookaheadTable::pan_rate(mount, direction, swing_speed)};
  }
  const bool outward = head_[lead_.scanner].up == (lead_.scanner == left);
  lead_.ahead = lead_.scanner == left ? pan[left] : -pan[right];
  // Where slowness has both see their whole ranges none leads, and none is waited for.
  const bool leads = !(was_slowed_ && !(head_[lead_.scanner].low_seen && head_[lead_.scanner].high_seen));
  lead_.triggered = !leads || lead_.ahead > lead_.needed.trigger + (outward ? 0.0 : table_.turn_way());
  return request;
}

}  // namespace berm::app
