#include "tact_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace example {
namespace {

constexpr std::uint32_t kSoftLayer = 1, kRigidLayer = 2;
constexpr double kTiny = 1e-30;  // metres, squared metres and inverse masses below it are none

Eigen::Vector3d as_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// The node positions of a soft body, read by tact where they are.
tact::Positions node_positions(const btSoftBody& body, const btVector3 btSoftBody::Node::*which) {
  const btSoftBody::Node& first = body.m_nodes[0];
  return tact::Positions::strided(static_cast<const btScalar*>((first.*which).m_floats),
                                  static_cast<std::size_t>(body.m_nodes.size()), sizeof(btSoftBody::Node));
}

Eigen::Matrix3Xd moved(const Eigen::Matrix3Xd& local, const btTransform& transform) {
  Eigen::Matrix3Xd positions(3, local.cols());
  for (Eigen::Index i = 0; i < local.cols(); ++i) {
    positions.col(i) = as_eigen(transform * btVector3(local(0, i), local(1, i), local(2, i)));
  }
  return positions;
}

}  // namespace

// [part side]
// A contact point's place on one body: a weighted mean of vertices, of a soft body or a rigid one.
struct TactSolver::Side {
  Participant& body;
  double most;  // inverse mass of a node, 1/kg
  const std::array<int, 3>& vertices;
  const std::array<double, 3>& weights;

  template <class Place>
  btVector3 mean(Place&& place) const {
    btVector3 sum(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      if (vertices[k] >= 0) sum += weights[k] * place(vertices[k]);
    }
    return sum;
  }
  btVector3 local() const {
    return mean([&](int v) { return btVector3(body.local(0, v), body.local(1, v), body.local(2, v)); });
  }
  btVector3 now() const {
    if (body.rigid != nullptr) return body.rigid->getWorldTransform() * local();
    return mean([&](int v) { return body.soft->m_nodes[v].m_x; });
  }
  btVector3 before() const {
    if (body.rigid != nullptr) return body.before * local();
    return mean([&](int v) { return body.soft->m_nodes[v].m_q; });
  }
  // By how much an impulse of 1 along `normal` moves this place along it.
  double give(const btVector3& normal) const {
    double sum = 0.0;
    if (body.rigid != nullptr) {
      const btVector3 turn = (now() - body.rigid->getWorldTransform().getOrigin()).cross(normal);
      return body.rigid->getInvMass() + turn.dot(body.rigid->getInvInertiaTensorWorld() * turn);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (vertices[k] >= 0)
        sum += weights[k] * weights[k] * std::min<double>(most, body.soft->m_nodes[vertices[k]].m_im);
    }
    return sum;
  }
  void move(const btVector3& impulse) const {
    if (body.rigid == nullptr) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (vertices[k] < 0) continue;
        btSoftBody::Node& node = body.soft->m_nodes[vertices[k]];
        node.m_x += impulse * (weights[k] * std::min<double>(most, node.m_im));
      }
      return;
    }
    btTransform& transform = body.rigid->getWorldTransform();
    const btVector3 arm = now() - transform.getOrigin();
    const btVector3 turn = body.rigid->getInvInertiaTensorWorld() * arm.cross(impulse);
    const double angle = turn.length();
    if (angle > kTiny) transform.setRotation(btQuaternion(turn / angle, angle) * transform.getRotation());
    transform.setOrigin(transform.getOrigin() + impulse * body.rigid->getInvMass());
  }
};
// [part side]

// [part add]
TactSolver::TactSolver(const TactSolverSettings& settings)
    : settings_(settings), world_(tact::Settings{.outputs = {.points = true}}) {}

void TactSolver::add(btSoftBody& body, tact::Surface surface) {
  Eigen::Matrix3Xi facets(3, body.m_faces.size());
  for (int f = 0; f < body.m_faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) facets(k, f) = static_cast<int>(body.m_faces[f].m_n[k] - &body.m_nodes[0]);
  }
  const tact::BodyId id = world_.add_body({.positions = node_positions(body, &btSoftBody::Node::m_x),
                                           .facets = facets,
                                           .surface = surface,
                                           .layer = kSoftLayer,
                                           .external_id = participants_.size(),
                                           .self_contact = surface == tact::Surface::sheet});
  participants_.push_back({.id = id, .soft = &body});
}

void TactSolver::add(btRigidBody& body, const Mesh& mesh) {
  const tact::BodyId id =
      world_.add_body({.positions = moved(mesh.positions, body.getWorldTransform()),
                       .facets = mesh.facets,
                       .motion = body.isStaticObject() ? tact::Motion::fixed : tact::Motion::deformable,
                       .layer = kRigidLayer,
                       .mask = kSoftLayer,  // two rigid bodies are Bullet's
                       .external_id = participants_.size(),
                       .margin = settings_.thickness / 2});
  participants_.push_back({.id = id, .rigid = &body, .local = mesh.positions});
}
// [part add]

