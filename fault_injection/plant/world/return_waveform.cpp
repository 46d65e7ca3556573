#include "plant/world/return_waveform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant/world/random.hpp"

namespace berm::plant {
namespace {

constexpr double metres_per_ns = 0.299792458 / 2;  // there and back
constexpr double fwhm_per_spread = 2.354820045;    // of a Gaussian
constexpr double before_m = 1.5, after_m = 3.5;    // the strongest echo has risen from, and fallen below, the noise within these
constexpr double pulse_reach = 6.0;                // standard deviations: below 2e-8 of the peak beyond

// A stream for each pulse's noise, so that its length does not change what later pulses draw.
using PulseNoise = Draws<SplitMix>;

}  // namespace

ReturnWaveform::ReturnWaveform(const PulseLidar& lidar)
    : lidar_(lidar), begin_(-before_m), step_(lidar.sample_ns * metres_per_ns), spread_(lidar.pulse_fwhm_ns * metres_per_ns / fwhm_per_spread),
      pole_(std::exp(-lidar.sample_ns * 2e-3 * std::numbers::pi * lidar.bandwidth_mhz)) {
  const int half = static_cast<int>(std::ceil(pulse_reach * spread_ / step_));
  for (int k = -half; k <= half; ++k) kernel_.push_back(std::exp(-0.5 * std::pow(k * step_ / spread_, 2)));
}

std::size_t ReturnWaveform::index(double range) const { return static_cast<std::size_t>(std::max(0.0, std::ceil((range - begin_) / step_))); }

double ReturnWaveform::target_peak(const HardTarget& t) const {
  return lidar_.strength * t.reflectivity * t.cos_incidence / (t.range * t.range + lidar_.near_m * lidar_.near_m);
}

void ReturnWaveform::add_pulse(double range, double peak, double spread) {
  const double reach = pulse_reach * spread;
  const std::size_t end = std::min(level_.size(), index(range + reach));
  for (std::size_t i = index(range - reach); i < end; ++i) level_[i] += peak * std::exp(-0.5 * std::pow((begin_ + step_ * static_cast<double>(i) - range) / spread, 2));
}

double ReturnWaveform::add_clouds(const PulsePath& path, double window, double until) {
  slice_.assign(level_.size(), 0.0);
  double depth = 0.0;  // optical, one way
  bool any = false;
  const double near2 = lidar_.near_m * lidar_.near_m;
  for (std::size_t i = 0; i < slice_.size(); ++i) {  // a slice is as thick as a sample, round its range
    const double at = begin_ + step_ * static_cast<double>(i), low = at - step_ / 2, high = std::min(at + step_ / 2, until);
    double more = 0.0;
    for (const CloudSpan& c : path.clouds) more += c.extinction * std::max(0.0, std::min(c.to, high) - std::max(c.from, low));
    if (more <= 0.0) continue;
    any = true;
    // Of what enters the slice, by Beer and Lambert there and back; compared with a white diffuse face, which sends 1/pi a steradian.
    const double lost = (std::exp(-2.0 * depth) - std::exp(-2.0 * (depth + more))) / 2.0;
    slice_[i] = window * lidar_.strength * std::numbers::pi * lost / lidar_.dust_ratio_sr / (at * at + near2);
    depth += more;
  }
  if (!any) return 1.0;
  const std::size_t half = kernel_.size() / 2;
  for (std::size_t i = 0; i < slice_.size(); ++i) {
    if (slice_[i] == 0.0) continue;
    const std::size_t first = i < half ? 0 : i - half, last = std::min(level_.size() - 1, i + half);
    for (std::size_t k = first; k <= last; ++k) level_[k] += slice_[i] * kernel_[k + half - i];
  }
  return std::exp(-2.0 * depth);
}

void ReturnWaveform::receive(std::optional<std::uint64_t> noise_seed) {
  std::optional<PulseNoise> noise;
  if (noise_seed) noise.emplace(*noise_seed);
  const double fresh = std::sqrt(1.0 - pole_ * pole_);  // white noise through the same pole, standard deviation 1 behind it
  double signal = 0.0, hum = noise ? noise->normal() : 0.0;
  for (double& v : level_) {
    signal = pole_ * signal + (1.0 - pole_) * v;
    v = std::min(lidar_.ceiling, signal + hum);
    if (noise) hum = pole_ * hum + fresh * noise->normal();
  }
}

void ReturnWaveform::sample(const PulsePath& path, std::optional<std::uint64_t> noise_seed) {
  double last = lidar_.window_m;
  for (const CloudSpan& c : path.clouds) last = std::max(last, c.to);
  if (path.target) last = path.target->range;  // nothing comes back from behind it
  level_.assign(index(last + after_m) + 1, 0.0);
  const double through = path.window_percent / 100.0, window = through * through;
  add_pulse(lidar_.window_m, through * lidar_.window_clean + (1.0 - through) * lidar_.window_opaque, spread_);
  const double air = add_clouds(path, window, path.target ? path.target->range : last);
  if (path.target) {
    const HardTarget& t = *path.target;
    // The spot on an oblique face is as deep as it is wide, by the tangent; its light is Gaussian, four standard deviations wide to 1/e^2.
    const double spot = lidar_.aperture_m + lidar_.divergence_rad * t.range;
    const double deep = spot / 4.0 * std::sqrt(std::max(0.0, 1.0 - t.cos_incidence * t.cos_incidence)) / t.cos_incidence;
    const double spread = std::hypot(spread_, deep);
    add_pulse(t.range, window * air * target_peak(t) * spread_ / spread, spread);
  }
  receive(noise_seed);
}

}  // namespace berm::plant
