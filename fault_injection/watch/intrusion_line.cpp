#include "watch/intrusion_line.hpp"

#include <nlohmann/json.hpp>

namespace nlohmann {

template <typename T>
struct adl_serializer<std::optional<T>> {
  static void to_json(json& to, const std::optional<T>& value) { to = value ? json(*value) : json(nullptr); }
  static void from_json(const json& from, std::optional<T>& value) { value = from.is_null() ? std::nullopt : std::optional(from.get<T>()); }
};

}  // namespace nlohmann

namespace berm::watch {

// Where it stood, and the footprint at the detection, are of the run alone; the intrusion is drawn anew.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Alarm, time_s, x, y, height, nearest)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(IntruderRecord, name, entered_s, detected_s, standstill_s, stopped_s, detected_by, stopped_by,
                                   distance_at_detection_m, distance_at_standstill_m, inside_s, stood_at_entry, inside)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(IntrusionResult, outcome, record, alarms, false_alarms, appeared_s, seen_s, contact_s, unsafe_s,
                                   truck_distance_m, closest_m, ended_s)

std::string line_of(const IntrusionResult& result) {
  nlohmann::json line = result;
  line["run"] = result.intrusion.run;
  return line.dump();
}

IntrusionResult result_of(const std::string& line, const std::function<Intrusion(int run)>& drawn) {
  const auto from = nlohmann::json::parse(line);
  auto result = from.get<IntrusionResult>();
  result.intrusion = drawn(from.at("run").get<int>());
  return result;
}

}  // namespace berm::watch
