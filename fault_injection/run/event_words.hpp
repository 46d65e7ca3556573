// What berm load prints of an event as it comes: a line, or nothing.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace berm::run {

// time_s: of the simulation, when the event was taken.
std::string app_event_words(const nlohmann::json& event, double time_s);
std::string plant_event_words(const nlohmann::json& event);

}  // namespace berm::run
