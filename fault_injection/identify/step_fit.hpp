// Fits the app's own model of a joint (motion/joint_response.hpp) to its step responses, by least squares over the measured speeds: dead time, lags and
// gain are the direction's, rates those of each load and reach.
//
// Confidence: half of the 95 % interval, from the spread of whole records about the fit (what is wrong in one reading of a record is wrong in the next
// as well, so readings are not counted as so many witnesses). A lag of less than a millisecond is none, 0 with a confidence of 0.
#pragma once

#include <array>
#include <vector>

#include "identify/step_record.hpp"

namespace berm::identify {

struct Fitted { double value = 0.0, confidence = 0.0; };

struct StepFit {
  Fitted dead_time, lag, stop_lag;                        // s
  Fitted gain;
  std::array<std::vector<Fitted>, 2> speeding, slowing;   // rad/s2, [empty, loaded][reach]
  double residual = 0.0, worst_residual = 0.0;            // rad/s, root mean square: of all readings, of the worst record
  std::size_t records = 0, samples = 0;
};

// Records of one joint in one direction; speed_max: rad/s, of the machine file; rate: a first guess, rad/s2. Throws std::runtime_error when the records do
// not determine the model.
StepFit fit_steps(const std::vector<const StepRecord*>& records, std::size_t reaches, double speed_max, double rate);

// The model's speeds at the readings of a record.
std::vector<double> fitted_speeds(const StepFit& fit, const StepRecord& record, double speed_max);

}  // namespace berm::identify
