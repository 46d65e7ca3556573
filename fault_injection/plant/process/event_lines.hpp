// Progress on standard output: one JSON object a line, flushed, so that the launcher can follow.
#pragma once

#include <string>

namespace berm::plant {

class EventLines {
 public:
  void time(double t) const;                                          // {"event":"time","t":..}
  void truck(const char* event, double t, int truck, double load_kg) const;  // truck_arrived, truck_left; trucks count from 1
  void contact(double t, const std::string& what) const;
  void peer(double t, const char* who, const char* state) const;      // kernel or app: gone, absent, back
  void bench_move(double t, double distance_m, double x_m) const;  // ended; where the base stands
  void hand_lift(double t) const;                                   // the operator takes the levers
  void press(double t, const char* keys, int stop_reason) const;   // the operator, after a stop
  void finished(double t, const std::string& reason) const;
};

}  // namespace berm::plant
