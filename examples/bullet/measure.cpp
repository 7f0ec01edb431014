#include "measure.h"

#include <algorithm>

namespace example {
namespace {

constexpr std::size_t kEvery = 4;  // steps: what is 0.1 s in another body is not missed

struct Energy {
  double moving = 0.0;
  double lifted = 0.0;  // above the ground
};

Energy energy(const Scene& scene) {
  Energy sum;
  for (const SceneBody& body : scene.bodies()) {
    if (body.rigid != nullptr && !body.rigid->isStaticObject()) {
      const btVector3 spin = body.rigid->getAngularVelocity();
      const double mass = 1.0 / body.rigid->getInvMass();
      const btMatrix3x3 inertia = body.rigid->getInvInertiaTensorWorld().inverse();
      sum.moving += 0.5 * mass * body.rigid->getLinearVelocity().length2() + 0.5 * spin.dot(inertia * spin);
      sum.lifted += mass * kGravity * body.rigid->getWorldTransform().getOrigin().z();
    }
    if (body.soft == nullptr) continue;
    for (int i = 0; i < body.soft->m_nodes.size(); ++i) {
      const btSoftBody::Node& node = body.soft->m_nodes[i];
      sum.moving += 0.5 / node.m_im * node.m_v.length2();
      sum.lifted += kGravity / node.m_im * node.m_x.z();
    }
  }
  return sum;
}

}  // namespace

Measure::Measure(const Scene& scene) {
  std::uint32_t layer = 1;
  for (const SceneBody& body : scene.bodies()) {
    ids_.push_back(world_.add_body({.positions = scene.positions(body),
                                    .facets = body.mesh.facets,
                                    .surface = body.closed ? tact::Surface::closed : tact::Surface::sheet,
                                    .name = body.name,
                                    .layer = layer,
                                    .self_contact = !body.closed}));
    layer *= 2;
  }
  const Energy start = energy(scene);
  energy_at_start_ = start.moving + start.lifted;
}

void Measure::look(const Scene& scene, double milliseconds) {
  times_.push_back(milliseconds);
  const Energy now = energy(scene);
  so_far_.gained = std::max(so_far_.gained, now.moving + now.lifted - energy_at_start_);
  if (times_.size() % kEvery != 0) return;
  for (std::size_t i = 0; i < ids_.size(); ++i) world_.set_positions(ids_[i], scene.positions(scene.bodies()[i]));
  so_far_.crossings = std::max(so_far_.crossings, world_.detect().stats().facet_pairs);
  so_far_.deepest = std::max(so_far_.deepest, deepest(scene));
}

// The vertex of a body in another, closed one that is farthest from its surface.
double Measure::deepest(const Scene& scene) const {
  double deepest = 0.0;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const Eigen::Matrix3Xd positions = scene.positions(scene.bodies()[i]);
    for (Eigen::Index v = 0; v < positions.cols(); ++v) {
      const tact::QueryFilter others{.mask = ~world_.layer(ids_[i])};
      for (const tact::BodyId outer : world_.bodies_containing({.point = positions.col(v), .filter = others})) {
        const tact::QueryFilter that{.mask = world_.layer(outer)};
        deepest = std::max(deepest, world_.closest_point({.point = positions.col(v), .filter = that}).distance);
      }
    }
  }
  return deepest;
}

Measured Measure::result(const Scene& scene) const {
  Measured measured = so_far_;
  measured.moving = energy(scene).moving;
  for (const SceneBody& body : scene.bodies()) {
    const Eigen::Matrix3Xd positions = scene.positions(body);
    if (body.name == "box") measured.box_height = positions.row(2).mean();
    if (body.name == "cloth") measured.cloth_height = positions(2, positions.cols() / 2);
  }
  std::vector<double> times = times_;
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  measured.step_ms = times[times.size() / 2];
  return measured;
}

}  // namespace example
