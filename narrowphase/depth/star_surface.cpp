#include "narrowphase/depth/star_surface.h"

#include <cmath>

#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {
namespace {

// The normal e × f of two sides is off by less than this times |e||f| roundoffs. Each component of a side has one
// rounding. Each component of the product has three more, of two products of size |e||f| at most.
constexpr double kNormalRoundings = 16.0;
// Of n · p, n being of unit length but for rounding.
constexpr double kDistanceRoundings = 8.0;
// The least sine of the angle between two sides whose normal double-double can tell.
constexpr double kSmallestFacetSine = 0x1p-92;

double sum_of_sizes(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// The side of `face` that runs from vertex `from`; a corner each.
std::size_t side_from(const StarSurface::Face& face, int from) {
  return face.corner[0] == from ? 0 : face.corner[1] == from ? 1 : 2;
}

void put(SurfaceShape& shape, const MinkowskiVertex& vertex) {
  shape.a[shape.vertex_count] = vertex.a;
  shape.b[shape.vertex_count] = vertex.b;
  ++shape.vertex_count;
}

void put(SurfaceShape& shape, std::array<std::uint8_t, 3> corner, std::array<std::uint8_t, 3> neighbor) {
  shape.corner[shape.face_count] = corner;
  shape.neighbor[shape.face_count] = neighbor;
  ++shape.face_count;
}

}  // namespace

const MinkowskiVertex& StarSurface::corner(int face, int k) const { return vertices_[faces_[face].corner[k]]; }

bool StarSurface::start(const MinkowskiDifference& m, const SurfaceShape& shape) {
  margin_ = m.height_error();
  vertex_error_ = kUnitRoundoff * 2.0 * m.size();
  face_count_ = shape.face_count;
  vertices_.clear();
  faces_.clear();
  for (int v = 0; v < shape.vertex_count; ++v) vertices_.push_back(m.vertex(shape.a[v], shape.b[v]));
  face_from_.assign(vertices_.size(), -1);
  for (int f = 0; f < shape.face_count; ++f) {
    const auto& c = shape.corner[f];
    const auto& n = shape.neighbor[f];
    faces_.push_back({.corner = {c[0], c[1], c[2]},
                      .neighbor = {n[0], n[1], n[2]},
                      .normal = {},
                      .distance = 0.0,
                      .error = 0.0,
                      .sharp = false,
                      .removed = false});
    if (!set_plane(f)) return false;
  }
  return true;
}

// In plain doubles, and in double-double where these do not tell that the face looks away from the origin.
bool StarSurface::set_plane(int face) {
  Face& f = faces_[face];
  const Vec3 p = vertices_[f.corner[0]].point;
  const Vec3 side = vertices_[f.corner[1]].point - p;
  const Vec3 other = vertices_[f.corner[2]].point - p;
  const Vec3 n = cross(side, other);
  const double per_length = 1.0 / norm(n);
  f.normal = per_length * n;
  f.distance = dot(f.normal, p);
  f.error = kUnitRoundoff * sum_of_sizes(p) *
            (kDistanceRoundings + kNormalRoundings * per_length * (sum_of_sizes(side) * sum_of_sizes(other)));
  f.sharp = false;
  return looks_away(face) || (sharpen(face) && looks_away(face));
}

bool StarSurface::looks_away(int face) const {
  const Face& f = faces_[face];
  return f.distance > f.error + vertex_error_;  // false for what is not a number: there was no normal
}

bool StarSurface::sharpen(int face) {
  Face& f = faces_[face];
  const Vec3 p = vertices_[f.corner[0]].point;
  const DoubleDoubleVec3 side = double_double_difference(vertices_[f.corner[1]].point, p);
  const DoubleDoubleVec3 other = double_double_difference(vertices_[f.corner[2]].point, p);
  const Vec3 n = double_double_cross(side, other);
  if (!(norm(n) > kSmallestFacetSine * norm(heads(side)) * norm(heads(other)))) return false;
  f.normal = unit_vector(n);
  f.distance = dot(f.normal, p);
  f.error = kDistanceRoundings * kUnitRoundoff * sum_of_sizes(p);
  f.sharp = true;
  return true;
}

// Marks the faces that p lies beyond, from neighbour to neighbour, and collects the sides between them and the rest.
// Beyond by no more than rounding does not count: faces of one plane stay together.
void StarSurface::remove_seen_from(Vec3 p, int face) {
  border_.clear();
  stack_.assign(1, face);
  faces_[face].removed = true;
  --face_count_;
  while (!stack_.empty()) {
    const Face& seen = faces_[stack_.back()];
    stack_.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const int neighbor = seen.neighbor[k];
      Face& next = faces_[neighbor];
      if (next.removed) continue;
      if (dot(next.normal, p) - next.distance > margin_) {
        next.removed = true;
        --face_count_;
        stack_.push_back(neighbor);
      } else {
        border_.push_back({seen.corner[k], seen.corner[(k + 1) % 3], neighbor});
      }
    }
  }
}

