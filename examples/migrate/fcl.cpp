// The same through FCL and through tact: two deforming meshes, all pairs of facets that meet. Leaves with status 1 if
// they do not find the same ones.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <tact/tact.h>

#include <cstdio>
#include <limits>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "ball.h"

namespace {

using Pairs = std::set<std::pair<int, int>>;
constexpr double kStart[] = {0.0, 1.55};  // metres, where the balls are added
constexpr double kStep = -0.1;            // metres, how the second moves

Pairs by_fcl() {
  Pairs found;
  // [part fcl]
  using Model = fcl::BVHModel<fcl::OBBRSSd>;
  struct Body {
    std::shared_ptr<Model> model;
    std::unique_ptr<fcl::CollisionObjectd> object;
  };
  std::vector<Body> bodies;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  const auto points_of = [](const Eigen::Matrix3Xd& positions) {
    std::vector<fcl::Vector3d> points;
    for (int i = 0; i < positions.cols(); ++i) points.push_back(positions.col(i));
    return points;
  };
  // Add.
  for (const double x : kStart) {
    const example::Ball ball = example::ball(x);
    std::vector<fcl::Triangle> triangles;
    for (int f = 0; f < ball.facets.cols(); ++f) {
      triangles.emplace_back(ball.facets(0, f), ball.facets(1, f), ball.facets(2, f));
    }
    auto model = std::make_shared<Model>();
    model->beginModel();
    model->addSubModel(points_of(ball.positions), triangles);
    model->endModel();
    bodies.push_back({model, std::make_unique<fcl::CollisionObjectd>(model)});
    manager.registerObject(bodies.back().object.get());
  }
  manager.setup();
  // Move.
  Body& second = bodies[1];
  second.model->beginReplaceModel();
  second.model->replaceSubModel(points_of(example::ball(kStart[1] + kStep).positions));
  second.model->endReplaceModel(true, true);
  second.model->computeLocalAABB();
  second.object->computeAABB();
  manager.update();
  // Ask.
  struct Collisions {
    fcl::CollisionRequestd request{std::numeric_limits<std::size_t>::max(), true};
    fcl::CollisionResultd result;
  } collisions;
  manager.collide(&collisions, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
    auto& of = *static_cast<Collisions*>(data);
    fcl::collide(a, b, of.request, of.result);
    return false;
  });
  for (std::size_t i = 0; i < collisions.result.numContacts(); ++i) {
    const fcl::Contactd& contact = collisions.result.getContact(i);
    const bool in_order = contact.o1 == bodies[0].model.get();
    found.emplace(static_cast<int>(in_order ? contact.b1 : contact.b2),
                  static_cast<int>(in_order ? contact.b2 : contact.b1));
  }
  // [part fcl]
  return found;
}

Pairs by_tact() {
  Pairs found;
  // [part tact]
  std::vector<tact::BodyId> bodies;
  tact::World world;
  // Add.
  for (const double x : kStart) {
    const example::Ball ball = example::ball(x);
    bodies.push_back(world.add_body({.positions = ball.positions, .facets = ball.facets}));
  }
  // Move.
  world.set_positions(bodies[1], example::ball(kStart[1] + kStep).positions);
  // Ask.
  for (const tact::Contact& contact : world.detect().contacts()) {
    for (const tact::FacetPair& pair : contact.facet_pairs()) found.emplace(pair.a, pair.b);
  }
  // [part tact]
  return found;
}

}  // namespace

int main() {
  const Pairs theirs = by_fcl(), ours = by_tact();
  std::printf("FCL %zu facet pairs, tact %zu\n", theirs.size(), ours.size());
  return !ours.empty() && theirs == ours ? 0 : 1;
}
