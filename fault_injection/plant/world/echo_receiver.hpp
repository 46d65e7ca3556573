// What the scanner's electronics make of a return: pulses over a threshold, and the range of the last one, by its leading or its trailing edge
// (stentz-1999, section 3, Figures 6 and 7). What it knows of a pulse's shape it measured on a hard target, square on and in clear air.
#pragma once

#include <array>
#include <vector>

#include "plant/process/world_config.hpp"
#include "plant/world/return_waveform.hpp"
#include "scan/scan_packet.h"

namespace berm::plant {

// A stretch of a return over the threshold.
struct ReceivedPulse {
  std::size_t begin = 0, end = 0;    // samples: the first over the threshold, the first below the release level
  std::size_t floor = 0;             // no edge of it lies before this sample
  double leading = 0.0, trailing = 0.0;  // m: where it crosses these levels, as received, without any correction
};

// Nearest first; the last is the range. None: nothing came back, or too little.
struct Echoes {
  std::array<double, BERM_SCAN_ECHOES> range{};
  int count = 0;
  bool dust = false;  // several pulses, or a last one that is longer than a hard target's
};

class EchoReceiver {
 public:
  static constexpr double threshold = 6.0;  // standard deviations of the noise: passed about once in 10^9 samples by noise alone
  static constexpr double release = 3.0;    // a pulse ends here, so that noise does not end it and begin it again

  // gate_m: what rises before it is the exit window's and no echo.
  EchoReceiver(const PulseLidar& lidar, Ranging ranging, double gate_m);
  [[nodiscard]] Echoes receive(const ReturnWaveform& wave) const;
  [[nodiscard]] std::vector<ReceivedPulse> pulses(const ReturnWaveform& wave) const;
  [[nodiscard]] double gate_m() const { return gate_m_; }

 private:
  // The half-height crossings about a peak, m. At the ceiling the height is not known, but the width there tells it.
  struct Edges { double rise = 0.0, fall = 0.0, top = 0.0; };
  // Of a hard target: where its range lies behind the rising and before the falling edge, and the pulse's length; by the height, or by the width.
  struct Reference { double key, to_rise, to_fall, length; };

  [[nodiscard]] std::size_t armed(const ReturnWaveform& wave) const;
  [[nodiscard]] static Edges edges(const ReturnWaveform& wave, const ReceivedPulse& pulse, std::size_t peak);
  [[nodiscard]] static std::size_t first_peak(const ReturnWaveform& wave, const ReceivedPulse& pulse);
  [[nodiscard]] static std::size_t last_peak(const ReturnWaveform& wave, const ReceivedPulse& pulse);
  [[nodiscard]] Reference reference(const Edges& e) const;
  void calibrate();

  PulseLidar lidar_;
  Ranging ranging_;
  double gate_m_;
  std::vector<Reference> by_height_, by_width_;  // keys ascending: logarithm of the height; width, m
};

}  // namespace berm::plant
