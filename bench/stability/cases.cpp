#include "bench/stability/cases.h"

#include <cmath>
#include <limits>

#include "bench/stability/shapes.h"

namespace tact::bench {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// Two bodies of ordinary size and shape that overlap, or nearly.
StabilityCase ordinary(StabilityRandom& random) {
  const Vector3d by = random.uniform(0.0, 1.4) * random.direction();
  switch (random.below(8)) {
    case 0: return {{{ball_shape(1)}, {moved(ball_shape(1), by)}}};
    case 1:
      return {{{box_shape({-1, -1, -1}, {1, 1, 1})},
               {moved(rotated(box_shape({-1, -1, -1}, {1, 1, 1}), random.rotation()), by)}}};
    case 2: return {{{box_shape({-1, -1, -1}, {1, 1, 1})}, {box_shape({-0.5, -0.75, 0.5}, {1.5, 0.25, 2.0})}}};
    case 3: return {{{stretched(sheet_shape(6), {3, 3, 1}), Surface::sheet}, {moved(ball_shape(1), 0.5 * by)}}};
    case 4:
      return {{{soup_shape(30, random), Surface::sheet}, {moved(soup_shape(30, random), 0.5 * by), Surface::sheet}}};
    case 5: return {{{lumpy_shape(2, 0.4, random)}, {moved(lumpy_shape(2, 0.4, random), by)}}};
    case 6: return {{{hull_shape(12, random)}, {moved(hull_shape(9, random), by)}}};
    default:
      return {{{rotated(sheet_shape(5), random.rotation()), Surface::sheet},
               {moved(rotated(sheet_shape(4), random.rotation()), 0.3 * by), Surface::sheet}}};
  }
}

void scale(StabilityCase& c, double factor) {
  for (StabilityBody& body : c.bodies) body.mesh.positions *= factor;
}

StabilityCase scaled(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  scale(c, std::pow(10.0, random.below(19) - 9));
  return c;
}

// Sizes of the two bodies up to 1e6 apart.
StabilityCase unequal_sizes(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  const double factor = std::pow(10.0, -1 - random.below(6));
  const Matrix3Xd& large = c.bodies[0].mesh.positions;
  const Vector3d at = large.col(random.below(static_cast<int>(large.cols())));
  c.bodies[1].mesh.positions = (factor * c.bodies[1].mesh.positions).colwise() + at;
  return c;
}

StabilityCase far_away(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  const Vector3d by = std::pow(10.0, random.below(9)) * random.direction();
  for (StabilityBody& body : c.bodies) body.mesh = moved(body.mesh, by);
  return c;
}

double large_aspect(StabilityRandom& random) { return std::pow(10.0, 3 + random.below(10)); }

StabilityCase needles(std::uint64_t seed) {
  StabilityRandom random(seed);
  const double aspect = large_aspect(random);
  const Mesh a = needle_shape(8, aspect, random);
  return {{{a, Surface::sheet}, {random.below(2) ? ball_shape(0) : needle_shape(8, aspect, random), Surface::sheet}}};
}

StabilityCase slivers(std::uint64_t seed) {
  StabilityRandom random(seed);
  const double aspect = large_aspect(random);
  const Mesh a = sliver_shape(8, aspect, random);
  return {{{a, Surface::sheet}, {random.below(2) ? ball_shape(0) : sliver_shape(8, aspect, random), Surface::sheet}}};
}

// A whole body drawn out to a rod or pressed to a plate.
StabilityCase slender_bodies(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  for (StabilityBody& body : c.bodies) {
    const double thin = 1.0 / large_aspect(random);
    body.mesh = stretched(body.mesh, {1.0, random.below(2) ? thin : 1.0, thin});
    body.mesh = rotated(body.mesh, random.rotation());
    if (random.below(3) == 0) break;
  }
  return c;
}

// Bodies in a plane, on a line, in a point, exactly; each against one of another kind.
StabilityBody degenerate_body(int kind, StabilityRandom& random) {
  const Vector3d at = 0.25 * Vector3d(random.below(3) - 1, random.below(3) - 1, random.below(3) - 1);
  switch (kind) {
    case 0: return {moved(sheet_shape(4), at), Surface::sheet};
    case 1: return {moved(stretched(ball_shape(0), {1, 1, 0}), at)};
    case 2: return {moved(stretched(box_shape({-1, -1, -1}, {1, 1, 1}), {1, 0, 0}), at)};
    case 3: return {moved(stretched(sheet_shape(3), {0, 2, 0}), at), Surface::sheet};
    case 4: return {moved(stretched(ball_shape(0), {0, 0, 0}), at)};
    case 5: return {triangle_shape(at, at, at), Surface::sheet};
    case 6: return {rotated(moved(sheet_shape(3), at), random.rotation()), Surface::sheet};
    default: return {moved(ball_shape(1), at)};
  }
}

StabilityCase flat_straight_point_like(std::uint64_t seed) {
  StabilityRandom random(seed);
  const int first = static_cast<int>(seed % 7), second = static_cast<int>(seed / 7 % 8);
  return {{degenerate_body(first, random), degenerate_body(second, random)}};
}

StabilityCase identical(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  c.bodies[1] = c.bodies[0];
  if (random.below(2)) c.bodies[1].mesh = turned_inside_out(c.bodies[1].mesh);
  c.hulls_overlap = true;
  return c;
}

// Boxes of whole or binary sizes, face on face: every contact is exactly coplanar. Some stacks stand at an angle.
StabilityCase stacked_boxes(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c;
  double z = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double x = 0.25 * random.below(4), y = 0.25 * random.below(4), top = z + 0.5 + 0.25 * random.below(4);
    c.bodies.push_back({box_shape({x, y, z}, {x + 1.0, y + 1.0, top})});
    z = top;
  }
  c.hulls_overlap = true;
  if (random.below(2)) {  // a quarter turn about a diagonal keeps coordinates exact
    for (StabilityBody& body : c.bodies) {
      Matrix3Xd& p = body.mesh.positions;
      const Matrix3Xd sum = p;
      p.row(0) = sum.row(0) + sum.row(1);
      p.row(1) = sum.row(1) - sum.row(0);
    }
  }
  return c;
}

