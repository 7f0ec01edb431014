#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btMprPenetration.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <cmath>
#include <memory>

#include "bench/error/methods.h"

namespace tact::bench {
namespace {

btVector3 to_bullet(const Eigen::Vector3d& p) {
  return {static_cast<btScalar>(p.x()), static_cast<btScalar>(p.y()), static_cast<btScalar>(p.z())};
}
Eigen::Vector3d from_bullet(const btVector3& p) {
  return {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())};
}

struct Body {
  std::unique_ptr<btConvexHullShape> shape;
  btTransform transform = btTransform::getIdentity();
  btVector3 center{0, 0, 0};

  explicit Body(const Mesh& mesh)
      : shape(std::make_unique<btConvexHullShape>()), center(to_bullet(mesh.positions.rowwise().mean())) {
    for (const auto p : mesh.positions.colwise()) shape->addPoint(to_bullet(p), false);
    shape->recalcLocalAabb();
    shape->setMargin(0);
  }

  // What btMprPenetration.h asks of a convex body.
  btVector3 getObjectCenterInWorld() const { return transform * center; }
  const btTransform& getWorldTransform() const { return transform; }
  btVector3 getLocalSupportWithMargin(const btVector3& n) const { return shape->localGetSupportingVertex(n); }
  btVector3 getLocalSupportWithoutMargin(const btVector3& n) const {
    return shape->localGetSupportingVertexWithoutMargin(n);
  }
};

HullAnswer by_epa_solver(const Body& a, const Body& b) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver solver;
  btVector3 direction(0, 0, 0), on_a, on_b;
  if (!solver.calcPenDepth(simplex, a.shape.get(), b.shape.get(), a.transform, b.transform, direction, on_a, on_b,
                           nullptr))
    return {};
  const Eigen::Vector3d between = from_bullet(on_a) - from_bullet(on_b);
  return {true, between.norm(), between.norm() > 0.0 ? between.normalized() : from_bullet(direction), false};
}

HullAnswer by_pair_detector(const Body& a, const Body& b) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver solver;
  btGjkPairDetector detector(a.shape.get(), b.shape.get(), &simplex, &solver);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = a.transform;
  input.m_transformB = b.transform;
  btPointCollector found;
  detector.getClosestPoints(input, found, nullptr);
  if (!found.m_hasResult || found.m_distance > 0) return {};
  return {true, -static_cast<double>(found.m_distance), -from_bullet(found.m_normalOnBInWorld), false};
}

HullAnswer by_mpr(const Body& a, const Body& b) {
  btMprCollisionDescription description;
  btMprDistanceInfo found;
  if (btComputeMprPenetration(a, b, description, &found) != 0) return {};
  return {true, -static_cast<double>(found.m_distance), -from_bullet(found.m_normalBtoA), false};
}

using Query = HullAnswer (*)(const Body&, const Body&);

class BulletHulls : public HullMethod {
 public:
  BulletHulls(const HullRow& row, Query query) : row_(row), query_(query), answers_(row.pairs.size()) {
    for (const HullPair& pair : row.pairs) {
      a_.emplace_back(pair.a);
      b_.emplace_back(pair.b);
    }
  }

  void step(int frame) override {
    for (std::size_t i = 0; i < a_.size(); ++i) {
      b_[i].transform.setOrigin(to_bullet(row_.pairs[i].path[frame]));
      answers_[i] = query_(a_[i], b_[i]);
    }
  }

  HullAnswer answer(std::size_t pair) const override {
    HullAnswer answer = answers_[pair];
    if (answer.overlap && !(std::isfinite(answer.depth) && answer.direction.allFinite())) answer.failed = true;
    return answer;
  }

 private:
  const HullRow& row_;
  Query query_;
  std::vector<Body> a_, b_;
  std::vector<HullAnswer> answers_;
};

}  // namespace

std::vector<HullMethodKind> bullet_hull_methods() {
  const auto make = [](Query query) {
    return [query](const HullRow& row) { return std::make_unique<BulletHulls>(row, query); };
  };
  return {{"Bullet", "GJK+EPA", Minimum::smallest, make(by_epa_solver)},
          {"Bullet", "pair detector", Minimum::smallest, make(by_pair_detector)},
          {"Bullet", "MPR", Minimum::smallest, make(by_mpr)}};
}

}  // namespace tact::bench
