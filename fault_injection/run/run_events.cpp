#include "run/run_events.hpp"

#include <fmt/format.h>
#include <string.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "run/event_words.hpp"

namespace berm::run {

using nlohmann::json;

void RunEvents::write_to(const std::string& file) {
  path_ = file;
  file_.open(path_ + ".part");
  if (!file_) throw std::runtime_error(path_ + ".part: cannot write");
}

void RunEvents::close() {
  file_.close();
  if (!file_) throw std::runtime_error(fmt::format("{}.part: not all could be written: {}", path_, error_));
  std::filesystem::rename(path_ + ".part", path_);
}

void RunEvents::take_app(ChildProcess& app, double time_s) {
  for (const auto& line : app.take_lines()) {
    auto event = json::parse(line, nullptr, false);
    if (!event.is_object()) continue;
    if (event.value("event", "") == "pass") ++passes_;
    say(app_event_words(event, time_s));
    if (file_.is_open() && file_ && !(file_ << event.dump() << std::endl)) error_ = strerror(errno);  // told of at the end
    of_app_.push_back(std::move(event));
  }
}

void RunEvents::take_plant(ChildProcess& plant) {
  for (const auto& line : plant.take_lines()) {
    const auto event = json::parse(line, nullptr, false);
    if (!event.is_object()) continue;
    const std::string name = event.value("event", "");
    if (name == "bench_move") ++bench_moves_;
    if (name == "truck_left") ++trucks_away_;
    say(plant_event_words(event));
  }
}

void RunEvents::say(const std::string& words) const {
  if (quiet_ || words.empty()) return;
  fmt::print("{}\n", words);
  std::fflush(stdout);
}

bool RunEvents::app_connected() const {
  return std::any_of(of_app_.begin(), of_app_.end(), [](const json& event) { return event.value("event", "") == "connected"; });
}

}  // namespace berm::run