// Only if the replaced patch is a disk is the new surface closed. Notes where the new faces' sides start.
bool StarSurface::border_is_one_line(int first_face) {
  for (std::size_t i = 0; i < border_.size(); ++i) {
    int& start = face_from_[border_[i].from];
    if (start >= first_face) return false;
    start = first_face + static_cast<int>(i);
  }
  std::size_t i = 0, steps = 0;
  do {
    const int next = face_from_[border_[i].to];
    if (next < first_face) return false;
    i = static_cast<std::size_t>(next - first_face);
    ++steps;
  } while (i != 0 && steps <= border_.size());
  return steps == border_.size();
}

int StarSurface::expand(int face, const MinkowskiVertex& vertex) {
  remove_seen_from(vertex.point, face);
  const int first = static_cast<int>(faces_.size());
  if (border_.empty() || !border_is_one_line(first)) return -1;
  const int apex = static_cast<int>(vertices_.size());
  vertices_.push_back(vertex);
  face_from_.push_back(-1);
  for (const BorderSide& side : border_) {
    const int added = static_cast<int>(faces_.size());
    Face& outside = faces_[side.outside];
    outside.neighbor[side_from(outside, side.to)] = added;
    faces_.push_back({.corner = {side.from, side.to, apex},
                      .neighbor = {side.outside, face_from_[side.to], -1},
                      .normal = {},
                      .distance = 0.0,
                      .error = 0.0,
                      .sharp = false,
                      .removed = false});
    ++face_count_;
    if (!set_plane(added)) return -1;
  }
  for (int f = first; f < static_cast<int>(faces_.size()); ++f) faces_[faces_[f].neighbor[1]].neighbor[2] = f;
  return first;
}

void StarSurface::save(SurfaceShape& shape) {
  shape.vertex_count = shape.face_count = 0;
  if (face_count_ > SurfaceShape::kMostFaces) return;
  face_from_.assign(vertices_.size(), -1);  // here: the number of each vertex in the shape
  stack_.resize(faces_.size());             // here: the number of each face in the shape
  int kept = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!faces_[f].removed) stack_[f] = kept++;
  }
  for (const Face& face : faces_) {
    if (face.removed) continue;
    std::array<std::uint8_t, 3> corner, neighbor;
    for (std::size_t k = 0; k < 3; ++k) {
      int& number = face_from_[face.corner[k]];
      if (number < 0) {
        number = shape.vertex_count;
        put(shape, vertices_[face.corner[k]]);
      }
      corner[k] = static_cast<std::uint8_t>(number);
      neighbor[k] = static_cast<std::uint8_t>(stack_[face.neighbor[k]]);
    }
    put(shape, corner, neighbor);
  }
}

SurfaceShape tetrahedron_shape(const std::array<MinkowskiVertex, 4>& vertices) {
  SurfaceShape shape;
  const Vec3 p = vertices[0].point, q = vertices[1].point, r = vertices[2].point, s = vertices[3].point;
  const bool turned = dot(cross(q - p, r - p), s - p) > 0.0;
  for (const std::size_t i : {0, turned ? 2 : 1, turned ? 1 : 2, 3}) put(shape, vertices[i]);
  put(shape, {0, 1, 2}, {1, 2, 3});
  put(shape, {0, 3, 1}, {3, 2, 0});
  put(shape, {1, 3, 2}, {1, 3, 0});
  put(shape, {2, 3, 0}, {2, 1, 0});
  return shape;
}

SurfaceShape bipyramid_shape(const std::array<MinkowskiVertex, 3>& ring, const MinkowskiVertex& top,
                             const MinkowskiVertex& bottom) {
  SurfaceShape shape;
  for (const MinkowskiVertex& vertex : ring) put(shape, vertex);
  put(shape, top);
  put(shape, bottom);
  put(shape, {0, 1, 3}, {3, 1, 2});
  put(shape, {1, 2, 3}, {4, 2, 0});
  put(shape, {2, 0, 3}, {5, 0, 1});
  put(shape, {1, 0, 4}, {0, 5, 4});
  put(shape, {2, 1, 4}, {1, 3, 5});
  put(shape, {0, 2, 4}, {2, 4, 3});
  return shape;
}

}  // namespace tact::narrowphase