StabilityCase nested(std::uint64_t seed) {
  StabilityRandom random(seed);
  const double inner = std::pow(10.0, -random.below(7));
  const Mesh shell = random.below(2) ? ball_shape(2) : box_shape({-1, -1, -1}, {1, 1, 1});
  const Mesh core = random.below(2) ? ball_shape(1) : box_shape({-1, -1, -1}, {1, 1, 1});
  const double room = 0.55 - 0.55 * inner;
  StabilityCase c{{{shell}, {moved(scaled(core, 0.5 * inner), random.in_cube(0.5 * room))}}};
  c.hulls_overlap = true;
  return c;
}

StabilityCase repeated_facets(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  for (StabilityBody& body : c.bodies) {
    Eigen::Matrix3Xi& f = body.mesh.facets;
    const Eigen::Index count = f.cols();
    f.conservativeResize(3, 2 * count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector3i copy = f.col(random.below(static_cast<int>(count)));
      f.col(count + i) = random.below(2) ? copy : Eigen::Vector3i(copy[2], copy[1], copy[0]);
    }
  }
  return c;
}

// The same point under two indices, in facets that repeat a corner and in ones that do not.
StabilityCase repeated_vertices(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  for (StabilityBody& body : c.bodies) {
    Mesh& mesh = body.mesh;
    const Eigen::Index count = mesh.positions.cols();
    mesh.positions.conservativeResize(3, 2 * count);
    mesh.positions.rightCols(count) = mesh.positions.leftCols(count);
    for (int& v : mesh.facets.reshaped()) {
      if (random.below(2)) v += static_cast<int>(count);
    }
    const int last = static_cast<int>(mesh.facets.cols()) - 1;
    mesh.facets(1, random.below(last + 1)) = mesh.facets(0, random.below(last + 1));
    mesh.facets.col(random.below(last + 1)).setConstant(mesh.facets(0, 0));
  }
  return c;
}

// Far vertices that no facet uses: they must not widen a hull or a box.
StabilityCase unused_vertices(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  for (StabilityBody& body : c.bodies) {
    Mesh spare;
    spare.positions.resize(3, 5);
    for (auto p : spare.positions.colwise()) p = std::pow(10.0, random.below(12)) * random.direction();
    body.mesh = joined(spare, body.mesh);
  }
  return c;
}

StabilityCase inside_out_bodies(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  c.bodies[0].mesh = turned_inside_out(c.bodies[0].mesh);
  if (random.below(2)) c.bodies[1].mesh = turned_inside_out(c.bodies[1].mesh);
  return c;
}

