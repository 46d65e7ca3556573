#include "app/truck_look.hpp"

#include <algorithm>
#include <cmath>

#include "app/recognised_bed.hpp"
#include "planning/skyline.hpp"
#include "planning/truck_place.hpp"

namespace berm::app {

namespace {

constexpr std::size_t left_scanner = 0, right_scanner = 1;
constexpr double look_aside = radians(60.0);        // of the truck: beside the implements, and the pans reach beyond its far end
constexpr double place_half_length = 6.0, place_half_width = 1.6;  // m: a bed of 6 m that may be off, and a cab, either way round
constexpr double bed_half_length = 3.6;             // m: the bed alone
constexpr double beyond = radians(3.0);             // the sweep goes on so far
constexpr double moved = radians(0.3);              // of the swing: the sweep is worth nothing
constexpr double drain_s = 0.1;                     // until the last scanline has come through the kernel
constexpr int vain_until_operator = 3;
constexpr int restless = 3;                         // looks begun anew, for the swing moved
constexpr double vain_pause_s = 5.0;

double dig_middle(const SiteModel& site) { return 0.5 * (site.dig_swing_left + site.dig_swing_right); }

}  // namespace

TruckLook::TruckLook(const MachineModel& machine, const SiteModel& site, TruckFinder& finder) : machine_(machine), site_(site), finder_(finder) {
  const bool to_left = std::remainder(std::atan2(site.place.y, site.place.x) - dig_middle(site), 2.0 * std::numbers::pi) >= 0.0;
  scanner_ = to_left ? left_scanner : right_scanner;
  side_ = to_left ? 1.0 : -1.0;
}

double TruckLook::bearing() const {
  const double wanted = std::atan2(site_.place.y, site_.place.x) - side_ * look_aside;
  return std::clamp(wanted, machine_.joint[swing].low, machine_.joint[swing].high);
}

std::array<double, 3> TruckLook::viewpoint(double swing_angle) const {
  const ScannerMount& mount = machine_.scanner[scanner_];
  const double c = std::cos(swing_angle), s = std::sin(swing_angle);
  return {mount.x * c - mount.y * s, mount.x * s + mount.y * c, mount.z};
}

double TruckLook::head_bearing_of(double x, double y, double swing_angle) const {
  const std::array<double, 3> head = viewpoint(swing_angle);
  // Near the swing angle, so that no sector is torn apart where angles wrap.
  return swing_angle + std::remainder(std::atan2(y - head[1], x - head[0]) - swing_angle, 2.0 * std::numbers::pi);
}

PanSector TruckLook::bearings_of_place(double half_length, double swing_angle) const {
  const double c = std::cos(site_.place.yaw), s = std::sin(site_.place.yaw);
  PanSector bearings{1e9, -1e9};
  for (const double u : {-half_length, half_length})
    for (const double v : {-place_half_width, place_half_width}) {
      const double b = head_bearing_of(site_.place.x + u * c - v * s, site_.place.y + u * s + v * c, swing_angle);
      bearings.low = std::min(bearings.low, b - beyond);
      bearings.high = std::max(bearings.high, b + beyond);
    }
  return bearings;
}

// How much farther towards the truck than that angle the machine has to stand for its scanner to see the place's far end.
double TruckLook::needed_for(double half_length, double swing_angle) const {
  const PanSector bearings = bearings_of_place(half_length, swing_angle);
  const ScannerMount& mount = machine_.scanner[scanner_];
  return side_ > 0.0 ? bearings.high - swing_angle - mount.pan_high : swing_angle + mount.pan_low - bearings.low;
}

std::optional<double> TruckLook::bearing_on_the_way(double swing_angle, double reach) const {
  constexpr double step = radians(1.0), clear = 0.5;  // m, beside the bucket
  const auto over_dig_zone = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle), across = side_ * (0.5 * bucket_width(machine_) + clear);
    return in_dig_zone(site_, reach * c - across * s, reach * s + across * c) && angle >= machine_.joint[swing].low && angle <= machine_.joint[swing].high;
  };
  double best = swing_angle;
  while (needed_for(place_half_length, best) > 0.0 && over_dig_zone(best + side_ * step)) best += side_ * step;
  if (!over_dig_zone(best) || needed_for(bed_half_length, best) > 0.0) return std::nullopt;
  return best;
}

