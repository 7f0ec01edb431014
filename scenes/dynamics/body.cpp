#include "scenes/dynamics/body.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "engine/base/box.h"

namespace tact::scenes {
namespace {

double distance(const Mesh& mesh, int a, int b) { return norm(mesh.positions[b] - mesh.positions[a]); }

// Twice the area of the facet along its normal.
Vec3 area_normal(const std::vector<Vec3>& positions, const Eigen::Matrix3Xi& facets, Eigen::Index facet) {
  const Vec3 a = positions[facets(0, facet)];
  return cross(positions[facets(1, facet)] - a, positions[facets(2, facet)] - a);
}

int opposite_corner(const Eigen::Matrix3Xi& facets, int facet, const Edge& edge) {
  for (int k = 0; k < 3; ++k) {
    if (facets(k, facet) != edge.from && facets(k, facet) != edge.to) return facets(k, facet);
  }
  return edge.from;
}

std::vector<Spring> edge_springs(const Mesh& mesh, std::span<const Edge> edges, double stiffness) {
  std::vector<Spring> springs;
  for (const Edge& edge : edges) {
    springs.push_back({edge.from, edge.to, distance(mesh, edge.from, edge.to), 1.0 / stiffness});
  }
  return springs;
}

void add_bending_springs(const Mesh& mesh, std::span<const Edge> edges, double stiffness,
                         std::vector<Spring>& springs) {
  for (const Edge& edge : edges) {
    if (edge.other_facet < 0) continue;
    const int a = opposite_corner(mesh.facets, edge.facet, edge);
    const int b = opposite_corner(mesh.facets, edge.other_facet, edge);
    if (a != b) springs.push_back({a, b, distance(mesh, a, b), 1.0 / stiffness});
  }
}

// How far the line from `p` along `direction` runs until it leaves through the facet; infinity if it does not.
double way_out(const Mesh& mesh, Eigen::Index facet, Vec3 p, Vec3 direction) {
  const auto corner = [&](int k) { return mesh.positions[mesh.facets(k, facet)] - p; };
  const Vec3 a = corner(0), b = corner(1), c = corner(2);
  const double u = dot(direction, cross(b, c));
  const double v = dot(direction, cross(c, a));
  const double w = dot(direction, cross(a, b));
  const double sum = u + v + w;
  if (!(u >= 0.0 && v >= 0.0 && w >= 0.0 && sum > 0.0)) return std::numeric_limits<double>::infinity();
  return (u * dot(a, direction) + v * dot(b, direction) + w * dot(c, direction)) / sum;
}

// The corner, nearest to where the line inwards from `vertex` leaves the body, of the facet where it does; -1 if it is
// inside out there.
int opposite_vertex(const Mesh& mesh, int vertex, Vec3 inwards) {
  const Vec3 p = mesh.positions[vertex];
  double shortest = std::numeric_limits<double>::infinity();
  Eigen::Index hit = -1;
  for (Eigen::Index f = 0; f < mesh.facets.cols(); ++f) {
    if ((mesh.facets.col(f).array() == vertex).any()) continue;
    const double way = way_out(mesh, f, p, inwards);
    if (way > 0.0 && way < shortest) shortest = way, hit = f;
  }
  if (hit < 0) return -1;
  const Vec3 end = p + shortest * inwards;
  const auto distance = [&](int k) { return norm(mesh.positions[mesh.facets(k, hit)] - end); };
  int nearest = 0;
  for (int k = 1; k < 3; ++k) {
    if (distance(k) < distance(nearest)) nearest = k;
  }
  return mesh.facets(nearest, hit);
}

void add_struts(const Mesh& mesh, double stiffness, std::vector<Spring>& springs) {
  std::vector<Vec3> normals(mesh.positions.size());
  for (Eigen::Index f = 0; f < mesh.facets.cols(); ++f) {
    for (int k = 0; k < 3; ++k) {
      Vec3& sum = normals[mesh.facets(k, f)];
      sum = sum + area_normal(mesh.positions, mesh.facets, f);
    }
  }
  for (int vertex = 0; vertex < static_cast<int>(mesh.positions.size()); ++vertex) {
    const Vec3 normal = normals[vertex];
    if (!(norm(normal) > 0.0)) continue;
    const int other = opposite_vertex(mesh, vertex, -normalized(normal));
    if (other >= 0) springs.push_back({vertex, other, distance(mesh, vertex, other), 1.0 / stiffness});
  }
}

Body make_body(std::string name, const Mesh& mesh) {
  Body body;
  body.name = std::move(name);
  body.facets = mesh.facets;
  body.surface_edges = edges_of(mesh.facets);
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
    for (int k = 0; k < 3; ++k) masses[mesh.facets(k, f)] += third;
  }
  std::transform(masses.begin(), masses.end(), body.inverse_masses.begin(),
                 [](double mass) { return mass > 0.0 ? 1.0 / mass : 0.0; });
  std::vector<Spring> springs = edge_springs(mesh, body.surface_edges, material.stretch_stiffness);
  add_bending_springs(mesh, body.surface_edges, material.bend_stiffness, springs);
  body.springs = Springs(springs, static_cast<int>(mesh.positions.size()));
  body.friction = material.friction;
  body.drag = material.drag;
  body.thickness = material.thickness;
  return body;
}

Body make_soft(std::string name, const Mesh& mesh, const SoftMaterial& material) {
  Body body = make_body(std::move(name), mesh);
  body.dynamic = true;
  const double mass = material.density * enclosed_volume(mesh.positions, mesh.facets);
  std::fill(body.inverse_masses.begin(), body.inverse_masses.end(), static_cast<double>(mesh.positions.size()) / mass);
  std::vector<Spring> springs = edge_springs(mesh, body.surface_edges, material.surface_stiffness);
  add_bending_springs(mesh, body.surface_edges, material.bend_stiffness, springs);
  add_struts(mesh, material.inner_stiffness, springs);
  body.springs = Springs(springs, static_cast<int>(mesh.positions.size()));
  body.volume.emplace(mesh, material.bulk_modulus);
  body.shape.emplace(mesh.positions, material.shape_frequency, material.shape_stretch);
  body.friction = material.friction;
  body.drag = material.drag;
  body.inner_damping = material.inner_damping;
  body.thickness = material.thickness;
  return body;
}

Body make_hard(std::string name, const Mesh& mesh, const SoftMaterial& material) {
  Body body = make_soft(std::move(name), mesh, material);
  body.rigid.emplace(body.positions, mass(body));
  return body;
}

Body make_ropes(std::string name, std::vector<Vec3> positions, const Eigen::Matrix2Xi& edges,
                const RopeMaterial& material) {
  Body body = make_body(std::move(name), {.positions = std::move(positions)});
  body.edges = edges;
  body.surface = Surface::sheet;
  body.dynamic = true;
  std::vector<double> masses(body.positions.size(), 0.0);
  std::vector<Spring> springs;
  for (const auto& edge : edges.colwise()) {
    const double length = norm(body.positions[edge[1]] - body.positions[edge[0]]);
    for (const int end : edge) masses[end] += 0.5 * material.density * length;
    springs.push_back({edge[0], edge[1], length, 1.0 / material.stretch_stiffness});
  }
  std::ranges::transform(masses, body.inverse_masses.begin(),
                         [](double mass) { return mass > 0.0 ? 1.0 / mass : 0.0; });
  body.springs = Springs(springs, static_cast<int>(body.positions.size()));
  body.friction = material.friction;
  body.drag = material.drag;
  body.thickness = material.thickness;
  return body;
}

Body make_grains(std::string name, std::vector<Vec3> positions, const GrainMaterial& material) {
  Body body = make_body(std::move(name), {.positions = std::move(positions)});
  body.surface = Surface::sheet;
  body.dynamic = body.self_contact = true;
  std::ranges::fill(body.inverse_masses, 1.0 / material.mass);
  for (std::size_t v = 0; v < body.positions.size(); ++v) body.grains.push_back(static_cast<int>(v));
  body.friction = material.friction;
  body.drag = material.drag;
  body.thickness = material.thickness;
  return body;
}

Body make_floor(std::string name, const Plane& plane, const RigidMaterial& material) {
  Body body = make_body(std::move(name), {});
  body.plane = plane;
  body.motion = Motion::fixed;
  body.size = std::numeric_limits<double>::infinity();
  body.friction = material.friction;
  body.thickness = material.thickness;
  return body;
}

Body make_rigid(std::string name, const Mesh& mesh, const RigidMaterial& material, Motion motion) {
  Body body = make_body(std::move(name), mesh);
  body.motion = motion;
  body.friction = material.friction;
  body.thickness = material.thickness;
  return body;
}

double kinetic_energy(const Body& body) {
  if (body.rigid) return body.rigid->kinetic_energy();
  double sum = 0.0;
  for (std::size_t i = 0; i < body.velocities.size(); ++i) {
    if (body.inverse_masses[i] > 0.0) sum += 0.5 * norm_squared(body.velocities[i]) / body.inverse_masses[i];
  }
  return sum;
}

double mass(const Body& body) {
  double sum = 0.0;
  for (const double inverse : body.inverse_masses) sum += inverse > 0.0 ? 1.0 / inverse : 0.0;
  return sum;
}

}  // namespace tact::scenes
