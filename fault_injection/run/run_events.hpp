// What app and plant say in the course of a run: told as it comes, counted, and the app's kept.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run/child_process.hpp"

namespace berm::run {

class RunEvents {
 public:
  explicit RunEvents(bool quiet) : quiet_(quiet) {}

  // The app's go into this file too, as they come, so that a run that is cut off leaves them: as .part until it is closed.
  void write_to(const std::string& file);
  void close();  // throws std::runtime_error when not all could be written

  // time_s: of the simulation.
  void take_app(ChildProcess& app, double time_s);
  void take_plant(ChildProcess& plant);
  void say(const std::string& words) const;

  const std::vector<nlohmann::json>& of_app() const { return of_app_; }
  bool app_connected() const;
  int passes() const { return passes_; }
  int trucks_away() const { return trucks_away_; }
  int bench_moves() const { return bench_moves_; }

 private:
  const bool quiet_;
  std::vector<nlohmann::json> of_app_;
  int passes_ = 0, trucks_away_ = 0, bench_moves_ = 0;
  std::string path_, error_;
  std::ofstream file_;
};

}  // namespace berm::run