bool TruckLook::way_is_free(const Observation& o, const ScanScheduler& scanners) const {
  constexpr double lags = radians(5.0);  // the swing's overshoot
  if (!on_the_way() || !(scanners.look_sweeps() || scanners.look_done())) return false;
  const ScannerMount& mount = machine_.scanner[scanner_];
  const double farthest = *dig_bearing_ + (side_ > 0.0 ? mount.pan_high - lags : mount.pan_low + lags);
  return side_ * (o.pan[scanner_] + o.angle[swing] - farthest) <= 0.0;
}

void TruckLook::begin_on_the_way(const Observation& o, ScanScheduler& scanners, double from, double dig_bearing) {
  dig_bearing_ = dig_bearing;
  const PanSector here = bearings_of_place(place_half_length, from), there = bearings_of_place(place_half_length, dig_bearing);
  scanners.begin_look_on_the_way(scanner_, side_ > 0.0 ? PanSector{std::min(here.low, there.low), here.high} : PanSector{here.low, std::max(here.high, there.high)});
  begin_sweep(o);
}

void TruckLook::begin(const Observation& o, ScanScheduler& scanners) {
  dig_bearing_.reset();
  scanners.begin_look(scanner_, bearings_of_place(place_half_length, o.angle[swing]));
  begin_sweep(o);
}

void TruckLook::begin_sweep(const Observation& o) {
  sweep_.end();
  bed_.reset();
  swing_ = o.angle[swing];
  stage_ = Stage::sweeps;
  stage_s_ = o.time_s;
}

void TruckLook::end_sweep(ScanScheduler& scanners) {
  scanners.end_look();
  sweep_.end();
}

void TruckLook::stop(ScanScheduler& scanners) {
  end_sweep(scanners);
  restarts_ = 0;
  stage_ = Stage::idle;
}

void TruckLook::another_truck() {
  vain_ = 0;
  told_operator_.clear();
}

Awaited TruckLook::awaits(const Observation& o, const ScanScheduler& scanners) const {
  const auto pan_of = [](std::size_t scanner) { return scanner == left_scanner ? Awaited::left_pan : Awaited::right_pan; };
  switch (stage_) {
    case Stage::idle:
    case Stage::pauses: return Awaited::nothing;
    case Stage::sweeps: return restarts_ >= restless ? Awaited::standstill : pan_of(scanner_);
    case Stage::drains:
    case Stage::asked: return Awaited::recogniser;
    case Stage::passes:
      if (sweep_.recording() && !scanners.look_done() && !passed(*bed_, o)) return pan_of(scanner_);
      return pan_of(scanner_ == left_scanner ? right_scanner : left_scanner);
  }
  return Awaited::nothing;
}

void TruckLook::feed(const Observation& o) {
  const std::size_t whole = sweep_.whole();
  visit_scanlines(std::span(sweep_.points()).subspan(told_, whole - told_), [&](std::span<const ScanPoint> scanline) {
    finder_.take({scanline.begin(), scanline.end()}, dig_bearing_ ? sweep_.swing_of(scanline.front()) - swing_ : 0.0, o.cycle);
  });
  told_ = whole;
}

bool TruckLook::passed(const TruckBed& bed, const Observation& o) const {
  const double sense = o.pan[scanner_] + o.angle[swing] >= bearing_began_ ? 1.0 : -1.0, c = std::cos(bed.yaw), s = std::sin(bed.yaw);
  for (const double u : {-0.5 * bed.length, 0.5 * bed.length})
    for (const double v : {-0.5 * bed.width, 0.5 * bed.width}) {
      const double pan = head_bearing_of(bed.centre_x + u * c - v * s, bed.centre_y + u * s + v * c, o.angle[swing]) - o.angle[swing];
      if (sense * (o.pan[scanner_] - pan) < beyond) return false;
    }
  return true;
}

void TruckLook::take_answer(const Observation& o, ScanScheduler& scanners, int truck, const ProgressLog& log) {
  const auto answer = finder_.answer(o.cycle);
  if (!answer) return;
  restarts_ = 0;
  bed_ = judge(*answer, o, truck, log);
  stage_s_ = o.time_s;
  stage_ = bed_ ? Stage::passes : Stage::pauses;
  if (!bed_) end_sweep(scanners);
}

