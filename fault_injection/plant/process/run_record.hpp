// What is said of a whole run: contacts, closest approach, loads, how it ended. Becomes truth.json (scenarios/FORMAT.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plant/process/disturbances.hpp"
#include "plant/process/operator.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

struct Contact { double time_s; std::string what; };

class RunRecord {
 public:
  // Of one step. Returns true when a new contact begins.
  bool judge(double t, const OracleVerdict& verdict);
  // Something that should bring the machine to a standstill: only the first counts.
  void fault(double t, const std::string& what);
  void standstill(double t, bool standing);
  void truck_left(double t, const Truth& truth);

  struct End {
    std::string scenario, reason;
    std::uint64_t seed = 0;
    double time_s = 0.0, target_kg = 0.0;
    std::uint64_t refused_frames = 0;
    std::uint32_t scan_packets = 0;
    Truth truth;
    std::vector<Disturbance> disturbances;
    std::vector<BenchMove> moves;
    std::vector<HandLiftTime> hand_lifts;
    std::vector<Operator::Press> presses;
  };
  void write(const std::string& path, const End& end) const;  // throws std::runtime_error

 private:
  struct Departure { double time_s, load_kg, centre_offset_m, height_stddev_m; };

  bool in_contact_ = false;
  std::vector<Contact> contacts_;
  std::optional<double> closest_m_, ground_gap_m_;
  double closest_time_s_ = 0.0;
  std::string closest_what_;
  std::optional<double> fault_s_, standstill_s_;
  std::string fault_what_;
  std::vector<Departure> departures_;
};

}  // namespace berm::plant
