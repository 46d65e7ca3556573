// What the app says of the trucks that it recognised, and how far that is from the ground truth.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "run/svg.hpp"

namespace berm::run {

// Outline of the last bed that the app recognised; empty when there was none.
std::vector<Point2> recognised_bed(const std::vector<nlohmann::json>& app_events);

// Of each truck that was recognised, its first time: the worst corner's distance from that of the plant's truck, m, in space. truth: truth.json.
std::vector<double> recognition_errors(const std::vector<nlohmann::json>& app_events, const nlohmann::json& truth);

}  // namespace berm::run
