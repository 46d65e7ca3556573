// What a bucket holds at which attitude, and how fast the rest slides out.
#pragma once

#include "plant/process/world_config.hpp"
#include "plant/world/link_frames.hpp"

namespace berm::plant {

class BucketLoad {
 public:
  // ballast_kg: of a weight fixed in the bucket, which leaves that much less room for soil.
  BucketLoad(const ImplementShape& shape, const SoilConfig& soil, double ballast_kg = 0.0);

  // Angle between the mouth's outward normal (-z of the link) and up: 0 level, pi/2 mouth upright, pi mouth down.
  [[nodiscard]] static double mouth_tilt(const LinkFrame& bucket);
  // Loose volume that rests in the bucket at a tilt, m3, soil that sticks not counted.
  [[nodiscard]] double capacity(double tilt) const;
  [[nodiscard]] double heaped() const { return heaped_; }
  [[nodiscard]] double struck() const;
  [[nodiscard]] double volume() const { return volume_; }
  // Takes what still fits, returns the excess.
  double take(double loose_volume);
  // Soil that leaves in dt at a tilt; nothing while the ground before the mouth holds it.
  double release(double tilt, double dt, bool held_by_ground);
  void change_soil(const SoilConfig& soil) { stick_ = soil.stick_fraction; }

 private:
  double heaped_, stick_;
  double volume_ = 0;
  double before_dump_ = 0;  // what was in it when it last began to empty: the share that sticks counts from here
};

}  // namespace berm::plant
