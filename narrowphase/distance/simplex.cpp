#include "narrowphase/distance/simplex.h"

#include <type_traits>
#include <utility>

#include "narrowphase/numeric/triple_double.h"

namespace tact::narrowphase {

namespace {

// Bounds the relative error of an operation on lengths near 1. Triple-doubles lose 2^-150: so much to spare leaves the
// weights of thin triangles right.
template <class Scalar>
constexpr double kRoundoff = 0x1p-110;
template <>
constexpr double kRoundoff<double> = 0x1p-53;

// Looks for the face of a simplex that is nearest to the origin.
template <class Scalar>
class ClosestFace {
 public:
  explicit ClosestFace(const SimplexPoints& simplex) : count_(simplex.count) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
      y_[i] = {simplex.point[i].x, simplex.point[i].y, simplex.point[i].z};
  }

  // True if the origin is strictly inside, on the same side of every face as the fourth corner.
  bool inside_tetrahedron() const {
    const Scalar sizes = (size(y(0)) + size(y(1))) + (size(y(2)) + size(y(3)));
    return same_side(0, 1, 2, 3, sizes) && same_side(0, 1, 3, 2, sizes) && same_side(0, 2, 3, 1, sizes) &&
           same_side(1, 2, 3, 0, sizes);
  }

  SimplexClosest run() {
    if (count_ == 4 && inside_tetrahedron())
      return {.point = {}, .carrier = {0, 1, 2, 3}, .carrier_count = 4, .weight = {}};
    return run_on_faces();
  }

