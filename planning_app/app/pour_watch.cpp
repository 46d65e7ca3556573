#include "app/pour_watch.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

double share_beside(const MachineModel& machine, const TruckBed& bed, const Joints& angle, double half_width) {
  constexpr int across = 6;
  constexpr double thick = 0.1;    // m: the stream's middle is so far short of the lip, towards the machine
  constexpr double wall = 0.05;    // m beyond the inside: what falls on a wall's inner edge slides in
  const double r = forward(machine, angle).tip.r - thick, c = std::cos(angle[swing]), s = std::sin(angle[swing]);
  int outside = 0;
  for (int i = 0; i < across; ++i) {
    const double aside = half_width * ((2.0 * i + 1.0) / across - 1.0);
    const BedPoint p = to_bed(bed, r * c - aside * s, r * s + aside * c);
    if (std::fabs(p.u) > 0.5 * bed.length + wall || std::fabs(p.v) > 0.5 * bed.width + wall) ++outside;
  }
  return static_cast<double>(outside) / across;
}

void PourWatch::begin() { *this = PourWatch(full_kg_); }

bool PourWatch::carried_known() const {
  constexpr int least = 50;            // cycles
  constexpr double least_share = 0.02; // of a full bucket: pressures that show less show nothing
  return rested_ >= least && carried_kg() > least_share * full_kg_;
}

void PourWatch::step(const Bucket& now) {
  if (now.kg < 0.0) {
    if (now.rests) return;
    // Half a load may leave it before its weight is known again: by where the lip was meanwhile.
    unseen_ += count_ + 1;
    unseen_share_sum_ += share_sum_ + now.beside;
    count_ = 0;
    sum_ = share_sum_ = 0.0;
    return;
  }
  if (now.rests && !slid_) {
    ++rested_;
    rested_sum_ += now.kg;
  }
  sum_ += now.kg;
  share_sum_ += now.beside;
  if (++count_ < block) return;
  const double kg = sum_ / block, share = share_sum_ / block;
  count_ = 0;
  sum_ = share_sum_ = 0.0;
  if (!now.rests && carried_known()) {
    const double unseen_share = (unseen_share_sum_ + block * share) / (unseen_ + block);
    if (!paused_) weighed(kg, unseen_ > 0 ? unseen_share : 0.5 * (share + last_share_));
    slid_ = true;
  }
  // At rest the mean of all that was seen is quieter than a block's.
  last_kg_ = slid_ ? kg : carried_kg();
  last_share_ = share;
  paused_ = false;
  unseen_ = 0;
  unseen_share_sum_ = 0.0;
}

void PourWatch::weighed(double kg, double share) {
  double from = last_kg_;
  while (!left_.empty() && left_.back().to_kg < kg) {
    from = left_.back().from_kg;
    share = left_.back().share;
    left_.pop_back();
  }
  if (from > kg) left_.push_back({from, kg, share});
}

void PourWatch::pause(bool poured) {
  slid_ = slid_ || poured;
  count_ = 0;
  sum_ = share_sum_ = 0.0;
  paused_ = true;
}

double PourWatch::beside_kg() const {
  constexpr double least_share = 0.016, noise_share = 0.01, most_share = 0.3;  // of a full bucket: twice what the noise makes; the noise; what no pour loses
  double beside = 0.0;
  for (const Left& left : left_) beside += left.share * (left.from_kg - left.to_kg);
  return beside < least_share * full_kg_ ? 0.0 : std::min(beside, most_share * full_kg_) - noise_share * full_kg_;
}

}  // namespace berm::app
