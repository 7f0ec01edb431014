// The face of a simplex that carries its point nearest to the origin, by signs alone: whatever numbers tell them.
#pragma once

#include <array>

namespace tact::narrowphase {

// The point nearest to the origin in a simplex of up to four points is the nearest of the face that it lies in, and no
// corner lies nearer than the plane across it. Numbers names three kinds of vectors: of a Point, of an Edge between
// two, and of a Direction, of any length, from the nearest point to the origin. That of an edge has the most digits: it
// is of degree 3 in the coordinates, and what is compared of degree 4.
template <class Numbers>
class NearestFace {
 public:
  using Point = typename Numbers::Point;
  using Edge = typename Numbers::Edge;
  using Direction = typename Numbers::Direction;

  // Up to four; then reduce().
  void clear() { count_ = 0; }
  void add(const Point& point) { y_[count_++] = point; }

  // Finds carrier() and, if the nearest point is not the origin itself, toward_origin().
  void reduce() {
    holds_origin_ = count_ == 4 && inside_tetrahedron();
    if (holds_origin_) return keep({0, 1, 2, 3}, 4);
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        for (int k = j + 1; k < count_; ++k) {
          if (triangle(i, j, k)) return keep({i, j, k}, 3);
        }
      }
    }
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        if (edge(i, j)) return keep({i, j}, 2);
      }
    }
    for (int i = 0; i < count_; ++i) {
      if (corner(i)) return keep({i}, 1);
    }
  }

  bool holds_origin() const { return holds_origin_; }
  const std::array<int, 4>& carrier() const { return carrier_; }
  int carrier_count() const { return carrier_count_; }
  const Direction& toward_origin() const { return toward_origin_; }

 private:
  const Point& y(int i) const { return y_[i]; }

  void keep(std::array<int, 4> carrier, int count) {
    carrier_ = carrier;
    carrier_count_ = count;
  }

  // True if the origin is on the same side of every face as the corner across from it, or in its plane.
  bool inside_tetrahedron() const {
    return same_side(0, 1, 2, 3) && same_side(0, 1, 3, 2) && same_side(0, 2, 3, 1) && same_side(1, 2, 3, 0);
  }

  bool same_side(int i, int j, int k, int opposite) const {
    const auto n = cross(y(j) - y(i), y(k) - y(i));
    const int of_corner = dot(n, y(opposite) - y(i)).sign(), of_origin = -dot(n, y(i)).sign();
    return of_corner != 0 && (of_origin == 0 || of_origin == of_corner);
  }

  // True if the nearest point is inside the triangle, not on its border. False if it has no area.
  bool triangle(int i, int j, int k) {
    const Edge e = y(j) - y(i), f = y(k) - y(i);
    const auto n = cross(e, f);
    const auto area = dot(n, n);
    if (area.sign() == 0) return false;
    const Point o = -y(i);
    const auto of_j = dot(cross(o, f), n), of_k = dot(cross(e, o), n);
    if (of_j.sign() <= 0 || of_k.sign() <= 0 || (area - (of_j + of_k)).sign() <= 0) return false;
    const int height = dot(n, y(i)).sign();
    holds_origin_ = height == 0;
    return holds_origin_ || is_nearest(Direction(height > 0 ? -n : n), {i, j, k});
  }

  bool edge(int i, int j) {
    // Bodies that share two vertices: no number with an error would see it.
    holds_origin_ = (y(i) + y(j)).is_zero();
    if (holds_origin_) return true;
    const Edge e = y(j) - y(i);
    const auto length = dot(e, e);
    const auto along = -dot(y(i), e);
    if (along.sign() <= 0 || (length - along).sign() <= 0) return false;
    const auto nearest = length * y(i) + along * e;
    holds_origin_ = nearest.is_zero();
    return holds_origin_ || is_nearest(Direction(-nearest), {i, j, i});
  }

  bool corner(int i) {
    holds_origin_ = y(i).is_zero();
    return holds_origin_ || is_nearest(Direction(-y(i)), {i, i, i});
  }

  // True if no corner is beyond those of a face along d, which is across the face.
  bool is_nearest(const Direction& d, const std::array<int, 3>& face) {
    for (int k = 0; k < count_; ++k) {
      const bool is_of_face = k == face[0] || k == face[1] || k == face[2];
      if (!is_of_face && dot(d, y(k) - y(face[0])).sign() > 0) return false;
    }
    toward_origin_ = d;
    return true;
  }

  std::array<Point, 4> y_;
  int count_ = 0;
  bool holds_origin_ = false;
  std::array<int, 4> carrier_{};
  int carrier_count_ = 0;
  Direction toward_origin_;
};

}  // namespace tact::narrowphase