  SimplexClosest run_on_faces() {
    for (int i = 0; i < count_; ++i) offer(y(i), {i, 0, 0, 0}, 1, {1.0, 0.0, 0.0});
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) edge(i, j);
    }
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        for (int k = j + 1; k < count_; ++k) triangle(i, j, k);
      }
    }
    return best_;
  }

  // Each corner's share of the volume is that of the tetrahedron which the origin makes with the face across from it. A
  // needle's volumes lose so many digits that the sum lies beside the origin, along the needle: it is put back there.
  std::array<double, 4> origin_weights() {
    std::array<Scalar, 4> share{volume(1, 2, 3), volume(0, 2, 3), volume(0, 1, 3), volume(0, 1, 2)};
    const Scalar sum = (share[0] + share[1]) + (share[2] + share[3]);
    for (Scalar& one : share) one = one / sum;
    const auto [from, to] = longest_edge();
    const Point edge = y(to) - y(from);
    const Scalar back = dot(weighted(share), edge) / dot(edge, edge);
    share[from] = share[from] + back;
    share[to] = share[to] - back;
    const Point origin = weighted(share);
    const SimplexClosest on_faces = run_on_faces();
    std::array<double, 4> weights{};
    const bool too_flat = !(dot(origin, origin) < distance_);
    for (std::size_t i = 0; i < 4; ++i) {
      if (!too_flat) weights[i] = static_cast<double>(share[i]);
      if (too_flat && on_faces.weight[i] > 0.0) weights[on_faces.carrier[i]] = on_faces.weight[i];
    }
    return weights;
  }

 private:
  using Point = NumberVector<Scalar>;

  const Point& y(int i) const { return y_[i]; }

  Point weighted(const std::array<Scalar, 4>& weight) const {
    Point sum{0.0, 0.0, 0.0};
    for (int i = 0; i < 4; ++i) sum = sum + weight[i] * y(i);
    return sum;
  }

  std::pair<int, int> longest_edge() const {
    std::pair longest{0, 1};
    Scalar most = 0.0;
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        const Point e = y(j) - y(i);
        if (dot(e, e) > most) longest = {i, j}, most = dot(e, e);
      }
    }
    return longest;
  }

  void edge(int i, int j) {
    const Point e = y(j) - y(i);
    const Scalar length = dot(e, e), t = -dot(y(i), e);
    if (!(t > 0.0 && t < length)) return;
    const Scalar share = t / length;
    offer(y(i) + share * e, {i, j, 0, 0}, 2, {(length - t) / length, share, 0.0});
  }

  // The projection of the origin on the triangle's plane has the weights s and t of the second and third corner over
  // the area. It lies inside if all three weights are positive. A triangle whose normal is noise is left to its edges.
  void triangle(int i, int j, int k) {
    const Point e = y(j) - y(i), f = y(k) - y(i), n = cross(e, f), o = -y(i);
    const Scalar area = dot(n, n), sine = 1e3 * kRoundoff<Scalar>;
    if (!(area > sine * sine * dot(e, e) * dot(f, f))) return;
    const Scalar s = dot(cross(o, f), n), t = dot(cross(e, o), n);
    if (!(s > 0.0 && t > 0.0 && s + t < area)) return;
    const Scalar of_j = s / area, of_k = t / area;
    offer(kHasSpareDigits ? (dot(n, y(i)) / area) * n : (y(i) + of_j * e) + of_k * f, {i, j, k, 0}, 3,
          {(area - (s + t)) / area, of_j, of_k});
  }

  void offer(const Point& point, std::array<int, 4> carrier, int count, const std::array<Scalar, 3>& weight) {
    const Scalar distance = dot(point, point);
    if (best_.carrier_count != 0 && !(distance < distance_)) return;
    distance_ = distance;
    const auto rounded = static_cast<double>(distance);
    best_ = {.point = {static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)},
             .carrier = carrier,
             .carrier_count = count,
             .weight = {static_cast<double>(weight[0]), static_cast<double>(weight[1]), static_cast<double>(weight[2])},
             .distance_squared = rounded,
             .distance_squared_tail = static_cast<double>(distance - static_cast<Scalar>(rounded))};
  }

  // The bound. Each component of the sides e and f has one rounding, a product of two of them three, the difference of
  // two products four. A dot product adds three: n · p is off by at most 7 roundoffs of the sum of |e_a f_b p_c| over
  // the six orders of the axes, and n · (p - q) by 8. (That sum is not |n||p|, which is smaller by the sine of the
  // angle between e and f.) It is below the product of the three sums of sizes. Products that vanish are below
  // `kVanishing`.
  //
  // The corners have a rounding each themselves. If the origin is farther from every face than any corner is off, it is
  // inside the true tetrahedron: the convex hull of moved corners holds what is deeper than they moved. That is one
  // roundoff of the largest corner, times |n| <= |e||f|. Two of the 11 roundoffs are for computing the bound. `sizes`:
  // of all corners.
  bool same_side(int i, int j, int k, int opposite, Scalar sizes) const {
    const Point e = y(j) - y(i), f = y(k) - y(i), n = cross(e, f);
    const Scalar origin = -dot(n, y(i)), corner = dot(n, y(opposite) - y(i));
    const Scalar error = 11.0 * kRoundoff<Scalar> * (size(e) * size(f)) * sizes + kVanishing;
    return (origin > error && corner > error) || (origin < -error && corner < -error);
  }

  // Six times that of the tetrahedron of three points and the origin.
  Scalar volume(int i, int j, int k) const { return absolute(dot(cross(y(j) - y(i), y(k) - y(i)), y(i))); }

  static Scalar absolute(Scalar a) { return a < 0.0 ? -a : a; }

  // |x| + |y| + |z|, not below the length.
  static Scalar size(const Point& p) { return absolute(p.x) + absolute(p.y) + absolute(p.z); }

  static constexpr double kVanishing = 0x1p-1000;
  // Rounding moves a thin triangle's weighted sum along the triangle, by the roundoff over its sine: too far for a
  // triangle that is 1e-14 away. The projection along the normal has the right direction; in doubles it may lie outside
  // of the triangle, in triple-doubles it does not.
  static constexpr bool kHasSpareDigits = !std::is_same_v<Scalar, double>;

  std::array<Point, 4> y_;
  int count_;
  SimplexClosest best_;
  Scalar distance_ = 0.0;
};

}  // namespace

SimplexClosest simplex_closest(const SimplexPoints& simplex) { return ClosestFace<double>(simplex).run(); }

bool tetrahedron_holds_origin(const SimplexPoints& simplex) {
  return ClosestFace<double>(simplex).inside_tetrahedron();
}

std::array<double, 4> origin_weights(const SimplexPoints& simplex) {
  return ClosestFace<TripleDouble>(simplex).origin_weights();
}

SimplexClosest simplex_closest_in_triple(const SimplexPoints& simplex) {
  return ClosestFace<TripleDouble>(simplex).run();
}

}  // namespace tact::narrowphase
