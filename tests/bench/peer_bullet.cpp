#include "peer_bullet.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <btBulletCollisionCommon.h>
#pragma GCC diagnostic pop
#include <vector>

namespace berm::bench {

namespace {

btVector3 vector_of(const Vec3& v) { return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)}; }

btTransform transform_of(const Pose& p) {
  const btVector3 x = vector_of(p.x), y = vector_of(p.y), z = vector_of(p.z);
  return btTransform(btMatrix3x3(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z()), vector_of(p.at));
}

struct FirstContact : btCollisionWorld::ContactResultCallback {
  bool found = false;
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int, const btCollisionObjectWrapper*, int, int) override {
    if (point.getDistance() <= btScalar(0)) found = true;
    return 0;
  }
};

}  // namespace

struct BulletMap::Inside {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
  btTriangleMesh triangles{true, false};
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  btCollisionObject object;
  double margin_m = 0.0;
  std::vector<std::unique_ptr<btConvexHullShape>> body;
};

BulletMap::BulletMap(const Mesh& mesh, double margin_m) : in_(new Inside) {
  in_->margin_m = margin_m;
  for (const auto& t : mesh.triangle) in_->triangles.addTriangle(vector_of(mesh.vertex[t[0]]), vector_of(mesh.vertex[t[1]]), vector_of(mesh.vertex[t[2]]), false);
  in_->shape = std::make_unique<btBvhTriangleMeshShape>(&in_->triangles, true);
  if (margin_m >= 0.0) in_->shape->setMargin(static_cast<btScalar>(margin_m));
  in_->object.setCollisionShape(in_->shape.get());
  in_->world.addCollisionObject(&in_->object);
}

BulletMap::~BulletMap() { in_->world.removeCollisionObject(&in_->object); }

void BulletMap::add(const ConvexBody& body) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& v : body.corner) hull->addPoint(vector_of(v), false);
  hull->recalcLocalAabb();
  if (in_->margin_m >= 0.0) hull->setMargin(static_cast<btScalar>(in_->margin_m));
  in_->body.push_back(std::move(hull));
}

void BulletMap::clear_bodies() { in_->body.clear(); }
int BulletMap::bodies() const { return static_cast<int>(in_->body.size()); }

bool BulletMap::hits(int i) const {
  btCollisionObject object;
  object.setCollisionShape(in_->body[i].get());
  FirstContact first;
  in_->world.contactPairTest(&object, &in_->object, first);
  return first.found;
}

bool BulletMap::sweep_hits(int i, const Pose& from, const Pose& to) const {
  const btTransform a = transform_of(from), b = transform_of(to);
  btCollisionWorld::ClosestConvexResultCallback closest(a.getOrigin(), b.getOrigin());
  in_->world.convexSweepTest(in_->body[i].get(), a, b, closest);
  return closest.hasHit();
}

}  // namespace berm::bench
