#include "watch/intrusion_line.hpp"

#include <nlohmann/json.hpp>

namespace berm::watch {

namespace {

using nlohmann::json;

// One list of fields for both ways. Where it stood, and the footprint at the detection, are of the run alone.
struct Put {
  json& to;
  template <typename T>
  void operator()(const char* key, const T& value) { to[key] = value; }
  void operator()(const char* key, const std::optional<double>& value) { to[key] = value ? json(*value) : json(nullptr); }
};
struct Get {
  const json& from;
  template <typename T>
  void operator()(const char* key, T& value) { from.at(key).get_to(value); }
  void operator()(const char* key, std::optional<double>& value) {
    const json& v = from.at(key);
    value = v.is_null() ? std::nullopt : std::optional(v.get<double>());
  }
};

template <typename Field, typename Record>
void fields_of(Field field, Record& r) {
  field("name", r.name);
  field("entered_s", r.entered_s);
  field("detected_s", r.detected_s);
  field("standstill_s", r.standstill_s);
  field("stopped_s", r.stopped_s);
  field("detected_by", r.detected_by);
  field("stopped_by", r.stopped_by);
  field("distance_at_detection_m", r.distance_at_detection_m);
  field("distance_at_standstill_m", r.distance_at_standstill_m);
  field("inside_s", r.inside_s);
  field("stood_at_entry", r.stood_at_entry);
  field("inside", r.inside);
}

template <typename Field, typename Result>
void other_fields_of(Field field, Result& r) {
  field("outcome", r.outcome);
  field("false_alarms", r.false_alarms);
  field("appeared_s", r.appeared_s);
  field("seen_s", r.seen_s);
  field("contact_s", r.contact_s);
  field("unsafe_s", r.unsafe_s);
  field("truck_distance_m", r.truck_distance_m);
  field("closest_m", r.closest_m);
  field("ended_s", r.ended_s);
}

}  // namespace

std::string line_of(const IntrusionResult& result) {
  json line, record, alarms = json::array();
  other_fields_of(Put{line}, result);
  fields_of(Put{record}, result.record);
  for (const Alarm& a : result.alarms) alarms.push_back({a.time_s, a.x, a.y, a.height, a.nearest});
  line["run"] = result.intrusion.run;
  line["record"] = record;
  line["alarms"] = alarms;
  return line.dump();
}

IntrusionResult result_of(const std::string& line, const std::function<Intrusion(int run)>& drawn) {
  const json from = json::parse(line);
  IntrusionResult result;
  result.intrusion = drawn(from.at("run").get<int>());
  other_fields_of(Get{from}, result);
  fields_of(Get{from.at("record")}, result.record);
  for (const json& a : from.at("alarms"))
    result.alarms.push_back({a[0].get<double>(), a[1].get<double>(), a[2].get<double>(), a[3].get<double>(), a[4].get<std::string>()});
  return result;
}

}  // namespace berm::watch
