// The bucket through the ground: columns above the swept bucket's lower boundary are cut down to it; the soil fills the bucket or
// is pushed ahead of it.
#pragma once

#include <vector>

#include "plant/world/bucket_load.hpp"
#include "plant/world/base_pose.hpp"
#include "plant/world/link_frames.hpp"
#include "plant/world/landing.hpp"
#include "plant/world/terrain.hpp"

namespace berm::plant {

// The bucket's outline in the swing plane at one moment.
struct BucketPose {
  double x = 0, y = 0;  // the swing axis on the ground
  double swing = 0, cos_swing = 1, sin_swing = 0;
  LinkFrame frame;
  std::vector<SwingPlanePoint> outline;  // of all bucket parts
};

class SoilCut {
 public:
  SoilCut(const ImplementShape& shape, const SoilConfig& soil);

  [[nodiscard]] BucketPose pose(const LinkFrames& links, const BasePose& base = {}) const;
  // Cuts, fills the bucket and pushes the rest ahead. Returns the loose volume cut.
  double cut(const BucketPose& before, const BucketPose& now, double dt, Terrain& terrain, BucketLoad& load, SoilBook& book);
  // Lets out what does not rest in the bucket.
  void empty(const BucketPose& now, double dt, const Terrain& terrain, BucketLoad& load, Landing& landing, SoilBook& book) const;
  // What the soil leaves of the joints' speeds after this step's cut.
  double speed_factor(double cut_volume, double dt);
  // Against the edge's motion, as large as the share of the speed that the soil takes.
  [[nodiscard]] EdgeForce edge_force(const BucketPose& before, const BucketPose& now, double dt, double speed_factor) const;

 private:
  [[nodiscard]] Vec3 motion(const BucketPose& before, const BucketPose& now, double dt) const;
  void push(const BucketPose& now, const Vec3& velocity, double volume, Terrain& terrain) const;
  [[nodiscard]] bool held_by_ground(const BucketPose& now, const Terrain& terrain) const;

  const ImplementShape shape_;
  double resistance_;
  double cut_rate_ = 0;  // bank m3/s, smoothed
  double swell_;
  std::vector<SwingPlanePoint> corner_, hull_;  // reused
};

}  // namespace berm::plant
