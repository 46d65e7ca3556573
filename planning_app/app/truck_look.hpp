// Looking for the truck that the spotter has admitted: one sweep over the place where trucks park, whose scanlines go to the recogniser as they come, and a
// bed to load; again and again until there is one. When an answer stands before the sweep's end the look ends once the scanner has passed the bed. Where
// the truck truly stands and how large it is the site file does not say.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/look_watch.hpp"
#include "app/observation.hpp"
#include "app/progress_log.hpp"
#include "app/truck_finder.hpp"
#include "perception/truck_sweep.hpp"
#include "planning/site_model.hpp"

namespace berm::app {

class TruckLook {
public:
  // All three must outlive it.
  TruckLook(const MachineModel& machine, const SiteModel& site, TruckFinder& finder);

  // Swing angle from which the scanner on the truck's side sees the whole place, past the implements.
  double bearing() const;
  // The machine stands there.
  void begin(const Observation& o, ScanScheduler& scanners);
  // Once a cycle from then on. The bed, when one was recognised.
  std::optional<TruckBed> step(const Observation& o, ScanScheduler& scanners, int truck, const ProgressLog& log);
  // Something else came between: nothing is kept.
  void stop(ScanScheduler& scanners);
  // What is looked at from now on may be another truck than before: of that the operator was told nothing yet.
  void another_truck();
  // What the look waits for now.
  Awaited awaits(const Observation& o, const ScanScheduler& scanners) const;

  TruckSweep& sweep() { return sweep_; }

private:
  enum class Stage { idle, sweeps, drains, asked, passes, pauses };
  double head_bearing_of(double x, double y, double swing_angle) const;
  std::array<double, 3> viewpoint(double swing_angle) const;
  void feed(const Observation& o);  // what of the sweep is whole and has not been told
  bool passed(const TruckBed& bed, const Observation& o) const;
  void take_answer(const Observation& o, ScanScheduler& scanners, int truck, const ProgressLog& log);
  void end_sweep(ScanScheduler& scanners);
  std::optional<TruckBed> judge(const RecognisedTruck& truck, const Observation& o, int number, const ProgressLog& log);
  void tell_none(const std::string& event, nlohmann::ordered_json fields, const std::string& advice, const Observation& o, const ProgressLog& log);

  const MachineModel& machine_;
  const SiteModel& site_;
  TruckFinder& finder_;
  TruckSweep sweep_;
  std::size_t scanner_;
  double side_;                    // 1: the truck stands to the left of the dig
  Stage stage_ = Stage::idle;
  double stage_s_ = 0.0, swing_ = 0.0;
  double pan_began_ = 0.0;         // of the sweep
  std::size_t told_ = 0;           // of its points
  std::optional<TruckBed> bed_;    // that was recognised in it
  int vain_ = 0;                   // looks since the last truck
  int restarts_ = 0;               // of this look, for a swing that did not stand
  std::vector<std::string> told_operator_;  // of this truck: events that he was told of
};

}  // namespace berm::app
