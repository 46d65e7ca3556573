// The report of a shift: all of a load's keys, and what only a shift has.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "run/run_result.hpp"
#include "soak/drawn_shift.hpp"

namespace berm::soak {

// Of kernel and app together, KiB an hour; twelve megabytes a day, and several times what shifts of an hour and more have shown (SOAK.md).
constexpr double kMemoryGrowthMost = 500.0;

// Of the run of a shift that was drawn, to last so many hours, in which the memory may grow so fast. Keys: SOAK.md.
nlohmann::json shift_json(const run::RunResult& result, double hours, const DrawnShift& drawn, double memory_growth_most = kMemoryGrowthMost);
std::string shift_text(const nlohmann::json& report);
// Why the shift was none, or not a safe one: contacts, an end before its time, hardly a truck loaded, memory that grows.
std::vector<std::string> shortcomings(const nlohmann::json& report);

}  // namespace berm::soak
