#include "narrowphase/triangles/triangle_triangle.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace tact::narrowphase {
namespace {

using Signs = std::array<int, 3>;

bool strictly_on_one_side(const Signs& s) { return s[0] == s[1] && s[1] == s[2] && s[0] != 0; }
bool all_zero(const Signs& s) { return s == Signs{0, 0, 0}; }

// Plane figures.
//
// Points of one plane are projected onto a coordinate plane to which theirs is not perpendicular: that maps the plane
// one to one, and figures meet if and only if their projections do. Such an axis is known by three projected points
// that are not on one line.

Point2 projected(const Vec3& p, int axis) {
  return axis == 0 ? Point2{p.y, p.z} : axis == 1 ? Point2{p.z, p.x} : Point2{p.x, p.y};
}

template <std::size_t N>
std::array<Point2, N> projected(const std::array<Vec3, N>& points, int axis) {
  std::array<Point2, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = projected(points[i], axis);
  return result;
}

// An axis to project along, and which way the triangle then turns: +1 counter-clockwise, -1 clockwise.
struct Projection {
  int axis;
  int turn;
};

// None if a, b, c are on one line.
std::optional<Projection> find_projection(const Vec3& a, const Vec3& b, const Vec3& c, PredicateCounts& counts) {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = orient2d(projected(a, axis), projected(b, axis), projected(c, axis), counts);
    if (turn != 0) return Projection{axis, turn};
  }
  return std::nullopt;
}

// True if all `points` are strictly on the side `side` (+1 left, -1 right) of the line from a to b.
template <std::size_t N>
bool all_on_side(const Point2& a, const Point2& b, int side, const std::array<Point2, N>& points,
                 PredicateCounts& counts) {
  for (const Point2& p : points) {
    if (orient2d(a, b, p, counts) != side) return false;
  }
  return true;
}

// Convex figures of the plane, not all on one line, are apart if and only if the line of some side of one has the other
// strictly beyond it: the sides of their Minkowski difference are parallel to theirs. The functions below look at the
// sides of the first figure. A segment has two sides, on one line.

template <std::size_t N>
bool side_separates(const std::array<Point2, 3>& triangle, int turn, const std::array<Point2, N>& other,
                    PredicateCounts& counts) {
  return all_on_side(triangle[0], triangle[1], -turn, other, counts) ||
         all_on_side(triangle[1], triangle[2], -turn, other, counts) ||
         all_on_side(triangle[2], triangle[0], -turn, other, counts);
}

template <std::size_t N>
bool line_separates(const std::array<Point2, 2>& segment, const std::array<Point2, N>& other, PredicateCounts& counts) {
  const int side = orient2d(segment[0], segment[1], other[0], counts);
  return side != 0 && all_on_side(segment[0], segment[1], side, other, counts);
}

// `segment` lies in the plane of `triangle`, which has an area.
bool coplanar_meet(const Segment& segment, const Triangle& triangle, Projection projection, PredicateCounts& counts) {
  const auto s = projected(segment, projection.axis);
  const auto t = projected(triangle, projection.axis);
  return !side_separates(t, projection.turn, s, counts) && !line_separates(s, t, counts);
}

// The ends of a triangle whose corners are on one line.
Segment ends_of(const Triangle& t) {
  Segment ends{t[0], t[0]};
  for (std::size_t i = 1; i < 3; ++i) {
    if (compare_lexicographically(t[i], ends[0]) < 0) ends[0] = t[i];
    if (compare_lexicographically(t[i], ends[1]) > 0) ends[1] = t[i];
  }
  return ends;
}

Segment sorted(const Segment& s) { return compare_lexicographically(s[0], s[1]) <= 0 ? s : Segment{s[1], s[0]}; }

// All four ends are on one line, along which lexicographic order is the order of the line or its reverse.
bool collinear_meet(const Segment& a, const Segment& b) {
  const Segment p = sorted(a);
  const Segment q = sorted(b);
  return compare_lexicographically(p[0], q[1]) <= 0 && compare_lexicographically(q[0], p[1]) <= 0;
}

