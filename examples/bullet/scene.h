// The scene: three soft cubes on the ground, a thin cloth over them, and a rigid box on top.
#pragma once

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <string>
#include <vector>

#include "mesh.h"
#include "tact_solver.h"

namespace example {

// Who finds the contacts of soft bodies.
enum class Contacts {
  bullet_vertices,  // Bullet: vertices against faces (fCollision::VF_SS)
  bullet_clusters,  // Bullet: convex clusters (fCollision::CL_SS)
  tact,
};

inline constexpr double kStep = 1.0 / 240.0;  // seconds
inline constexpr double kGravity = 9.81;      // metres per second squared, along -z
inline constexpr double kThickness = 0.01;    // between two surfaces, metres: twice Bullet's collision margin
inline constexpr double kCubeSide = 0.3;      // metres
inline constexpr double kBoxSide = 0.2;       // metres
inline constexpr int kCubes = 3;

struct SceneBody {
  std::string name;
  btSoftBody* soft = nullptr;  // one of the two is null
  btRigidBody* rigid = nullptr;
  Mesh mesh;  // of a rigid body: in its coordinates. Of a soft one: as it was made
  bool closed = true;
};

class Scene {
 public:
  explicit Scene(Contacts contacts);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void step() { world_.stepSimulation(kStep, 0); }
  const std::vector<SceneBody>& bodies() const { return bodies_; }
  // Where the vertices of a body are now, 3 x V, metres.
  Eigen::Matrix3Xd positions(const SceneBody& body) const;

 private:
  void add_soft(const std::string& name, const Mesh& mesh, const btVector3& at, double mass, bool closed);
  void add_rigid(const std::string& name, const Eigen::Vector3d& size, const btVector3& at, double mass);
  void stiffen(btSoftBody& body, bool closed) const;
  void choose_contacts(btSoftBody& body, bool closed) const;

  Contacts contacts_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver rigid_solver_;
  btDefaultSoftBodySolver bullet_solver_;
  TactSolver tact_solver_{{.thickness = kThickness}};
  btSoftRigidDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<SceneBody> bodies_;
};

}  // namespace example
