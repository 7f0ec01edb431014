#include "tests/support/checks/parting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tact::tests {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

BodyDefinition body_with_margin(const Mesh& mesh, double margin) {
  return {.positions = mesh.positions, .facets = mesh.facets, .margin = margin};
}

// Where a line from p meets a facet, in units of `along`; NaN if it does not.
double place_on_line(const Mesh& mesh, int facet, Vec3 p, Vec3 along) {
  const Vec3 a = mesh.position(mesh.facets(0, facet)) - p, b = mesh.position(mesh.facets(1, facet)) - p,
             c = mesh.position(mesh.facets(2, facet)) - p;
  const double u = dot(along, cross(b, c)), v = dot(along, cross(c, a)), w = dot(along, cross(a, b));
  const double sum = u + v + w;
  if (sum == 0.0 || std::min({u / sum, v / sum, w / sum}) < -1e-12) return std::nan("");
  return (u / sum * dot(a, along) + v / sum * dot(b, along) + w / sum * dot(c, along)) / dot(along, along);
}

// Adds a direction, unless there is one along the same line: of grids most are.
void add_line(std::vector<Vec3>& directions, Vec3 direction) {
  if (!(norm(direction) > 1e-9)) return;
  direction = normalized(direction);
  const auto is_along = [&](const Vec3& one) { return norm_squared(cross(one, direction)) < 1e-24; };
  if (std::ranges::none_of(directions, is_along)) directions.push_back(direction);
}

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const double square = norm_squared(b - a);
  const double t = square > 0.0 ? std::clamp(dot(p - a, b - a) / square, 0.0, 1.0) : 0.0;
  return norm(p - a - t * (b - a));
}

}  // namespace

double reach_along(const Mesh& mesh, Vec3 n) {
  double most = -kFar;
  for (int v = 0; v < mesh.vertex_count(); ++v) most = std::max(most, dot(n, mesh.position(v)));
  return most;
}

Overlap least_overlap(const Mesh& a, const Mesh& b) {
  Overlap least{{}, kFar};
  const auto look_along = [&](Vec3 n) {
    if (!(norm(n) > 1e-9)) return;
    n = normalized(n);
    for (const Vec3 way : {n, -n}) {
      const double depth = reach_along(a, way) + reach_along(b, -way);
      if (depth < least.depth) least = {way, depth};
    }
  };
  std::vector<Vec3> normals, edges[2];
  for (const bool of_b : {false, true}) {
    const Mesh& mesh = of_b ? b : a;
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const Vec3 p = mesh.position(mesh.facets(0, f)), q = mesh.position(mesh.facets(1, f)),
                 r = mesh.position(mesh.facets(2, f));
      add_line(normals, cross(q - p, r - p));
      for (const Vec3 edge : {q - p, r - q, p - r}) add_line(edges[of_b], edge);
    }
  }
  for (const Vec3& normal : normals) look_along(normal);
  for (const Vec3& e : edges[0]) {
    for (const Vec3& f : edges[1]) look_along(cross(e, f));
  }
  return least;
}

Vec3 way_along_points(const Contact& contact) {
  Vec3 way;
  for (const ContactPoint& point : contact.points()) {
    const Vec3 n{point.normal.x(), point.normal.y(), point.normal.z()};
    const double gap = point.gap + dot(n, way);
    if (point.gap < 0.0 && gap < 0.0) way = way + (1e-9 - gap) * n;
  }
  return way;
}

Parting part_by_points(const Mesh& a, const Mesh& b, const PartingInput& input) {
  World world({.threads = 1, .outputs = {.points = true}});
  const BodyId first = world.add_body(body_with_margin(a, input.margin)),
               second = world.add_body(body_with_margin(translated(b, -input.came_by), input.margin));
  for (int step = 1; step <= input.steps; ++step) {
    world.detect();
    const double left = 1.0 - static_cast<double>(step) / input.steps;
    world.set_positions(second, translated(b, -left * input.came_by).positions);
  }
  Parting parting;
  Vec3 way;
  for (; parting.passes < input.most_passes; ++parting.passes) {
    const Contact* contact = world.detect().find_contact(first, second);
    if (contact == nullptr || contact->facet_pairs().empty()) break;
    const Vec3 next = way_along_points(*contact);
    parting.without_point += next == Vec3{} ? 1 : 0;
    way = way + next;
    world.set_positions(second, translated(b, way).positions);
  }
  parting.way = norm(way);
  return parting;
}

Thrown throw_at(const Mesh& a, Mesh b, Vec3 step, int steps, double margin) {
  World world({.threads = 1, .outputs = {.points = true}});
  const BodyId first = world.add_body(body_with_margin(a, margin)),
               second = world.add_body(body_with_margin(b, margin));
  Thrown thrown;
  Vec3 side;  // the axis that separated them last
  int crossing = 0;
  bool has_crossed = false;
  const auto look = [&] {
    const Overlap overlap = least_overlap(a, b);
    if (overlap.depth > 0.0) return;
    if (has_crossed && (reach_along(b, side) < -reach_along(a, -side) || dot(side, overlap.direction) < 0.0))
      thrown.other_side = true;
    side = overlap.direction;
    has_crossed = false;
  };
  for (int k = 0; k < steps; ++k) {
    look();
    b = translated(b, step);
    world.set_positions(second, b.positions);
    const Contact* contact = world.detect().find_contact(first, second);
    const bool crosses = contact != nullptr && !contact->facet_pairs().empty();
    crossing = crosses ? crossing + 1 : 0;
    thrown.met = thrown.met || crosses;
    thrown.longest_crossing = std::max(thrown.longest_crossing, crossing);
    if (!crosses) continue;
    has_crossed = true;
    b = translated(b, way_along_points(*contact));
    for (const ContactPoint& point : contact->points()) {
      const Vec3 n{point.normal.x(), point.normal.y(), point.normal.z()};
      if (point.gap < 0.0 && dot(step, n) < 0.0) step = step - dot(step, n) * n;
    }
  }
  look();
  return thrown;
}

double thickness_through(const Mesh& mesh, Vec3 point, Vec3 along) {
  double before = kFar, after = kFar;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const double place = place_on_line(mesh, f, point, along);
    if (place >= 0.0) after = std::min(after, place);
    if (place <= 0.0) before = std::min(before, -place);
  }
  return (before + after) * norm(along);
}

double distance_to(const Mesh& mesh, Vec3 point) {
  double least = kFar;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Vec3 a = mesh.position(mesh.facets(0, f)), b = mesh.position(mesh.facets(1, f)),
               c = mesh.position(mesh.facets(2, f));
    least = std::min(
        {least, distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
    const Vec3 normal = cross(b - a, c - a);
    if (normal == Vec3{}) continue;
    const double place = place_on_line(mesh, f, point, normal);
    if (!std::isnan(place)) least = std::min(least, std::abs(place) * norm(normal));
  }
  return least;
}

}  // namespace tact::tests
