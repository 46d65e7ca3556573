// One truck of the run: a bed with four walls on a chassis, a cab, and its load; comes in reverse, parks, leaves forward.
#pragma once

#include <string>
#include <vector>

#include "plant/process/world_config.hpp"
#include "plant/world/bed_heap.hpp"
#include "plant/world/vec3.hpp"

namespace berm::plant {

// An axis-aligned box of the bed's frame: x along the bed to the cab, y left, z from the bed's floor.
struct TruckPart { std::string name; Vec3 low, high; };

class Truck {
 public:
  enum class Phase { waiting, arriving, parked, leaving, gone };

  // ground_z under the truck; place_* how far from the entry's place this one comes to stand.
  Truck(const TruckConfig& config, const SoilConfig& soil, std::string name, double ground_z, double place_x, double place_y, double place_yaw);

  // The truck before it is gone (or the run begins): it stands config.wait_s later, or as soon as it can be there.
  void call(double t);
  void release(double t);
  // Out of the way of a machine that trams: where it is parked it drives off, with its load, and waits to be called again; where it only waits it goes on
  // waiting. One that is arriving parks first.
  void make_way(double t);
  // The machine stands elsewhere: the spotter brings the truck as far from it as before.
  void shift(double x, double y);
  // Position at t, and the load settles; what runs over the walls goes to `over` (bed's frame).
  void step(double t, int settle_budget, std::vector<Overflow>& over);

  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] bool present() const { return phase_ == Phase::arriving || phase_ == Phase::parked || phase_ == Phase::leaving; }
  [[nodiscard]] double gone_at() const { return leave_at_ + drive_time(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  // Bed's frame in the base frame.
  [[nodiscard]] const PlanarFrame& frame() const { return frame_; }
  [[nodiscard]] double yaw() const { return yaw_; }
  [[nodiscard]] double parked_x() const { return parked_x_; }
  [[nodiscard]] double parked_y() const { return parked_y_; }
  // By how much shift moved its place.
  [[nodiscard]] double shifted_x() const { return shifted_x_; }
  [[nodiscard]] double shifted_y() const { return shifted_y_; }
  [[nodiscard]] bool makes_way() const { return makes_way_; }
  [[nodiscard]] const TruckConfig& config() const { return config_; }
  [[nodiscard]] const std::vector<TruckPart>& parts() const { return part_; }
  [[nodiscard]] const TruckPart& hull() const { return hull_; }
  [[nodiscard]] const BedHeap& heap() const { return heap_; }
  [[nodiscard]] BedHeap& heap() { return heap_; }
  [[nodiscard]] double load_kg() const { return heap_.loose_volume() * loose_density_; }
  // Is a point of the bed's frame over the bed's inside, or over the truck at all?
  [[nodiscard]] bool over_bed(const Vec3& p) const;
  [[nodiscard]] bool over_truck(const Vec3& p) const;

 private:
  [[nodiscard]] double drive_time() const;
  // Way covered after tau seconds of speeding up to the driving speed.
  [[nodiscard]] double way(double tau) const;
  void place(double ahead);

  TruckConfig config_;
  std::string name_;
  double loose_density_, yaw_, parked_x_, parked_y_, ahead_ = -1;
  double stand_at_ = 0, leave_at_ = 0, shifted_x_ = 0, shifted_y_ = 0;
  Phase phase_ = Phase::waiting;
  bool called_ = false, makes_way_ = false;
  std::vector<TruckPart> part_;
  TruckPart hull_;
  BedHeap heap_;
  PlanarFrame frame_;
};

}  // namespace berm::plant