StabilityCase one_facet(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  const Vector3d p = random.in_cube(0.8), q = random.in_cube(0.8), r = random.in_cube(0.8);
  switch (random.below(4)) {
    case 0: c.bodies[0].mesh = triangle_shape(p, q, q); break;
    case 1: c.bodies[0].mesh = triangle_shape(p, p, p); break;
    default: c.bodies[0].mesh = triangle_shape(p, q, r);
  }
  if (random.below(2)) c.bodies[1].mesh = triangle_shape(r, random.in_cube(0.8), random.in_cube(0.8));
  return c;
}

StabilityCase no_facet(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  c.bodies.insert(c.bodies.begin(), StabilityBody{});
  c.bodies.push_back({{c.bodies[1].mesh.positions, Eigen::Matrix3Xi(3, 0)}});
  return c;
}

StabilityCase sudden_teleports(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  const std::vector<StabilityBody> home = c.bodies;
  for (int step = 0; step < 12; ++step) {
    std::vector<Matrix3Xd> moves(2);
    for (std::size_t i = 0; i < 2; ++i) {
      const Mesh& mesh = home[i].mesh;
      switch (random.below(4)) {
        case 0: break;
        case 1: moves[i] = mesh.positions; break;
        case 2: moves[i] = moved(rotated(mesh, random.rotation()), random.in_cube(0.7)).positions; break;
        default: moves[i] = moved(mesh, std::pow(10.0, random.below(7)) * random.direction()).positions;
      }
    }
    c.moves.push_back(std::move(moves));
  }
  return c;
}

StabilityCase vertices_that_swap(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  std::vector<Matrix3Xd> now{c.bodies[0].mesh.positions, c.bodies[1].mesh.positions};
  for (int step = 0; step < 10; ++step) {
    for (Matrix3Xd& p : now) {
      for (Eigen::Index swap = 0; swap <= p.cols() / 8; ++swap) {
        const int i = random.below(static_cast<int>(p.cols())), j = random.below(static_cast<int>(p.cols()));
        const Vector3d kept = p.col(i);
        p.col(i) = p.col(j);
        p.col(j) = kept;
      }
    }
    c.moves.push_back(now);
  }
  return c;
}

StabilityCase crumpled_to_noise(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  for (int step = 0; step < 3; ++step) {
    std::vector<Matrix3Xd> moves;
    for (const StabilityBody& body : c.bodies) {
      Matrix3Xd p = body.mesh.positions;
      for (auto q : p.colwise()) q = random.in_cube(1.0);
      moves.push_back(std::move(p));
    }
    c.moves.push_back(std::move(moves));
  }
  return c;
}

// A body that sinks into another, step by step, and comes out again.
StabilityCase slow_sinking(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  const Vector3d along = random.direction();
  const Matrix3Xd home = c.bodies[1].mesh.positions;
  for (int step = 0; step < 20; ++step) {
    c.moves.push_back({Matrix3Xd(3, 0), home.colwise() + 3.0 * std::cos(0.3 * step) * along});
  }
  return c;
}

// Every coordinate of the second body stands 0 to 2 units in the last place from the first's.
StabilityCase nearly_touching(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = stacked_boxes(seed);
  c.hulls_overlap.reset();
  for (StabilityBody& body : c.bodies) {
    for (double& x : body.mesh.positions.reshaped()) {
      const double towards =
          random.below(2) ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
      for (int ulp = random.below(3); ulp > 0; --ulp) x = std::nextafter(x, towards);
    }
  }
  return c;
}

// Embree drops boxes beyond 1.8e18, and floats end at 3.4e38. Bodies for which its trees are used are among the large
// rough ones.
StabilityCase beyond_float_boxes(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  if (random.below(2)) {
    const Mesh lump = lumpy_shape(4, 0.4, random);
    c = {{{lump}, {moved(lumpy_shape(4, 0.4, random), 0.7 * random.direction())}}};
  }
  constexpr int kExponents[] = {18, 19, 30, 38, 39, 60, 85};
  scale(c, std::pow(10.0, kExponents[random.below(7)]));
  return c;
}

StabilityCase below_float_numbers(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  constexpr int kExponents[] = {-30, -46, -90, -150, -200, -290, -305};
  scale(c, std::pow(10.0, kExponents[random.below(7)]));
  return c;
}

