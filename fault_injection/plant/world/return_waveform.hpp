// What comes back of one laser pulse, as the scanner's digitiser sees it: the exit window, dust, the target, noise, and the digitiser's ceiling.
// Level 1 is the standard deviation of the receiver's noise. Time is told as the range that it stands for (light goes 0.15 m there and back in 1 ns).
// Units, sources and what is left out: fault_injection/echoes/ECHOES.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace berm::plant {

// A pulsed near-infrared scanner. Values are typical of such devices unless called chosen.
struct PulseLidar {
  double pulse_fwhm_ns = 3.0;     // a pulsed laser diode's: 3 to 6
  double bandwidth_mhz = 200.0;   // of receiver and amplifier, one pole: the pulse falls more slowly than it rises
  double sample_ns = 0.5;         // 2 GS/s: five samples within a standard deviation of the pulse
  // Peak level of a white, diffuse, square-on target at 1 m by R^-2 alone: 10 % at 60 m (the scanners' range) then is 12 times the noise (chosen).
  double strength = 12.0 * 60.0 * 60.0 / 0.1;
  double near_m = 1.0;            // nearer than about this the receiver sees a part of the beam alone: R^-2 becomes 1 / (R^2 + near^2) (chosen)
  double ceiling = 4095.0;        // 12 bits whose lowest is the noise
  double divergence_rad = 0.003, aperture_m = 0.01;  // full angle and width of the beam, to 1/e^2: a spot of 4 cm at 10 m
  double dust_ratio_sr = 45.0;    // extinction over backscatter: mineral dust, 40 to 60
  double window_m = 0.05;         // from the head's centre to the exit window (chosen)
  // The receiver has an aperture of its own beside the laser's: of the window it sees stray light alone. Peak level of a clean one, and of one that
  // lets nothing through: just below the ceiling (chosen, both).
  double window_clean = 20.0, window_opaque = 4000.0;
};

// What the beam passes within a cloud of dust; extinction of one way, 1/m.
struct CloudSpan { double from = 0.0, to = 0.0, extinction = 0.0; };
struct HardTarget { double range = 0.0, reflectivity = 0.0, cos_incidence = 1.0; };
struct PulsePath {
  double window_percent = 100.0;  // transmission, one way
  std::vector<CloudSpan> clouds;
  std::optional<HardTarget> target;
};

class ReturnWaveform {
 public:
  explicit ReturnWaveform(const PulseLidar& lidar = {});
  // noise_seed: of this pulse's noise; without noise when absent. Sampled from before the window to where the last thing has died away.
  void sample(const PulsePath& path, std::optional<std::uint64_t> noise_seed);

  [[nodiscard]] const PulseLidar& lidar() const { return lidar_; }
  [[nodiscard]] const std::vector<double>& level() const { return level_; }
  [[nodiscard]] double step_m() const { return step_; }
  [[nodiscard]] double range(double index) const { return begin_ + step_ * index; }
  // The first sample at or beyond a range.
  [[nodiscard]] std::size_t index(double range) const;
  // Peak of the echo of a target, before the receiver's pole and the ceiling, in clear air behind a clean window.
  [[nodiscard]] double target_peak(const HardTarget& target) const;

 private:
  void add_pulse(double range, double peak, double spread);
  // Adds the clouds' echoes up to a range; the share of light that comes back from there through them.
  double add_clouds(const PulsePath& path, double window, double until);
  void receive(std::optional<std::uint64_t> noise_seed);

  PulseLidar lidar_;
  double begin_, step_, spread_;       // m: of the first sample, between two, standard deviation of the pulse
  double pole_;                        // what is left of a level a sample later
  std::vector<double> kernel_;         // the pulse at whole samples, middle in the middle
  std::vector<double> slice_, level_;
};

}  // namespace berm::plant
