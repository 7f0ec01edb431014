#include "scenes/dynamics/body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/box.h"

namespace tact::scenes {
namespace {

double distance(const Mesh& mesh, int a, int b) {
  return norm(mesh.positions[static_cast<std::size_t>(b)] - mesh.positions[static_cast<std::size_t>(a)]);
}

// Twice the area of the facet along its normal.
Vec3 area_normal(const std::vector<Vec3>& positions, const Eigen::Matrix3Xi& facets, Eigen::Index facet) {
  const Vec3 a = positions[static_cast<std::size_t>(facets(0, facet))];
  return cross(positions[static_cast<std::size_t>(facets(1, facet))] - a,
               positions[static_cast<std::size_t>(facets(2, facet))] - a);
}

int opposite_corner(const Eigen::Matrix3Xi& facets, int facet, const Edge& edge) {
  for (int k = 0; k < 3; ++k) {
    if (facets(k, facet) != edge.from && facets(k, facet) != edge.to) return facets(k, facet);
  }
  return edge.from;
}

std::vector<Spring> edge_springs(const Mesh& mesh, const Topology& topology, double stiffness) {
  std::vector<Spring> springs;
  for (const Edge& edge : topology.edges()) {
    springs.push_back({edge.from, edge.to, distance(mesh, edge.from, edge.to), 1.0 / stiffness});
  }
  return springs;
}

void add_bending_springs(const Mesh& mesh, const Topology& topology, double stiffness, std::vector<Spring>& springs) {
  for (const Edge& edge : topology.edges()) {
    if (edge.other_facet < 0) continue;
    const int a = opposite_corner(mesh.facets, edge.facet, edge);
    const int b = opposite_corner(mesh.facets, edge.other_facet, edge);
    if (a != b) springs.push_back({a, b, distance(mesh, a, b), 1.0 / stiffness});
  }
}

Body make_body(std::string name, const Mesh& mesh) {
  Body body;
  body.name = std::move(name);
  body.facets = mesh.facets;
  body.topology = Topology(mesh.facets, static_cast<int>(mesh.positions.size()));
  body.positions = mesh.positions;
  body.velocities.assign(mesh.positions.size(), {});
  body.inverse_masses.assign(mesh.positions.size(), 0.0);
  base::Box box;
  for (const Vec3& p : mesh.positions) box = base::extended(box, p);
  body.size = mesh.positions.empty() ? 0.0 : norm(box.upper - box.lower);
  return body;
}

}  // namespace

Body make_cloth(std::string name, const Mesh& mesh, const ClothMaterial& material) {
  Body body = make_body(std::move(name), mesh);
  body.surface = Surface::sheet;
  body.dynamic = true;
  std::vector<double> masses(mesh.positions.size(), 0.0);
  for (Eigen::Index f = 0; f < mesh.facets.cols(); ++f) {
    const double third = material.density * norm(area_normal(mesh.positions, mesh.facets, f)) / 6.0;
    for (int k = 0; k < 3; ++k) masses[static_cast<std::size_t>(mesh.facets(k, f))] += third;
  }
  std::transform(masses.begin(), masses.end(), body.inverse_masses.begin(),
                 [](double mass) { return mass > 0.0 ? 1.0 / mass : 0.0; });
  std::vector<Spring> springs = edge_springs(mesh, body.topology, material.stretch_stiffness);
  add_bending_springs(mesh, body.topology, material.bend_stiffness, springs);
  body.springs = Springs(springs, static_cast<int>(mesh.positions.size()));
  body.friction = material.friction;
  body.drag = material.drag;
  return body;
}

Body make_soft(std::string name, const Mesh& mesh, const SoftMaterial& material) {
  Body body = make_body(std::move(name), mesh);
  body.dynamic = true;
  const double mass = material.density * enclosed_volume(mesh.positions, mesh.facets);
  std::fill(body.inverse_masses.begin(), body.inverse_masses.end(), static_cast<double>(mesh.positions.size()) / mass);
  body.springs =
      Springs(edge_springs(mesh, body.topology, material.surface_stiffness), static_cast<int>(mesh.positions.size()));
  body.volume.emplace(mesh, material.bulk_modulus);
  body.shape.emplace(mesh.positions, material.shape_frequency, material.shape_stretch);
  body.friction = material.friction;
  body.drag = material.drag;
  body.inner_damping = material.inner_damping;
  body.skin = material.skin;
  return body;
}

Body make_rigid(std::string name, const Mesh& mesh, const RigidMaterial& material, Motion motion) {
  Body body = make_body(std::move(name), mesh);
  body.motion = motion;
  body.friction = material.friction;
  body.skin = material.skin;
  return body;
}

double kinetic_energy(const Body& body) {
  double sum = 0.0;
  for (std::size_t i = 0; i < body.velocities.size(); ++i) {
    if (body.inverse_masses[i] > 0.0) sum += 0.5 * norm_squared(body.velocities[i]) / body.inverse_masses[i];
  }
  return sum;
}

void move_out(const Body& body, std::vector<Vec3>& positions) {
  positions.assign(body.positions.size(), {});
  for (Eigen::Index f = 0; f < body.facets.cols(); ++f) {
    const Vec3 normal = area_normal(body.positions, body.facets, f);
    for (int k = 0; k < 3; ++k) {
      Vec3& sum = positions[static_cast<std::size_t>(body.facets(k, f))];
      sum = sum + normal;
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double length = norm(positions[i]);
    const double scale = length > 0.0 ? body.skin / length : 0.0;
    positions[i] = body.positions[i] + scale * positions[i];
  }
}

}  // namespace tact::scenes
