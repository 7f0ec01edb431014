// Bullet's soft bodies and rigid bodies, kept out of each other by tact: a solver for the place that Bullet leaves for
// one.
//
//   example::TactSolver solver({.thickness = 0.01});
//   btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &rigid_solver, &configuration, &solver);
//   ...
//   world.addSoftBody(body);            // as ever
//   solver.add(*body, tact::Surface::closed);
//   world.stepSimulation(1.0 / 60.0);   // as ever
//
// Contacts of soft bodies with each other, with themselves and with rigid bodies are then tact's. Those of two rigid
// bodies, and springs, volumes, poses and anchors stay Bullet's.
#pragma once

#include <BulletSoftBody/btDefaultSoftBodySolver.h>
#include <BulletSoftBody/btSoftBody.h>
#include <tact/tact.h>

#include <vector>

#include "mesh.h"

namespace example {

struct TactSolverSettings {
  double thickness = 0.01;  // how near two surfaces may come, metres
  double friction = 0.5;    // Coulomb's coefficient
  // Nodes lighter than this, kg, count as so heavy in contacts. A cloth of grams between bodies of kilograms would
  // hand on so little in an iteration that it takes thousands of them.
  double lightest = 0.005;
  int iterations = 10;  // of springs and contacts in a step
};

class TactSolver : public btDefaultSoftBodySolver {
 public:
  explicit TactSolver(const TactSolverSettings& settings);

  // Bodies must stay alive as long as the solver. A sheet is held against itself, too.
  void add(btSoftBody& body, tact::Surface surface);
  // The mesh of the body's shape, in the coordinates of the body.
  void add(btRigidBody& body, const Mesh& mesh);

  // What tact saw in the last step; null before the first.
  const tact::Report* report() const { return report_; }

  // Called by Bullet: before the rigid bodies move, and after.
  void optimize(btAlignedObjectArray<btSoftBody*>& bodies, bool force_update) override;
  void solveConstraints(btScalar step) override;
  // Bullet's own contacts of soft bodies: not wanted.
  void processCollision(btSoftBody*, const btCollisionObjectWrapper*) override {}
  void processCollision(btSoftBody*, btSoftBody*) override {}

 private:
  // A body that both engines know.
  struct Participant {
    tact::BodyId id;
    btSoftBody* soft = nullptr;  // one of the two is null
    btRigidBody* rigid = nullptr;
    Eigen::Matrix3Xd local = {};                         // of a rigid body: its vertices, in the body's coordinates
    btTransform before = btTransform::getIdentity();     // of a rigid body: where it was when the step began
    btTransform predicted = btTransform::getIdentity();  // and where Bullet has moved it
  };
  struct Side;

  void find_contacts();
  double longest_way(const Participant& participant) const;
  void keep_apart(const tact::ContactPoint& point, Participant& a, Participant& b) const;
  void end_step(double step);

  TactSolverSettings settings_;
  tact::World world_;
  std::vector<Participant> participants_;
  const tact::Report* report_ = nullptr;
};

}  // namespace example
