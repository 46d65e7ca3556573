#include "peer_fcl.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <fcl/fcl.h>
#pragma GCC diagnostic pop

namespace berm::bench {

struct FclMap::Inside {
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<std::shared_ptr<fcl::Convexd>> body;
};

FclMap::FclMap(const Mesh& mesh) : in_(new Inside) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  vertices.reserve(mesh.vertex.size());
  triangles.reserve(mesh.triangle.size());
  for (const Vec3& v : mesh.vertex) vertices.emplace_back(v.x, v.y, v.z);
  for (const auto& t : mesh.triangle) triangles.emplace_back(t[0], t[1], t[2]);
  in_->model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  in_->model->addSubModel(vertices, triangles);
  in_->model->endModel();
}

FclMap::~FclMap() = default;

void FclMap::add(const ConvexBody& body) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3& v : body.corner) vertices->emplace_back(v.x, v.y, v.z);
  in_->body.push_back(std::make_shared<fcl::Convexd>(vertices, body.face_count(), std::make_shared<std::vector<int>>(body.faces())));
  in_->body.back()->computeLocalAABB();
}

void FclMap::clear_bodies() { in_->body.clear(); }
int FclMap::bodies() const { return static_cast<int>(in_->body.size()); }

bool FclMap::hits(int i) const {
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  return fcl::collide(in_->body[i].get(), fcl::Transform3d::Identity(), in_->model.get(), fcl::Transform3d::Identity(), request, result) > 0;
}

}  // namespace berm::bench