void TactSolver::optimize(btAlignedObjectArray<btSoftBody*>& bodies, bool force_update) {
  btDefaultSoftBodySolver::optimize(bodies, force_update);
  for (Participant& participant : participants_) {
    if (participant.rigid != nullptr) participant.before = participant.rigid->getWorldTransform();
  }
}

// [part step]
// Position based dynamics over all bodies at once. Contacts are found where the step began, where nothing has crossed
// yet, as far around as anything moves in this step: a point then says on which side of each other two surfaces stay.
void TactSolver::solveConstraints(btScalar step) {
  for (Participant& participant : participants_) {
    if (participant.rigid != nullptr) participant.predicted = participant.rigid->getWorldTransform();
  }
  find_contacts();
  for (int i = 0; i < settings_.iterations; ++i) {
    for (int k = 0; k < m_softBodySet.size(); ++k) {
      btSoftBody::PSolve_Anchors(m_softBodySet[k], 1, 0);
      btSoftBody::PSolve_Links(m_softBodySet[k], 1, 0);
    }
    for (const tact::Contact& contact : report_->contacts()) {
      Participant& a = participants_[world_.external_id(contact.a)];
      Participant& b = participants_[world_.external_id(contact.b)];
      for (const tact::ContactPoint& point : contact.points()) keep_apart(point, a, b);
    }
  }
  end_step(step);
}

void TactSolver::find_contacts() {
  for (Participant& participant : participants_) {
    if (participant.rigid != nullptr && participant.rigid->isStaticObject()) continue;
    world_.set_margin(participant.id, settings_.thickness / 2 + longest_way(participant));
    if (participant.soft != nullptr) {
      world_.set_positions(participant.id, node_positions(*participant.soft, &btSoftBody::Node::m_q));
    } else {
      world_.set_positions(participant.id, moved(participant.local, participant.before));
    }
  }
  report_ = &world_.detect();
}

void TactSolver::keep_apart(const tact::ContactPoint& point, Participant& body_a, Participant& body_b) const {
  const Side a{body_a, 1.0 / settings_.lightest, point.a_vertices, point.a_weights};
  const Side b{body_b, 1.0 / settings_.lightest, point.b_vertices, point.b_weights};
  const btVector3 normal(point.normal.x(), point.normal.y(), point.normal.z());
  const btVector3 between = b.now() - a.now();
  const double missing = settings_.thickness - normal.dot(between);
  const double give = a.give(normal) + b.give(normal);
  if (missing <= 0.0 || give <= kTiny) return;
  btVector3 impulse = (missing / give) * normal;
  // Friction takes back what they slid in this step, by up to `friction` times the way out.
  btVector3 slid = between - (b.before() - a.before());
  slid -= normal.dot(slid) * normal;
  const double way = slid.length();
  if (way > kTiny) impulse -= (std::min(1.0, settings_.friction * missing / way) / give) * slid;
  a.move(-impulse);
  b.move(impulse);
}
// [part step]

double TactSolver::longest_way(const Participant& participant) const {
  double longest = 0.0;
  if (participant.soft != nullptr) {
    const btSoftBody::tNodeArray& nodes = participant.soft->m_nodes;
    for (int i = 0; i < nodes.size(); ++i) longest = std::max(longest, 1.0 * (nodes[i].m_x - nodes[i].m_q).length2());
    return std::sqrt(longest);
  }
  const Eigen::Matrix3Xd before = moved(participant.local, participant.before);
  const Eigen::Matrix3Xd after = moved(participant.local, participant.predicted);
  return (after - before).colwise().norm().maxCoeff();
}

// Velocities are what the step has moved.
void TactSolver::end_step(double step) {
  for (Participant& participant : participants_) {
    if (participant.soft != nullptr) {
      const double kept = (1.0 - participant.soft->m_cfg.kDP) / step;
      for (int i = 0; i < participant.soft->m_nodes.size(); ++i) {
        btSoftBody::Node& node = participant.soft->m_nodes[i];
        node.m_v = (node.m_x - node.m_q) * kept;
        node.m_f = btVector3(0, 0, 0);
      }
      continue;
    }
    btRigidBody& body = *participant.rigid;
    if (body.isStaticObject()) continue;
    btVector3 linear, angular;
    btTransformUtil::calculateVelocity(participant.predicted, body.getWorldTransform(), step, linear, angular);
    body.setLinearVelocity(body.getLinearVelocity() + linear);
    body.setAngularVelocity(body.getAngularVelocity() + angular);
    body.setInterpolationWorldTransform(body.getWorldTransform());
    body.updateInertiaTensor();
  }
}

}  // namespace example
