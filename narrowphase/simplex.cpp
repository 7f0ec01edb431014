#include "narrowphase/simplex.h"

#include <cmath>

namespace tact::narrowphase {

namespace {

// Below this sine between its edges a triangle is left to its edges: its normal would be noise.
constexpr double kSmallestSine = 1e-13;

class Search {
 public:
  explicit Search(const SimplexPoints& simplex) : y_(simplex.point) {}

  void vertex(int i) { offer(y(i), {i, 0, 0, 0}, 1); }

  void edge(int i, int j) {
    const Vec3 e = y(j) - y(i);
    const double length = norm_squared(e), t = -dot(y(i), e);
    if (t > 0.0 && t < length) offer(y(i) + (t / length) * e, {i, j, 0, 0}, 2);
  }

  // The foot of the origin in the triangle's plane has the weights s, t of the second and third corner; it is inside if
  // neither they nor the first's are negative.
  void triangle(int i, int j, int k) {
    const Vec3 e = y(j) - y(i), f = y(k) - y(i), n = cross(e, f), o = -y(i);
    const double area = norm_squared(n);
    if (!(area > kSmallestSine * kSmallestSine * norm_squared(e) * norm_squared(f))) return;
    const double s = dot(cross(o, f), n), t = dot(cross(e, o), n);
    if (s > 0.0 && t > 0.0 && s + t < area) offer(y(i) + (s / area) * e + (t / area) * f, {i, j, k, 0}, 3);
  }

  // Is the origin strictly inside, on the same side of every face as the fourth corner?
  bool inside_tetrahedron() const {
    return same_side(0, 1, 2, 3) && same_side(0, 1, 3, 2) && same_side(0, 2, 3, 1) && same_side(1, 2, 3, 0);
  }

  const SimplexClosest& best() const { return best_; }

 private:
  const Vec3& y(int i) const { return y_[static_cast<std::size_t>(i)]; }

  void offer(Vec3 point, std::array<int, 4> carrier, int count) {
    const double distance = norm_squared(point);
    if (best_.carrier_count != 0 && !(distance < distance_)) return;
    distance_ = distance;
    best_ = {point, carrier, count};
  }

  bool same_side(int i, int j, int k, int opposite) const {
    const Vec3 n = cross(y(j) - y(i), y(k) - y(i));
    const double origin = -dot(n, y(i)), corner = dot(n, y(opposite) - y(i));
    const double error = 1e-15 * norm(n) * (norm(y(i)) + norm(y(opposite)));
    return (origin > error && corner > error) || (origin < -error && corner < -error);
  }

  const std::array<Vec3, 4>& y_;
  SimplexClosest best_;
  double distance_ = 0.0;
};

}  // namespace

SimplexClosest simplex_closest(const SimplexPoints& simplex) {
  Search search(simplex);
  if (simplex.count == 4 && search.inside_tetrahedron()) return {{}, {0, 1, 2, 3}, 4};
  for (int i = 0; i < simplex.count; ++i) search.vertex(i);
  for (int i = 0; i < simplex.count; ++i) {
    for (int j = i + 1; j < simplex.count; ++j) search.edge(i, j);
  }
  for (int i = 0; i < simplex.count; ++i) {
    for (int j = i + 1; j < simplex.count; ++j) {
      for (int k = j + 1; k < simplex.count; ++k) search.triangle(i, j, k);
    }
  }
  return search.best();
}

}  // namespace tact::narrowphase