// The corner of a triangle that a plane parts from the other two, when the corners are neither all strictly on one side
// nor all in the plane. The plane crosses both edges at that corner, each in one point.
struct LoneCorner {
  std::uint8_t corner;
  // +1 or -1: the corner is on that side or in the plane, the others on the other side or in the plane.
  std::int8_t side;
};

constexpr LoneCorner find_lone_corner(const Signs& s) {
  for (std::size_t i = 0; i < 3; ++i) {
    const int next = s[(i + 1) % 3];
    const int last = s[(i + 2) % 3];
    const bool touches = s[i] == 0 && next == last && next != 0;
    const bool separated = s[i] != 0 && s[i] != next && s[i] != last;
    if (touches || separated) return {static_cast<std::uint8_t>(i), static_cast<std::int8_t>(touches ? -next : s[i])};
  }
  return {0, 0};
}

constexpr int signs_index(const Signs& s) { return 9 * s[0] + 3 * s[1] + s[2] + 13; }

// A table, as the branches of the search are not predictable.
constexpr std::array<LoneCorner, 27> kLoneCorners = [] {
  std::array<LoneCorner, 27> table{};
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) table[signs_index({x, y, z})] = find_lone_corner({x, y, z});
    }
  }
  return table;
}();

// Each triangle crosses or touches the other's plane, and the planes cross: each meets their common line in an
// interval. In canonical order, corner 0 is the lone one and lies above the other's plane; then the intervals run from
// edge 01 to edge 02 in opposite directions, and orient3d of an edge of each tells the order of the points where they
// cross the line. It is zero only if these are one point, as each edge crosses the other's plane in that point alone.
bool intervals_meet(const Triangle& a, const Signs& a_sides, const Triangle& b, const Signs& b_sides,
                    PredicateCounts& counts) {
  const LoneCorner lone_a = kLoneCorners[signs_index(a_sides)];
  const LoneCorner lone_b = kLoneCorners[signs_index(b_sides)];
  const int i = lone_a.corner;
  const int j = lone_b.corner;
  const Vec3* a1 = &a[(i + 1) % 3];
  const Vec3* a2 = &a[(i + 2) % 3];
  const Vec3* b1 = &b[(j + 1) % 3];
  const Vec3* b2 = &b[(j + 2) % 3];
  // orient3d is -1 above a plane. A triangle is turned over to have the other's lone corner above it.
  if (lone_a.side > 0) std::swap(b1, b2);
  if (lone_b.side > 0) std::swap(a1, a2);
  return orient3d(a[i], *a1, b[j], *b1, counts) >= 0 && orient3d(a[i], *a2, b[j], *b2, counts) <= 0;
}

// What of a triangle is across from corner 0: a side; without area both other corners, but those in its place. A way
// from corner 0 that leaves the triangle does so there.
struct FarParts {
  std::size_t count = 0;
  Segment part[2];
};

FarParts far_parts(const Triangle& t, PredicateCounts& counts) {
  FarParts parts;
  if (find_projection(t[0], t[1], t[2], counts)) {
    parts.part[parts.count++] = {t[1], t[2]};
    return parts;
  }
  for (const std::size_t k : {1u, 2u}) {
    if (t[k] != t[0]) parts.part[parts.count++] = {t[k], t[k]};
  }
  return parts;
}

// Both are convex, so with another common point they have all of the way from corner 0 to it, and go on along it to
// where the first of them ends: there the far part of one meets the other.
bool meet_beyond_corner(const Triangle& a, const Triangle& b, PredicateCounts& counts) {
  const auto is_beside_plane = [&](const Triangle& plane, const Triangle& t) {
    const int side = orient3d(plane[0], plane[1], plane[2], t[1], counts);
    return side != 0 && side == orient3d(plane[0], plane[1], plane[2], t[2], counts);
  };
  if (is_beside_plane(a, b) || is_beside_plane(b, a)) return false;
  const auto far_part_meets = [&](const Triangle& own, const Triangle& other) {
    const FarParts parts = far_parts(own, counts);
    return std::any_of(parts.part, parts.part + parts.count,
                       [&](const Segment& part) { return segment_triangle_meet(part, other, counts); });
  };
  return far_part_meets(a, b) || far_part_meets(b, a);
}

