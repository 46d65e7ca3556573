// A tiny excavator and kernel for the app's tests, behind a state segment in the contract's layout: first-order joints with dead time, a
// bucket that cuts and pours, two panning scanners, and a kernel that permits what its own simple checks permit. Nothing of kernel or plant.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <random>
#include <vector>

#include "app_bench/bench_site.hpp"
#include "contract/berm_contract.h"
#include "motion/machine_model.hpp"
#include "motion/soil_force.hpp"
#include "planning/script_set.hpp"
#include "planning/site_model.hpp"

namespace berm::app_bench {

// The ZX200 and the bench from their files in interface_spec/config; the truck that stands on the miniature bench, and a site where it was recognised.
app::MachineModel shipped_machine(const std::string& name);
app::SiteModel shipped_site(const std::string& name);
app::MachineModel zx200();
app::SiteModel bench();
app::TruckBed bench_bed();
app::SiteModel bench_with_truck();
// The scripts that come with the app.
app::ScriptSet shipped_scripts();

struct Findings {
  int wall_contacts = 0;      // cycles in which an implement was under the truck's top plus the kernel's margin, over the truck
  int ground_contacts = 0;    // ... under the ground plus margin outside the dig zone, or inside it while swinging fast
  int floor_contacts = 0;     // under the dig zone's floor
  int range_contacts = 0;     // a joint outside its range
  int unseen_cells = 0;       // cell-cycles under the coming second of the actual motion never seen or older than the kernel's limit
  double lowest_over_truck = 1e9;  // of any implement over the truck, above its top
  double most_azimuth_rate = 0.0;  // rad/s of a scanline
};

class BenchMachine {
public:
  BenchMachine(const app::MachineModel& machine, const app::Joints& start, std::uint64_t seed);

  // One cycle: obeys the request, moves, scans, publishes into the segment.
  void step(const berm_request& request);

  const berm_state_segment& segment() const { return *segment_; }
  const berm_state& state() const { return segment_->state; }
  berm_state_segment& mutable_segment() { return *segment_; }
  BenchSite& site() { return site_; }
  const Findings& findings() const { return findings_; }
  double payload_kg() const { return payload_; }
  const app::Joints& angle() const { return angle_; }
  void put(app::Joint joint, double angle) { angle_[joint] = angle; }  // by hand
  void take(double kg) { payload_ = std::max(0.0, payload_ - kg); }  // out of the bucket
  void slip(double x, double y) { site_.slip(x, y); }  // the base
  void put_pan(std::size_t scanner, double pan) { pan_[scanner] = pan; }

  bool truck_parked = true, truck_leaves = false;
  bool kernel_runs = true;        // false: STOPPED, for stop_reason, nothing moves but at creep speeds
  bool map_void = false;          // the kernel begins its map anew in every cycle, as long as its base has moved
  std::uint8_t stop_reason = BERM_STOP_COLLISION_PREDICTED;
  bool weighs = true;             // false: the on-board weighing says nothing
  double weighing_error_kg = 0.0;
  bool has_pressures = false;     // the cylinders' are published, and the soil resists
  double held_by_n = -1.0;        // from 0: boom, stick and bucket stand whatever they are told, and so hard the soil pushes the bucket outward
  double sticks = 0.0;            // share of a load that stays in the bucket
  bool pours_by_tilt = false;     // no more leaves it than its tilt no longer holds: what tells in a bucket that opens slowly
  double holds_kg = 1608.0;       // the bucket, of this soil
  app::Joints most_speed{};       // rad/s, of each joint: what the kernel lets out of a request at most; by default the machine's largest
  app::Joints brake_share{1.0, 1.0, 1.0, 1.0};  // of the deceleration that was identified

private:
  struct Outline { std::vector<std::array<double, 3>> points; };  // r, z, lateral
  Outline implements(const app::Joints& q) const;
  void decide(const berm_request& request);
  double noise();  // -1 to 1
  void measure();
  void move();
  void work_soil();
  void scan(const berm_request& request);
  void check();
  void publish();
  void publish_cell(int ix, int iy);

  app::MachineModel machine_;
  BenchSite site_;
  std::unique_ptr<berm_state_segment> segment_;
  std::mt19937_64 random_;
  app::Joints angle_, velocity_{};
  std::array<std::deque<double>, 4> under_way_;
  std::array<std::int32_t, 4> measured_angle_{}, measured_velocity_{};  // urad, urad/s
  std::array<std::int32_t, 4> commanded_{}, permitted_low_{}, permitted_high_{};  // urad/s
  std::array<double, 2> pan_{}, pan_before_{};
  double payload_ = 0.0, most_carried_ = 0.0;  // kg; since the last dig
  double pushed_ = 0.0;                 // kg, in this cycle: into the bucket, and past it when it is full
  app::PlaneForce push_;                // of the soil on the tip
  bool digging_ = false;                // the weighing is blind
  std::uint64_t cycle_ = 0;
  std::array<std::uint32_t, 2> mirror_{}, scanline_{};
  std::vector<double> seen_;  // s, by 0.3 m cell
  int next_row_ = 0;
  Findings findings_;
};

}  // namespace berm::app_bench
