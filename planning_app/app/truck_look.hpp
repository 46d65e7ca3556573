// Looking for the truck that the spotter has admitted: one sweep over the place where trucks park, whose scanlines go to the recogniser as they come, and a
// bed to load; again and again until there is one. When an answer stands before the sweep's end the look ends once the scanner has passed the bed. Where
// the truck truly stands and how large it is the site file does not say.
//
// Of a machine that has waited where it sees the place the sweep begins where it stands and goes on while it swings to its first dig (stentz-1999, 3: the
// truck is scanned during the first dig). In a stop the place is seen from 60 degrees before it.
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

  // Swing angle from which a sweep may go on on the way to a dig, of a machine that stands at this one: the implements, which reach so far (m), over a dig
  // zone, where no truck passes; as near to the truck as it has to be to see the whole place, and the place of its bed at least. Nothing where there is none.
  std::optional<double> bearing_on_the_way(double swing_angle, double reach) const;
  // The machine stands at such an angle, or swings there, and then to the dig.
  void begin_on_the_way(const Observation& o, ScanScheduler& scanners, double from, double dig_bearing);
  bool on_the_way() const { return dig_bearing_.has_value() && stage_ != Stage::idle; }
  // What the sweep has not seen yet is seen from the dig, too.
  bool way_is_free(const Observation& o, const ScanScheduler& scanners) const;
  // On the way: nothing was recognised. It is to be looked again, in a stop.
  bool missed() const { return on_the_way() && stage_ == Stage::pauses; }
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
  PanSector bearings_of_place(double half_length, double swing_angle) const;
  double needed_for(double half_length, double swing_angle) const;
  void begin_sweep(const Observation& o);
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
  double bearing_began_ = 0.0;     // of the sweep
  std::optional<double> dig_bearing_;  // the sweep goes on on the way there
  std::size_t told_ = 0;           // of its points
  std::optional<TruckBed> bed_;    // that was recognised in it
  int vain_ = 0;                   // looks since the last truck
  int restarts_ = 0;               // of this look, for a swing that did not stand
  std::vector<std::string> told_operator_;  // of this truck: events that he was told of
};

}  // namespace berm::app