// Corners 0 and 1 are common.
bool meet_beyond_edge(const Triangle& a, const Triangle& b, PredicateCounts& counts) {
  if (orient3d(a[0], a[1], a[2], b[2], counts) != 0) return false;
  if (const auto projection = find_projection(a[0], a[1], a[2], counts)) {
    const auto p = projected(a, projection->axis);
    return orient2d(p[0], p[1], projected(b[2], projection->axis), counts) == projection->turn;
  }
  // On the line of the edge a triangle with an area has no more than the edge; where the ends are one point there is
  // none.
  if (find_projection(b[0], b[1], b[2], counts) || find_projection(a[0], a[2], b[2], counts)) return false;
  const Segment edge = sorted({a[0], a[1]});
  const auto both_beyond = [&](const Vec3& end, int way) {
    return compare_lexicographically(a[2], end) == way && compare_lexicographically(b[2], end) == way;
  };
  return both_beyond(edge[0], -1) || both_beyond(edge[1], 1);
}

}  // namespace

bool triangles_meet_beyond(const Triangle& a, const Triangle& b, int common, PredicateCounts& counts) {
  if (common == 1) return meet_beyond_corner(a, b, counts);
  if (common == 2) return meet_beyond_edge(a, b, counts);
  return find_projection(a[0], a[1], a[2], counts).has_value();
}

bool triangle_triangle_meet(const Triangle& a, const Triangle& b, PredicateCounts& counts) {
  const Signs a_sides = sides_of_plane(b[0], b[1], b[2], a, counts);
  if (strictly_on_one_side(a_sides)) return false;
  if (all_zero(a_sides)) return coplanar_triangles_meet(a, b, counts);
  const Signs b_sides = sides_of_plane(a[0], a[1], a[2], b, counts);
  if (strictly_on_one_side(b_sides)) return false;
  // b has an area and a is not in its plane, so a has none.
  if (all_zero(b_sides)) return segment_triangle_meet(ends_of(a), b, counts);
  return intervals_meet(a, a_sides, b, b_sides, counts);
}

bool coplanar_triangles_meet(const Triangle& a, const Triangle& b, PredicateCounts& counts) {
  const auto projection = find_projection(b[0], b[1], b[2], counts);
  if (!projection) return segment_triangle_meet(ends_of(b), a, counts);
  const auto p = projected(a, projection->axis);
  const auto q = projected(b, projection->axis);
  const int turn = orient2d(p[0], p[1], p[2], counts);
  if (turn == 0) return coplanar_meet(ends_of(a), b, *projection, counts);
  return !side_separates(q, projection->turn, p, counts) && !side_separates(p, turn, q, counts);
}

bool segment_triangle_meet(const Segment& segment, const Triangle& triangle, PredicateCounts& counts) {
  const auto& [a, b, c] = triangle;
  const auto& [p, q] = segment;
  const int p_side = orient3d(a, b, c, p, counts);
  const int q_side = orient3d(a, b, c, q, counts);
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) {
    const auto projection = find_projection(a, b, c, counts);
    if (!projection) return segment_segment_meet(segment, ends_of(triangle), counts);
    return coplanar_meet(segment, triangle, *projection, counts);
  }
  // The line of the segment crosses the plane in one point, which must be on the same side of all edges.
  const int ab = orient3d(p, q, a, b, counts);
  const int bc = orient3d(p, q, b, c, counts);
  if (ab * bc < 0) return false;
  const int ca = orient3d(p, q, c, a, counts);
  return ab * ca >= 0 && bc * ca >= 0;
}

bool segment_segment_meet(const Segment& a, const Segment& b, PredicateCounts& counts) {
  if (orient3d(a[0], a[1], b[0], b[1], counts) != 0) return false;
  auto projection = find_projection(a[0], a[1], b[0], counts);
  if (!projection) projection = find_projection(a[0], a[1], b[1], counts);
  // a may be a point, which has no line.
  if (!projection) projection = find_projection(b[0], b[1], a[0], counts);
  if (!projection) return collinear_meet(a, b);
  const auto s = projected(a, projection->axis);
  const auto t = projected(b, projection->axis);
  return !line_separates(s, t, counts) && !line_separates(t, s, counts);
}

}  // namespace tact::narrowphase
