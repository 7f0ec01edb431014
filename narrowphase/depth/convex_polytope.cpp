#include "narrowphase/depth/convex_polytope.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace tact::narrowphase {
namespace {

// The side of `face` that runs from point `from`; a corner each.
std::size_t side_from(const ConvexPolytope::Face& face, int from) {
  return face.corner[0] == from ? 0 : face.corner[1] == from ? 1 : 2;
}

}  // namespace

void ConvexPolytope::restart(const std::array<Vec3, 4>& points) {
  points_.assign(points.begin(), points.end());
  if (orient3d(points_[0], points_[1], points_[2], points_[3], counts_) < 0) std::swap(points_[1], points_[2]);
  faces_ = {{{0, 1, 2}, {1, 2, 3}}, {{0, 3, 1}, {3, 2, 0}}, {{1, 3, 2}, {1, 3, 0}}, {{2, 3, 0}, {2, 1, 0}}};
}

Vec3 ConvexPolytope::corner(int face, int k) const { return points_[faces_[face].corner[k]]; }

bool ConvexPolytope::is_beyond(int face, Vec3 p) const {
  return orient3d(corner(face, 0), corner(face, 1), corner(face, 2), p, counts_) < 0;
}

int ConvexPolytope::face_below(Vec3 p) const {
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    if (!faces_[f].removed && is_beyond(f, p)) return f;
  }
  return -1;
}

// Marks the faces that p lies beyond, from neighbour to neighbour, and collects the sides between them and the rest.
void ConvexPolytope::remove_seen_from(Vec3 p, int face) {
  border_.clear();
  stack_.assign(1, face);
  faces_[face].removed = true;
  while (!stack_.empty()) {
    const Face seen = faces_[stack_.back()];
    stack_.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const int neighbor = seen.neighbor[k];
      if (faces_[neighbor].removed) continue;
      if (is_beyond(neighbor, p)) {
        faces_[neighbor].removed = true;
        stack_.push_back(neighbor);
      } else {
        border_.push_back({seen.corner[k], seen.corner[(k + 1) % 3], neighbor});
      }
    }
  }
}

int ConvexPolytope::expand(int face, Vec3 p) {
  remove_seen_from(p, face);
  const int apex = static_cast<int>(points_.size());
  const int first = static_cast<int>(faces_.size());
  points_.push_back(p);
  face_from_.resize(points_.size());
  // The border is one closed line, so each of its points starts one side and ends one.
  for (std::size_t i = 0; i < border_.size(); ++i) face_from_[border_[i].from] = first + static_cast<int>(i);
  for (const BorderSide& side : border_) {
    const int added = static_cast<int>(faces_.size());
    Face& outside = faces_[side.outside];
    outside.neighbor[side_from(outside, side.to)] = added;
    faces_.push_back({{side.from, side.to, apex}, {side.outside, face_from_[side.to], -1}});
  }
  for (int f = first; f < static_cast<int>(faces_.size()); ++f) faces_[faces_[f].neighbor[1]].neighbor[2] = f;
  return first;
}

void ConvexPolytope::validate() const {
  const auto require = [](bool holds, int face, const char* what) {
    if (!holds) throw std::logic_error("face " + std::to_string(face) + ": " + what);
  };
  int faces = 0;
  std::vector<char> used(points_.size(), 0);
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    const Face& face = faces_[f];
    if (face.removed) continue;
    ++faces;
    for (std::size_t k = 0; k < 3; ++k) {
      used[face.corner[k]] = 1;
      const Face& neighbor = faces_[face.neighbor[k]];
      const std::size_t side = side_from(neighbor, face.corner[(k + 1) % 3]);
      require(!neighbor.removed, f, "a neighbour is removed");
      require(neighbor.corner[side] == face.corner[(k + 1) % 3], f, "a neighbour does not have the side");
      require(neighbor.corner[(side + 1) % 3] == face.corner[k], f, "a neighbour's side does not run back");
      require(neighbor.neighbor[side] == f, f, "a neighbour does not know it");
    }
    for (const Vec3& p : points_) require(!is_beyond(f, p), f, "a point lies beyond it");
  }
  int corners = 0;
  for (const char u : used) corners += u;
  require(2 * corners - faces == 4, faces, "the surface is not one sphere");  // Euler: V - E + F = 2, 2 E = 3 F
}

}  // namespace tact::narrowphase