std::optional<TruckBed> TruckLook::step(const Observation& o, ScanScheduler& scanners, int truck, const ProgressLog& log) {
  const bool looks = stage_ == Stage::sweeps || stage_ == Stage::drains || stage_ == Stage::passes;
  if (looks && !dig_bearing_ && std::fabs(o.angle[swing] - swing_) > moved) {
    ++restarts_;
    begin(o, scanners);
  }
  switch (stage_) {
    case Stage::idle: break;
    case Stage::sweeps:
      if (scanners.look_sweeps() && !sweep_.recording()) {
        sweep_.begin(scanner_);
        told_ = 0;
        bearing_began_ = o.pan[scanner_] + o.angle[swing];
        swing_ = o.angle[swing];
        finder_.begin(viewpoint(swing_));
      }
      if (scanners.look_done()) {
        stage_ = Stage::drains;
        stage_s_ = o.time_s;
      }
      if (!sweep_.recording()) break;
      feed(o);
      take_answer(o, scanners, truck, log);
      break;
    case Stage::drains:
      if (o.time_s - stage_s_ >= drain_s) {
        end_sweep(scanners);
        stage_ = Stage::asked;
      }
      feed(o);
      if (stage_ == Stage::asked) finder_.end(o.cycle);
      take_answer(o, scanners, truck, log);
      break;
    case Stage::asked: take_answer(o, scanners, truck, log); break;
    case Stage::passes:
      if (sweep_.recording() && !scanners.look_done() && !passed(*bed_, o)) break;
      if (!scanners.feet_seen()) break;  // what is dug next hides them
      stop(scanners);
      return bed_;
    case Stage::pauses:
      if (dig_bearing_) break;  // missed
      if (vain_ < vain_until_operator || o.time_s - stage_s_ >= vain_pause_s) begin(o, scanners);
      break;
  }
  return std::nullopt;
}

// After a few looks in vain at a truck the operator is told, once of each thing that is wrong with it.
void TruckLook::tell_none(const std::string& event, nlohmann::ordered_json fields, const std::string& advice, const Observation& o, const ProgressLog& log) {
  log.event(event, std::move(fields));
  if (++vain_ < vain_until_operator || std::find(told_operator_.begin(), told_operator_.end(), event) != told_operator_.end()) return;
  told_operator_.push_back(event);
  log.event("operator_needed", {{"time_s", o.time_s}, {"reason", event}, {"advice", advice}});
}

std::optional<TruckBed> TruckLook::judge(const RecognisedTruck& truck, const Observation& o, int number, const ProgressLog& log) {
  if (!truck.found) {
    tell_none("no_truck", {{"time_s", o.time_s}, {"truck", number}, {"reason", truck.reason}},
              "look whether a truck stands where trucks park, with its bed open, and nothing before it; the scanners look again every few seconds", o, log);
    return std::nullopt;
  }
  TruckBed bed = recognised_bed(truck);
  limit_to_zones(bed, site_.truck_zones);
  const nlohmann::ordered_json fields{{"time_s", o.time_s}, {"truck", number}, {"class", truck.truck_class}, {"x_m", bed.centre_x}, {"y_m", bed.centre_y},
                                      {"yaw_deg", degrees(bed.yaw)}, {"length_m", bed.length}, {"width_m", bed.width}, {"height_m", bed.height}, {"height_sd_m", truck.height_deviation},
                                      {"wall_top_m", bed.top_at(0.0, 0.0)}, {"wall_top_highest_m", bed.wall_top}, {"pitch_deg", degrees(truck.pose.pitch)}, {"roll_deg", degrees(truck.pose.roll)}, {"end_deviation_m", bed.end_deviation}, {"several_echoes", sweep_.several_echoes()},
                                      {"before_sweep_end", sweep_.recording()}};
  if (!stands_in_zone(bed, site_.truck_zones)) {
    tell_none("truck_misplaced", fields, "the truck stands where the site has no truck zone: nothing may pass over it there; have it park anew", o, log);
    return std::nullopt;
  }
  another_truck();  // whatever comes after it
  log.event("recognised", fields);
  return bed;
}

}  // namespace berm::app