// Octahedra and random facets at whole numbers: corners on faces, edges and corners, exactly, at any direction.
StabilityCase whole_numbers(std::uint64_t seed) {
  StabilityRandom random(seed);
  const auto lattice_point = [&](int reach) {
    return Vector3d(random.below(2 * reach + 1) - reach, random.below(2 * reach + 1) - reach,
                    random.below(2 * reach + 1) - reach);
  };
  const auto body = [&]() -> StabilityBody {
    if (random.below(2)) {
      Mesh soup;
      for (int f = 0; f < 12; ++f)
        soup = joined(soup, triangle_shape(lattice_point(2), lattice_point(2), lattice_point(2)));
      return {soup, Surface::sheet};
    }
    Mesh octahedron;
    octahedron.positions.resize(3, 6);
    octahedron.positions << 2, -2, 0, 0, 0, 0, 0, 0, 2, -2, 0, 0, 0, 0, 0, 0, 2, -2;
    octahedron.facets.resize(3, 8);
    octahedron.facets << 0, 2, 1, 3, 2, 1, 3, 0, 2, 1, 3, 0, 0, 2, 1, 3, 4, 4, 4, 4, 5, 5, 5, 5;
    return {moved(octahedron, lattice_point(2))};
  };
  const StabilityBody a = body();
  return {{a, body()}};
}

// Several of these at once.
StabilityCase several_at_once(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = random.below(2) ? ordinary(random) : slender_bodies(seed);
  if (random.below(2)) c.bodies[1].mesh = joined(c.bodies[1].mesh, turned_inside_out(c.bodies[1].mesh));
  if (random.below(2)) c.bodies[0].mesh = joined(c.bodies[0].mesh, stretched(c.bodies[0].mesh, {1.0, 0.0, 1.0}));
  if (random.below(2)) {
    const double factor = std::pow(10.0, -random.below(9));
    c.bodies[0].mesh.positions *= factor;
  }
  if (random.below(2)) {
    const Vector3d by = std::pow(10.0, random.below(9)) * random.direction();
    for (StabilityBody& body : c.bodies) body.mesh = moved(body.mesh, by);
  }
  if (random.below(2)) scale(c, std::pow(10.0, random.below(19) - 9));
  return c;
}

// Rough spheres of 20480 facets, one in the other: so many pairs of clusters that a pair is shared among threads. Every
// fourth is of 81920 facets: so many clusters that trees find their pairs; every other of these is beyond float boxes.
StabilityCase large_rough_bodies(std::uint64_t seed) {
  StabilityRandom random(seed);
  const auto rough = [&](double radius) {
    Mesh mesh = ball_shape(seed % 4 == 0 ? 6 : 5);
    for (auto p : mesh.positions.colwise()) p *= radius + random.uniform(-0.2, 0.2);
    return mesh;
  };
  const Mesh inner = rough(0.95);
  StabilityCase c{{{rough(1.0)}, {inner}}};
  if (seed % 8 == 4) scale(c, 1e30);
  return c;
}

StabilityCase out_of_range(std::uint64_t seed) {
  StabilityRandom random(seed);
  StabilityCase c = ordinary(random);
  Matrix3Xd& last = c.bodies.back().mesh.positions;
  constexpr double kValues[] = {2.1e90, -1e200, 1e308, std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()};
  last(random.below(3), random.below(static_cast<int>(last.cols()))) = kValues[random.below(5)];
  c.refused = true;
  return c;
}

constexpr StabilityKind kKinds[] = {
    {"scale 1e-9 to 1e9", scaled},
    {"offset to 1e8 sizes", far_away},
    {"sizes 1e6 apart", unequal_sizes},
    {"needles to aspect 1e12", needles},
    {"slivers to aspect 1e12", slivers},
    {"rods and plates to aspect 1e12", slender_bodies},
    {"flat, straight, point-like", flat_straight_point_like},
    {"identical bodies", identical},
    {"stacked boxes, coplanar", stacked_boxes},
    {"stacked boxes, moved by ulps", nearly_touching},
    {"nested bodies", nested},
    {"repeated facets", repeated_facets},
    {"repeated vertices", repeated_vertices},
    {"unused vertices", unused_vertices},
    {"inside-out bodies", inside_out_bodies},
    {"bodies of one facet", one_facet},
    {"bodies without facets", no_facet},
    {"slow sinking", slow_sinking},
    {"sudden teleports", sudden_teleports},
    {"vertices that swap", vertices_that_swap},
    {"crumpled to noise", crumpled_to_noise},
    {"beyond float boxes", beyond_float_boxes},
    {"below float numbers", below_float_numbers},
    {"whole numbers", whole_numbers},
    {"several at once", several_at_once},
    {"large rough bodies", large_rough_bodies, 100},
    {"out of range, refused", out_of_range},
};

}  // namespace

std::span<const StabilityKind> stability_kinds() { return kKinds; }

}  // namespace tact::bench
