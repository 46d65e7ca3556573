// JSON as the text of a result file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace berm::config {

// A name that is no UTF-8 loses those bytes that are none, not the whole result.
template <class Json>
std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace berm::config
