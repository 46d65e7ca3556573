// What each receiver returned of the truck's rear, over a sweep of extinctions: shares and range errors.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "echoes/echo_stage.hpp"

namespace berm::echoes {

constexpr double met_m = 0.15;    // a return this near to what the beam met is its
constexpr double front_m = 0.5;   // and one this near to where the beam enters the cloud, and not to the rear, the cloud's front

struct EchoRow {
  Place place = Place::about;
  double extinction = 0.0;        // 1/m
  plant::Ranging ranging = plant::Ranging::last_pulse;
  int samples = 0;                // that meet the rear
  double met = 0.0, front = 0.0, elsewhere = 0.0, none = 0.0;   // shares; together 1
  double flagged = 0.0;           // share with a sign of dust
  double wrong_unflagged = 0.0;   // share that is returned, but not from where the rear is, without a sign of dust
  double median_error_m = 0.0, p95_error_m = 0.0;  // of what is returned: found less true; largest of 95 % by size
  double farthest_m = 0.0;        // largest error beyond the rear: what would pass for free way; negative when all is nearer
};

EchoRow row_of(const std::vector<EchoSample>& samples, Place place, double extinction, plant::Ranging ranging);
// Clear air first, then each extinction about the truck and before it, with both receivers.
std::vector<EchoRow> sweep(const Stage& stage, const std::vector<double>& extinctions, int scanlines);
std::string name_of(plant::Ranging ranging);
std::string name_of(Place place);
std::string text_of(const std::vector<EchoRow>& rows);
nlohmann::json json_of(const std::vector<EchoRow>& rows, const StageOptions& options, int scanlines);

}  // namespace berm::echoes
