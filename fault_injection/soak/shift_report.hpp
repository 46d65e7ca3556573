// The report of a shift: all of a load's keys, and what only a shift has.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "run/run_result.hpp"
#include "soak/drawn_shift.hpp"

namespace berm::soak {

// Of the run of a shift that was drawn, to last so many hours. Keys: SOAK.md.
nlohmann::json shift_json(const run::RunResult& result, double hours, const DrawnShift& drawn);
std::string shift_text(const nlohmann::json& report);
// Why the shift was none, or not a safe one: contacts, an end before its time, hardly a truck loaded.
std::vector<std::string> shortcomings(const nlohmann::json& report);

}  // namespace berm::soak
