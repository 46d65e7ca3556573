#include "run/event_words.hpp"

#include <fmt/format.h>

#include "run/run_result.hpp"

namespace berm::run {

namespace {

constexpr double kSlowedWorthTelling_s = 1.0;

std::string words_of(const nlohmann::json& event) {
  const std::string name = event.value("event", "");
  if (name == "pass")
    return fmt::format("truck {} pass {:2}: {:.2f} t in {:.1f} s", event.value("truck", 1), event.value("pass", 0), event.value("payload_kg", 0.0) / 1000, event.value("seconds", 0.0));
  if (name == "recognised")
    return fmt::format("truck {} recognised: {}, {:.2f} x {:.2f} m, walls {:.2f} m high, at ({:.2f}, {:.2f}), {:.1f} deg", event.value("truck", 1), event.value("class", "?"),
                       event.value("length_m", 0.0), event.value("width_m", 0.0), event.value("height_m", 0.0), event.value("x_m", 0.0), event.value("y_m", 0.0),
                       event.value("yaw_deg", 0.0));
  if (name == "no_truck") return fmt::format("no truck recognised: {}", event.value("reason", "?"));
  if (name == "truck_full") return fmt::format("truck {} is full", event.value("truck", 1));
  if (name == "stopped" && event.value("reason", "") == "none") return "the machine stands by: run is switched off";
  if (name == "stopped") return fmt::format("the kernel stopped the machine: {}", event.value("reason", "?"));
  if (name == "full_speed" && event.value("slowed_s", 0.0) >= kSlowedWorthTelling_s)
    return fmt::format("was slowed by the kernel for {:.1f} s, to {:.0f} %{}", event.value("slowed_s", 0.0), 100 * event.value("least_share", 1.0),
                       event.value("dust", false) ? " (dust)" : event.value("learning", false) ? " (the ground was being learned)" : "");
  if (name == "held") return "the app holds back: " + held_by(event);
  if (name == "operator_needed") return fmt::format("operator needed, {}: {}", operator_needed_for(event), event.value("advice", ""));
  if (name == "move_back") return fmt::format("the app asks for a bench move, {:.1f} m back: {}", event.value("distance_m", 0.0), event.value("why", ""));
  if (name == "moved") return "the machine was moved: the app looks round anew";
  if (name == "base_moved") return "the base had moved: the app looks round anew, and for the truck";
  if (name == "resumed" || name == "released") return "moving again";
  return {};
}

}  // namespace

std::string app_event_words(const nlohmann::json& event, double time_s) {
  const std::string words = words_of(event);
  return words.empty() ? words : fmt::format("{:7.1f} s  {}", time_s, words);
}

std::string plant_event_words(const nlohmann::json& event) {
  const std::string name = event.value("event", "");
  const double t = event.value("t", 0.0);
  if (name == "contact") return fmt::format("{:7.1f} s  CONTACT: {}", t, event.value("what", "?"));
  if (name == "truck_arrived") return fmt::format("{:7.1f} s  a truck stands ready", t);
  if (name == "bench_move") return fmt::format("{:7.1f} s  the operator trammed the machine back by {:.1f} m", t, event.value("distance_m", 0.0));
  if (name == "hand_lift") return fmt::format("{:7.1f} s  the operator lifts the implements by hand", t);
  if (name == "press") return fmt::format("{:7.1f} s  the operator presses {}", t, event.value("keys", "?"));
  if (name == "truck_left") return fmt::format("{:7.1f} s  the truck has left", t);
  return {};
}

}  // namespace berm::run
