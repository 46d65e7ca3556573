// FCL: convex bodies against the map as a bounding-volume hierarchy of triangles.
#pragma once

#include <memory>
#include <vector>

#include "column_mesh.hpp"
#include "convex_body.hpp"

namespace berm::bench {

class FclMap {
 public:
  explicit FclMap(const Mesh& mesh);
  ~FclMap();
  // Bodies are made once, outside what is timed.
  void add(const ConvexBody& body);
  void clear_bodies();
  // Of body i, whether it meets the map; the first contact ends the question.
  bool hits(int i) const;
  int bodies() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> in_;
};

}  // namespace berm::bench
