#include "plant/world/echo_receiver.hpp"

#include <algorithm>
#include <cmath>

namespace berm::plant {
namespace {

// A level that has come down from a peak, or up from a valley, by this much has left it, and is not noise on it.
double step_over_noise(double level) { return 4.0 + 0.1 * level; }

// A hard target's pulse is longer on an oblique face, by up to a quarter, and by the noise about its ends.
constexpr double longer_share = 1.25, longer_m = 0.3;

// Where the line between two samples has this level.
double crossing(const ReturnWaveform& wave, std::size_t a, std::size_t b, double level) {
  const double la = wave.level()[a], lb = wave.level()[b];
  const double share = la == lb ? 0.5 : std::clamp((level - la) / (lb - la), 0.0, 1.0);
  return wave.range(static_cast<double>(a) + share * (static_cast<double>(b) - static_cast<double>(a)));
}

}  // namespace

EchoReceiver::EchoReceiver(const PulseLidar& lidar, Ranging ranging, double gate_m) : lidar_(lidar), ranging_(ranging), gate_m_(gate_m) { calibrate(); }

// The sample from which on a pulse may begin: that of the gate, or, where the window's echo has not died away by then, the valley behind it.
std::size_t EchoReceiver::armed(const ReturnWaveform& wave) const {
  const std::vector<double>& v = wave.level();
  const std::size_t gate = std::min(wave.index(gate_m_), v.size());
  std::size_t valley = gate;
  for (std::size_t i = gate; i < v.size(); ++i) {
    if (v[i] < release) return i;
    if (v[i] < v[valley]) valley = i;
    if (v[i] > v[valley] + step_over_noise(v[valley])) return valley;
  }
  return v.size();
}

std::vector<ReceivedPulse> EchoReceiver::pulses(const ReturnWaveform& wave) const {
  const std::vector<double>& v = wave.level();
  std::vector<ReceivedPulse> out;
  std::size_t floor = armed(wave);
  for (std::size_t i = floor; i < v.size(); ++i) {
    if (v[i] <= threshold) continue;
    ReceivedPulse p;
    p.floor = floor;
    p.begin = i;
    p.leading = i > floor ? crossing(wave, i - 1, i, threshold) : wave.range(static_cast<double>(i));
    while (i < v.size() && v[i] >= release) ++i;
    p.end = i;
    p.trailing = i < v.size() ? crossing(wave, i - 1, i, release) : wave.range(static_cast<double>(i - 1));
    floor = i;
    out.push_back(p);
  }
  return out;
}

std::size_t EchoReceiver::first_peak(const ReturnWaveform& wave, const ReceivedPulse& pulse) {
  const std::vector<double>& v = wave.level();
  std::size_t peak = pulse.begin;
  for (std::size_t i = pulse.begin; i < pulse.end && v[i] >= v[peak] - step_over_noise(v[peak]); ++i)
    if (v[i] > v[peak]) peak = i;
  return peak;
}

std::size_t EchoReceiver::last_peak(const ReturnWaveform& wave, const ReceivedPulse& pulse) {
  const std::vector<double>& v = wave.level();
  std::size_t peak = pulse.end - 1;
  for (std::size_t i = pulse.end; i-- > pulse.begin && v[i] >= v[peak] - step_over_noise(v[peak]);)
    if (v[i] > v[peak]) peak = i;
  return peak;
}

EchoReceiver::Edges EchoReceiver::edges(const ReturnWaveform& wave, const ReceivedPulse& pulse, std::size_t peak) {
  const std::vector<double>& v = wave.level();
  Edges e;
  e.top = v[peak];
  const double half = e.top / 2.0;
  std::size_t i = peak;
  while (i > pulse.floor && v[i] > half) --i;
  e.rise = v[i] > half ? wave.range(static_cast<double>(i)) : crossing(wave, i, i + 1, half);
  for (i = peak; i + 1 < v.size() && v[i] > half;) ++i;
  e.fall = v[i] > half ? wave.range(static_cast<double>(i)) : crossing(wave, i - 1, i, half);
  return e;
}

EchoReceiver::Reference EchoReceiver::reference(const Edges& e) const {
  const bool full = e.top >= lidar_.ceiling;
  const std::vector<Reference>& table = full ? by_width_ : by_height_;
  const double key = full ? e.fall - e.rise : std::log(e.top);
  const auto above = std::lower_bound(table.begin(), table.end(), key, [](const Reference& r, double k) { return r.key < k; });
  if (above == table.begin()) return table.front();
  if (above == table.end()) return table.back();
  const Reference &a = *(above - 1), &b = *above;
  const double f = (key - a.key) / (b.key - a.key);
  const auto mix = [f](double x, double y) { return x + f * (y - x); };
  return {key, mix(a.to_rise, b.to_rise), mix(a.to_fall, b.to_fall), mix(a.length, b.length)};
}

void EchoReceiver::calibrate() {
  constexpr double at_m = 20.0, weakest = 8.0, strongest = 1e6, ratio = 1.2;  // a target there, of every strength from 0.1 m to the end of sight
  constexpr int places = 4;                                                    // between two samples
  ReturnWaveform wave(lidar_);
  for (double peak = weakest; peak < strongest; peak *= ratio) {
    Reference mean{0.0, 0.0, 0.0, 0.0};
    int full = 0, seen = 0;
    for (int k = 0; k < places; ++k) {
      HardTarget target{at_m + wave.step_m() * k / places, 1.0, 1.0};
      target.reflectivity = peak / wave.target_peak(target);
      wave.sample({100.0, {}, target}, std::nullopt);
      const std::vector<ReceivedPulse> found = pulses(wave);
      if (found.empty()) continue;
      const Edges e = edges(wave, found.back(), first_peak(wave, found.back()));
      const bool at_ceiling = e.top >= lidar_.ceiling;
      full += at_ceiling ? 1 : 0;
      ++seen;
      mean.key += at_ceiling ? e.fall - e.rise : std::log(e.top);
      mean.to_rise += target.range - e.rise;
      mean.to_fall += e.fall - target.range;
      mean.length += found.back().trailing - found.back().leading;
    }
    if (seen < places || (full != 0 && full != places)) continue;  // too weak, or at the ceiling's edge
    for (double* v : {&mean.key, &mean.to_rise, &mean.to_fall, &mean.length}) *v /= places;
    (full == 0 ? by_height_ : by_width_).push_back(mean);
  }
}

Echoes EchoReceiver::receive(const ReturnWaveform& wave) const {
  Echoes out;
  const std::vector<ReceivedPulse> found = pulses(wave);
  if (found.empty()) return out;
  const auto leading = [&](const ReceivedPulse& p) {
    const Edges e = edges(wave, p, first_peak(wave, p));
    return e.rise + reference(e).to_rise;
  };
  const ReceivedPulse& last = found.back();
  const Edges e = edges(wave, last, last_peak(wave, last));
  const Reference hard = reference(e);
  const bool lengthy = last.trailing - last.leading > longer_share * hard.length + longer_m;
  out.dust = found.size() > 1 || lengthy;
  std::vector<double> ranges;
  for (std::size_t i = 0; i + 1 < found.size(); ++i) ranges.push_back(leading(found[i]));
  if (ranging_ == Ranging::last_pulse || lengthy) ranges.push_back(leading(last));
  if (ranging_ == Ranging::trailing_edge) ranges.push_back(e.fall - hard.to_fall);
  // The range is what comes last, whatever noise says of those before it.
  for (double& r : ranges) r = std::min(r, ranges.back());
  std::sort(ranges.begin(), ranges.end());
  const std::size_t most = out.range.size();
  for (std::size_t i = ranges.size() > most ? ranges.size() - most : 0; i < ranges.size(); ++i) out.range[static_cast<std::size_t>(out.count++)] = ranges[i];
  return out;
}

}  // namespace berm::plant
