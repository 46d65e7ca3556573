// A percentile as reports have it.
#pragma once

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "run/percentile.hpp"

namespace berm::run {

// Null without values.
template <typename Json = nlohmann::ordered_json>
Json percentile_or_null(std::vector<double> values, double share) {
  return values.empty() ? Json(nullptr) : Json(percentile_of(std::move(values), share));
}

}  // namespace berm::run
