// Bullet: convex hulls against a triangle mesh, at rest and swept (single precision, as Debian builds it).
#pragma once

#include <memory>

#include "column_mesh.hpp"
#include "convex_body.hpp"

namespace berm::bench {

class BulletMap {
 public:
  // margin_m below 0: Bullet's own default (0.04 m on the mesh and on each body).
  BulletMap(const Mesh& mesh, double margin_m);
  ~BulletMap();
  void add(const ConvexBody& body);
  void clear_bodies();
  int bodies() const;
  // Whether body i, placed where it was given, touches the map.
  bool hits(int i) const;
  // convexSweepTest of body i (given in its link's frame) from one pose to another.
  bool sweep_hits(int i, const Pose& from, const Pose& to) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> in_;
};

}  // namespace berm::bench
