// The operator: hears the horn, sees the kernel's state on the panel, and does what the app's messages ask of a person: trams the machine back from a
// face that is dug out, and after stops that latch looks, then switches run off, resets, and switches run on. Where that did not help, and it is the
// ground that keeps the machine, he lifts the implements by hand before he has the map learned anew. He knows nothing of the app but its horn.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "can/berm_can.h"
#include "plant/machine/state_frames.hpp"
#include "plant/machine/strict_table.hpp"
#include "plant/process/horn_listener.hpp"
#include "plant/world/base_pose.hpp"
#include "plant/world/random.hpp"

namespace berm::plant {

struct OperatorConfig {
  std::array<double, 2> reaction_s{};                  // from the end of a signal until he acts, drawn
  double tram_speed = 0.0;                             // m/s
  double farthest_back_m = 0.0;                        // from where the machine stood at first; no farther
  std::optional<std::array<double, 2>> resets_after_s; // from a stop that latches until he has looked; none: nobody looks
};

std::optional<OperatorConfig> read_operator(StrictTable& file);

struct HandLiftTime { double from_s, to_s; };   // run switch off and on again
struct BenchMove { double from_s, to_s, x_m, y_m, distance_m; };  // run switch off and on again; where the base stands from then on

class Operator {
 public:
  Operator(const OperatorConfig& config, std::uint64_t seed);

  struct Sees {
    bool standing = false;         // the machine
    bool truck_about = false;      // a truck stands or drives at the machine
    const berm_heartbeat* panel = nullptr;  // the newest; none: dark
    double base_yaw = 0.0;
    std::array<double, 4> angle{};          // of the joints, rad
    bool implements_up = false;             // HandLift: done
    bool run_switch = true;                 // as others leave it
    double dust = 0.0;                      // share of the sensors' samples that it meets
  };
  // From the cycle before to t. signal: of the horn, complete just now.
  void step(double t, const HornSignal& signal, const Sees& sees);

  bool run() const { return run_; }                    // the switch
  bool reset() const { return reset_; }
  bool relearn() const { return relearn_; }
  // The way of the base on its tracks so far, and how it rocks when the tracks start and stop.
  const BasePose& base() const { return base_; }
  bool wants_place() const { return stage_ == Stage::clears; }   // no truck may stand at the machine now
  const BenchMove* moved() const { return moved_ ? &moves_.back() : nullptr; }  // the tram ended in the newest step
  bool lifts() const { return stage_ == Stage::lifts; }          // has the levers; the selector is at manual
  const std::vector<HandLiftTime>& hand_lifts() const { return hand_lifts_; }
  bool refuses() const { return refuses_; }            // was asked to move farther back than there is room
  double asked_s() const { return asked_s_; }
  const std::vector<BenchMove>& moves() const { return moves_; }
  struct Press { double time_s; bool reset; std::uint8_t reason; };
  const std::vector<Press>& presses() const { return presses_; } // after stops

 private:
  enum class Stage { works, heard, stops, clears, rolls, rests, relearns, waits, resets, run_on, looks, presses, takes, lifts };
  void enter(Stage stage, double t);
  void attend(double t, const Sees& sees);
  void roll(double t, double yaw);
  double drawn(const std::array<double, 2>& range) { return random_.uniform(range[0], range[1]); }

  OperatorConfig config_;
  Random random_;
  Stage stage_ = Stage::works;
  double since_s_ = 0.0, delay_s_ = 0.0, asked_s_ = -1.0;
  double distance_m_ = 0.0, back_m_ = 0.0;
  bool run_ = true, reset_ = false, relearn_ = false, moved_ = false, refuses_ = false, held_ = false;
  BasePose from_, base_;
  double stopped_since_s_ = -1.0, off_s_ = 0.0;
  std::optional<double> acts_s_;         // on the stop that he has noticed
  std::optional<std::array<double, 4>> pressed_at_;     // joints at the last press, rad
  bool lifting_ = false, trams_ = false;  // from the run switch off on
  std::vector<HandLiftTime> hand_lifts_;
  std::vector<BenchMove> moves_;
  std::vector<Press> presses_;
};

}  // namespace berm::plant
