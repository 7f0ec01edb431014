#include "tests/support/oracles/query_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/box.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {

namespace {

using base::Box;

Box box_around(const Triangle& t) {
  Box box;
  for (const Vec3& p : t) box = extended(box, p);
  return box;
}

Triangle some_facet(const Mesh& mesh, Random& random) { return facet_at(mesh, random.below(mesh.facet_count())); }

// From 1e-17 to 1e-3.
double tiny(Random& random) { return std::pow(10.0, random.uniform(-17.0, -3.0)); }

}  // namespace

Triangle facet_at(const Mesh& mesh, int f) {
  return {mesh.position(mesh.facets(0, f)), mesh.position(mesh.facets(1, f)), mesh.position(mesh.facets(2, f))};
}

std::vector<Mesh> meshes_to_query() {
  return {blob(2, 1.0, 0.3, 1),
          torus(16, 10, 1.0, 0.4),
          gridded_box({-1, -1, -1}, {1, 1, 1}, 4),
          organ(2),
          soup(200, 2.0, 3),
          lattice_soup(150, 3, 5),
          needles(80, 1e4, 7),
          sheet(12, 12, 2.0, 2.0)};
}

Ray random_ray(const Mesh& mesh, Random& random) {
  const auto any = [&] { return 2.5 * random.in_cube(1.0); };
  const int kind = random.below(5);
  if (kind == 0) return {vector_of(any()), vector_of(any())};
  if (kind == 1) {
    Vec3 p{0.5 * random.below(9) - 2.0, 0.5 * random.below(9) - 2.0, 0.5 * random.below(9) - 2.0}, q = p;
    q[random.below(3)] = 3.0;
    return {vector_of(p), vector_of(q)};
  }
  const Triangle t = facet_at(mesh, random.below(mesh.facet_count()));
  if (kind == 4) {
    const double s = random.uniform(), u = random.uniform();
    return {vector_of(t[0] + 3.0 * (s * (t[1] - t[0]) + (s - 1.0) * (t[2] - t[0]))),
            vector_of(t[0] + 2.0 * ((u - 1.0) * (t[1] - t[0]) + u * (t[2] - t[0])))};
  }
  const Vec3 target = kind == 2 ? t[0] : 0.5 * (t[0] + t[1]), from = any();
  return {vector_of(from), vector_of(target + (target - from))};
}

Ray hard_ray(const Mesh& mesh, Random& random) {
  const Triangle t = some_facet(mesh, random);
  const Vec3 far = 2.5 * random.in_cube(1.0);
  switch (random.below(8)) {
    case 0: return {vector_of(far), vector_of(t[0])};
    case 1: return {vector_of(t[0]), vector_of(t[1])};
    case 2: {  // along an axis through a vertex, or the middle of an edge
      Vec3 p = random.chance(0.5) ? t[0] : 0.5 * (t[0] + t[1]), q = p;
      const int axis = random.below(3);
      p[axis] = -3.0, q[axis] = 3.0;
      return {vector_of(p), vector_of(q)};
    }
    case 3: {  // through a point of an edge or the facet, nearly along it
      const double s = random.uniform(), u = random.chance(0.5) ? 0.0 : random.uniform(0.0, 1.0 - s);
      const Vec3 at = t[0] + s * (t[1] - t[0]) + u * (t[2] - t[0]);
      const Vec3 way = random.uniform(-1.0, 1.0) * (t[1] - t[0]) + random.uniform(-1.0, 1.0) * (t[2] - t[0]);
      const Vec3 off = tiny(random) * random.in_cube(1.0);
      return {vector_of(at - 2.0 * way - off), vector_of(at + 3.0 * way + off)};
    }
    case 4: {  // a point
      const Vec3 p = random.chance(0.5) ? t[0] : 0.5 * t[0] + 0.5 * t[1];
      return {vector_of(p), vector_of(p)};
    }
    default: return random_ray(mesh, random);
  }
}

