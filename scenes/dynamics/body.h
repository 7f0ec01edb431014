// A body of the simulation: vertices with mass, and what holds them together.
#pragma once

#include <tact/body.h>

#include <optional>
#include <string>
#include <vector>

#include "scenes/dynamics/edges.h"
#include "scenes/dynamics/mesh.h"
#include "scenes/dynamics/rigid_motion.h"
#include "scenes/dynamics/shape.h"
#include "scenes/dynamics/springs.h"

namespace tact::scenes {

// A sheet that bends and hardly stretches.
struct ClothMaterial {
  double density = 0.25;              // kilograms a square metre
  double stretch_stiffness = 2000.0;  // of each edge, newtons a metre
  double bend_stiffness = 0.5;        // of each pair of facets that share an edge, newtons a metre
  double friction = 0.4;
  double drag = 0.4;         // share of the velocity lost in a second
  double thickness = 0.004;  // metres, see Body::thickness
};

// A closed body that can be squashed and springs back.
struct SoftMaterial {
  double density = 150.0;            // kilograms a cubic metre
  double surface_stiffness = 800.0;  // of each edge, newtons a metre
  double bend_stiffness = 300.0;     // of each pair of facets that share an edge, newtons a metre
  double inner_stiffness = 800.0;    // of the strut from each vertex to the other side, newtons a metre
  double bulk_modulus = 60000.0;     // pascals
  double shape_frequency = 8.0;      // hertz, see ShapeKeeper
  double shape_stretch = 0.4;        // see ShapeKeeper
  double friction = 0.5;
  double drag = 0.1;           // share of the velocity lost in a second
  double inner_damping = 6.0;  // share of the velocity against the body's own rigid motion lost in a second
  double thickness = 0.003;    // metres, see Body::thickness
};

// A body that is as stiff as its script says: it moves as it is told, or not at all.
struct RigidMaterial {
  double friction = 0.5;
  double thickness = 0.003;  // metres, see Body::thickness
};

// Ropes that hardly stretch.
struct RopeMaterial {
  double density = 0.05;              // kilograms a metre
  double stretch_stiffness = 4000.0;  // of each edge, newtons a metre
  double friction = 0.6;
  double drag = 1.0;         // share of the velocity lost in a second
  double thickness = 0.004;  // metres, see Body::thickness: half of the rope's
};

// Balls that do not turn, a body of them all.
struct GrainMaterial {
  double mass = 0.02;  // kilograms
  double friction = 0.6;
  double drag = 1.0;        // share of the velocity lost in a second
  double thickness = 0.03;  // metres, see Body::thickness: the radius of a grain
};

struct Body {
  std::string name;
  Eigen::Matrix3Xi facets{3, 0};
  Eigen::Matrix2Xi edges{2, 0};  // ropes
  std::vector<int> grains;       // vertices that stand alone
  std::optional<Plane> plane;    // a floor, which has no vertices and is fixed
  // Once a script has changed the facets: of each vertex the one that it was at the last detection, or -1. Empty else.
  std::vector<int> vertex_map;
  std::vector<Edge> surface_edges;  // those of the facets
  Surface surface = Surface::closed;
  Motion motion = Motion::deformable;

  std::vector<Vec3> positions;         // metres
  std::vector<Vec3> velocities;        // metres a second
  std::vector<double> inverse_masses;  // 1 / kilograms; 0: no force moves this vertex

  Springs springs;
  std::optional<VolumeKeeper> volume;
  std::optional<ShapeKeeper> shape;
  std::optional<RigidMotion> rigid;  // of a body that forces move as a whole; springs and keepers then rest
  double friction = 0.0;             // of a contact: the geometric mean of both bodies'
  double drag = 0.0;                 // 1 / seconds
  double inner_damping = 0.0;        // 1 / seconds
  double weight = 1.0;               // gravity times this
  // Half of the thickness of its surface, metres: surfaces stay apart by the sum of two.
  double thickness = 0.0;
  bool self_contact = false;
  double size = 0.0;     // length of the diagonal of its box at rest, metres
  bool dynamic = false;  // do forces move it? Otherwise its inverse masses are all 0
  bool asleep = false;   // it rests, and nothing is done for it; a script may wake it

  bool movable() const { return dynamic && !asleep; }
};

// Every facet that shares an edge with another gets a spring across it. The sheet's shape is that at rest.
Body make_cloth(std::string name, const Mesh& mesh, const ClothMaterial& material);
// A closed body whose shape is that at rest. Its facets must enclose a positive volume. Springs along and across its
// edges stand for the surface, struts through it for what is inside, which keep thin parts thick.
Body make_soft(std::string name, const Mesh& mesh, const SoftMaterial& material);
// The same body as make_soft() makes it, but rigid: of the material, density, friction, drag and thickness count. (The
// rest does where impacts move its vertices one by one: see DynamicsSettings::continuous.)
Body make_hard(std::string name, const Mesh& mesh, const SoftMaterial& material);
// Ropes along edges, whose lengths are those at rest.
Body make_ropes(std::string name, std::vector<Vec3> positions, const Eigen::Matrix2Xi& edges,
                const RopeMaterial& material);
Body make_grains(std::string name, std::vector<Vec3> positions, const GrainMaterial& material);
// All of space below a plane.
Body make_floor(std::string name, const Plane& plane, const RigidMaterial& material);
// A body that only a script moves, or, if it is fixed, nobody.
Body make_rigid(std::string name, const Mesh& mesh, const RigidMaterial& material, Motion motion);

// Joules.
double kinetic_energy(const Body& body);
double mass(const Body& body);  // of what forces move, kilograms

}  // namespace tact::scenes
