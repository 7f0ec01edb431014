#include "narrowphase/direction/face_triangle.h"

#include <limits>

#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

// Sides are taken from the bodies, not from points of M.
std::optional<Vec3> face_normal(const MinkowskiDifference& m, const GjkSimplex& s, Vec3 toward) {
  if (s.count < 3) return std::nullopt;
  const auto side = [&](std::size_t i, std::size_t j) {
    const auto point = [&](const ClusteredMesh& mesh, int vertex) { return m.scale() * mesh.position(vertex); };
    return double_double_difference(point(m.a(), s.a[j]), point(m.a(), s.a[i])) -
           double_double_difference(point(m.b(), s.b[j]), point(m.b(), s.b[i]));
  };
  const Vec3 n = double_double_cross(side(0, 1), side(0, 2));
  if (n == Vec3{}) return std::nullopt;
  const Vec3 unit = unit_vector(n);
  return dot(unit, toward) < 0.0 ? -unit : unit;
}

FaceTriangle::FaceTriangle(const MinkowskiDifference& m, const GjkSimplex& vertices, Vec3 n)
    : vertices_(vertices), n_(n) {
  for (std::size_t i = 0; i < 3; ++i) corner_[i] = m.vertex(vertices.a[i], vertices.b[i]).point;
  turn_ = dot(cross(corner_[1] - corner_[0], corner_[2] - corner_[0]), n) < 0.0 ? -1.0 : 1.0;
}

// Twice the area that a side spans with the projection.
double FaceTriangle::span(Vec3 from, Vec3 to) const { return turn_ * dot(cross(from, to - from), n_); }

FaceTriangle::Side FaceTriangle::side_of_projection() const {
  Side nearest{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 from = corner_[i], to = corner_[(i + 1) % 3];
    const double length = norm(to - from);  // of points of M, rounded: it may vanish where that of a side does not
    const double distance = length > 0.0 ? span(from, to) / length : 0.0;
    if (distance < nearest.distance) nearest = {i, distance};
  }
  return nearest;
}

Vec3 FaceTriangle::outward(std::size_t side) const {
  return normalized(turn_ * cross(corner_[(side + 1) % 3] - corner_[side], n_));
}

bool FaceTriangle::is_end_of(std::size_t side, const MinkowskiVertex& v) const {
  const auto is = [&](std::size_t i) { return v.a == vertices_.a[i] && v.b == vertices_.b[i]; };
  return is(side) || is((side + 1) % 3);
}

GjkSimplex FaceTriangle::side_and(std::size_t side, const MinkowskiVertex& v) const {
  const std::size_t next = (side + 1) % 3;
  return {{vertices_.a[side], vertices_.a[next], v.a}, {vertices_.b[side], vertices_.b[next], v.b}, 3};
}

std::optional<GjkSimplex> FaceTriangle::toward_projection(const MinkowskiVertex& above) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 from = corner_[i], to = corner_[(i + 1) % 3], v = above.point;
    if (span(from, to) >= 0.0 && span(to, v) >= 0.0 && span(v, from) >= 0.0) return side_and(i, above);
  }
  const Side side = side_of_projection();
  if (side.distance >= 0.0) return std::nullopt;
  return side_and(side.index, above);
}

}  // namespace tact::narrowphase