Vec3 hard_point(const Mesh& mesh, Random& random) {
  const Triangle t = some_facet(mesh, random);
  const double s = random.uniform(), u = random.chance(0.5) ? 0.0 : random.uniform(0.0, 1.0 - s);
  const Vec3 on = t[0] + s * (t[1] - t[0]) + u * (t[2] - t[0]);
  switch (random.below(6)) {
    case 0: return t[0];
    case 1: return on;
    case 2: return on + tiny(random) * random.in_cube(1.0);
    case 3: return 100.0 * random.in_cube(1.0);
    default: return 1.5 * random.in_cube(1.0);
  }
}

BoxQuery hard_box(const Mesh& mesh, Random& random) {
  const auto on_grid = [&] { return 0.5 * random.below(6) - 1.5; };
  const Vec3 corner = some_facet(mesh, random)[0];
  const Vec3 edge{random.uniform(), random.uniform(), random.uniform()};
  Vec3 lower = 2.0 * random.in_cube(1.0), upper = lower + edge;
  switch (random.below(5)) {
    case 0:
      lower = {on_grid(), on_grid(), on_grid()};
      upper = lower + Vec3{0.5, 0.5, 0.5};
      break;
    case 1: upper = (lower = corner) + edge; break;
    case 2: lower = (upper = corner) - edge; break;
    case 3: upper[random.below(3)] = lower[random.below(3)] = corner[random.below(3)]; break;
    default: break;
  }
  for (int axis = 0; axis < 3; ++axis) upper[axis] = std::max(lower[axis], upper[axis]);
  if (random.chance(0.1)) lower = upper = corner;
  return {.lower = vector_of(lower), .upper = vector_of(upper)};
}

// Boxes that do not meet hold nothing that does: comparisons of doubles, which are exact.
std::vector<int> hit_facets(const Mesh& mesh, const Ray& ray) {
  const Vec3 from = point_of(ray.from), to = point_of(ray.to);
  const Box box = extended({from, from}, to);
  std::vector<int> hit;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Triangle t = facet_at(mesh, f);
    if (overlaps(box, box_around(t)) && cgal_meet({from, to, to}, t)) hit.push_back(f);
  }
  return hit;
}

std::vector<int> facets_in(const Mesh& mesh, const BoxQuery& query) {
  const Box asked{point_of(query.lower), point_of(query.upper)};
  const Mesh solid = box(asked.lower, asked.upper);
  std::vector<int> found;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Triangle t = facet_at(mesh, f);
    if (!overlaps(asked, box_around(t))) continue;
    bool meets = std::ranges::any_of(t, [&](const Vec3& p) { return contains(asked, p); });
    for (int k = 0; k < solid.facet_count() && !meets; ++k) meets = cgal_meet(t, facet_at(solid, k));
    if (meets) found.push_back(f);
  }
  return found;
}

long double distance_by_brute_force(const Mesh& mesh, Vec3 p) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  long double least = std::numeric_limits<long double>::infinity();
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Triangle t = facet_at(mesh, f);
    Vector c[3];
    for (std::size_t k = 0; k < 3; ++k) c[k] = vector_of(t[k]).cast<long double>() - vector_of(p).cast<long double>();
    for (int k = 0; k < 3; ++k) {
      const Vector side = c[(k + 1) % 3] - c[k];
      const long double length = side.squaredNorm();
      const long double s = length > 0 ? std::clamp(-c[k].dot(side) / length, 0.0L, 1.0L) : 0.0L;
      least = std::min(least, (c[k] + s * side).norm());
    }
    const Vector normal = (c[1] - c[0]).cross(c[2] - c[0]);
    if (!(normal.squaredNorm() > 0)) continue;
    bool inside = true;
    for (int k = 0; k < 3; ++k) inside = inside && c[k].cross(c[(k + 1) % 3]).dot(normal) >= 0;
    if (inside) least = std::min(least, std::abs(c[0].dot(normal)) / normal.norm());
  }
  return least;
}

bool is_inside(const Mesh& mesh, Vec3 p, Random& random) {
  if (!hit_facets(mesh, {vector_of(p), vector_of(p)}).empty()) return true;
  return hit_facets(mesh, {vector_of(p), vector_of(p + 500.0 * random.direction())}).size() % 2 == 1;
}

}  // namespace tact::tests
