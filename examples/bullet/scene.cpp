#include "scene.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

namespace example {

Scene::Scene(Contacts contacts)
    : contacts_(contacts),
      world_(&dispatcher_, &broadphase_, &rigid_solver_, &configuration_,
             contacts == Contacts::tact ? &tact_solver_ : &bullet_solver_) {
  const btVector3 gravity(0, 0, -kGravity);
  world_.setGravity(gravity);
  world_.getWorldInfo().m_gravity = gravity;
  add_rigid("ground", {3.0, 3.0, 0.2}, btVector3(0, 0, -0.1), 0.0);
  const Mesh cube = box(Eigen::Vector3d::Constant(kCubeSide), 8);
  for (int i = 0; i < kCubes; ++i) {
    add_soft("cube " + std::to_string(i + 1), cube, btVector3(0.02 * i, 0.01 * i, 0.17 + 0.34 * i), 2.0, true);
  }
  add_soft("cloth", cloth(1.1, 40), btVector3(0, 0, 1.15), 0.3, false);
  add_rigid("box", Eigen::Vector3d::Constant(kBoxSide), btVector3(0.02, 0.01, 1.45), 1.0);
}

Scene::~Scene() {
  for (SceneBody& body : bodies_) {
    if (body.soft != nullptr) world_.removeSoftBody(body.soft);
    if (body.rigid != nullptr) world_.removeRigidBody(body.rigid);
    delete body.soft;
    delete body.rigid;
  }
}

Eigen::Matrix3Xd Scene::positions(const SceneBody& body) const {
  Eigen::Matrix3Xd positions(3, body.mesh.positions.cols());
  for (int i = 0; i < positions.cols(); ++i) {
    const Eigen::Vector3d local = body.mesh.positions.col(i);
    const btVector3 x = body.soft != nullptr
                            ? body.soft->m_nodes[i].m_x
                            : body.rigid->getWorldTransform() * btVector3(local.x(), local.y(), local.z());
    positions.col(i) << x.x(), x.y(), x.z();
  }
  return positions;
}

void Scene::add_soft(const std::string& name, const Mesh& mesh, const btVector3& at, double mass, bool closed) {
  std::vector<btScalar> vertices(mesh.positions.data(), mesh.positions.data() + mesh.positions.size());
  // Its springs in the order of the mesh, not shuffled: every run is the same.
  btSoftBody* body = btSoftBodyHelpers::CreateFromTriMesh(world_.getWorldInfo(), vertices.data(), mesh.facets.data(),
                                                          static_cast<int>(mesh.facets.cols()), false);
  body->translate(at);
  body->getCollisionShape()->setMargin(kThickness / 2);
  body->setTotalMass(mass);
  stiffen(*body, closed);
  choose_contacts(*body, closed);
  world_.addSoftBody(body);
  bodies_.push_back({.name = name, .soft = body, .mesh = mesh, .closed = closed});
  if (contacts_ == Contacts::tact) tact_solver_.add(*body, closed ? tact::Surface::closed : tact::Surface::sheet);
}

void Scene::stiffen(btSoftBody& body, bool closed) const {
  body.m_materials[0]->m_kLST = closed ? 0.5 : 0.9;
  body.generateBendingConstraints(2, body.m_materials[0]);
  body.m_cfg.piterations = 10;
  body.m_cfg.kDP = 0.01;
  body.m_cfg.kDF = 0.5;
  if (closed) {
    body.m_cfg.kMT = 0.1;  // a cube keeps its shape
    body.setPose(false, true);
  }
  body.setActivationState(DISABLE_DEACTIVATION);
}

void Scene::choose_contacts(btSoftBody& body, bool closed) const {
  using Collision = btSoftBody::fCollision;
  switch (contacts_) {
    case Contacts::bullet_vertices: body.m_cfg.collisions = Collision::SDF_RS | Collision::VF_SS; break;
    case Contacts::bullet_clusters:
      body.m_cfg.collisions = Collision::CL_RS | Collision::CL_SS | (closed ? 0 : Collision::CL_SELF);
      body.generateClusters(closed ? 16 : 64);
      break;
    case Contacts::tact: body.m_cfg.collisions = 0; break;
  }
}

void Scene::add_rigid(const std::string& name, const Eigen::Vector3d& size, const btVector3& at, double mass) {
  shapes_.push_back(std::make_unique<btBoxShape>(btVector3(size.x(), size.y(), size.z()) / 2));
  btVector3 inertia(0, 0, 0);
  if (mass > 0.0) shapes_.back()->calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
  info.m_startWorldTransform.setOrigin(at);
  info.m_friction = 0.5;
  auto* body = new btRigidBody(info);
  body->setActivationState(DISABLE_DEACTIVATION);
  world_.addRigidBody(body);
  const Mesh mesh = box(size, 1);
  bodies_.push_back({.name = name, .rigid = body, .mesh = mesh});
  if (contacts_ == Contacts::tact) tact_solver_.add(*body, mesh);
}

}  // namespace example
