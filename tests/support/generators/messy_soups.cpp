#include "tests/support/generators/messy_soups.h"

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

constexpr double kFarAway = 1e4;  // metres

class MessySoup {
 public:
  MessySoup(Vec3 middle, Random& random) : middle_(middle), random_(random) {}

  Mesh make(int facets, const Mesh* other) {
    for (int v = 0; v < 4; ++v) add_vertex(other);
    while (facets_.size() < static_cast<std::size_t>(facets)) {
      if (random_.chance(0.5)) add_vertex(other);
      add_facet();
    }
    return builder_.mesh();
  }

 private:
  int any_vertex() { return random_.below(builder_.vertex_count()); }
  Vec3 any_point() { return points_[any_vertex()]; }

  void add_vertex(const Mesh* other) {
    points_.push_back(other && random_.chance(0.4) ? other->position(random_.below(other->vertex_count()))
                                                   : new_point());
    builder_.vertex(points_.back());
  }

  Vec3 new_point() {
    if (points_.size() < 4) return middle_ + random_.in_cube(1.0);
    switch (random_.below(10)) {
      case 0: return any_point();                                // a vertex that is there
      case 1: return nudged(any_point());                        // one that nearly is
      case 2: return middle_of(any_point());                     // the middle of what may be an edge
      case 3: return in_plane_of(any_point());                   // in a plane across an axis
      case 4: return middle_ + kFarAway * random_.in_cube(1.0);  // the far end of a needle
      case 5:
      case 6: return rounded(middle_ + random_.in_cube(1.0));  // on a lattice of 1/8 m
      default: return middle_ + random_.in_cube(1.0);
    }
  }

  Vec3 middle_of(Vec3 p) { return 0.5 * p + 0.5 * any_point(); }

  Vec3 nudged(Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) {
      const double towards =
          random_.chance(0.5) ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
      if (random_.chance(0.5)) p[axis] = std::nextafter(p[axis], towards);
    }
    return p;
  }

  Vec3 in_plane_of(Vec3 p) {
    const int axis = random_.below(3);
    Vec3 q = middle_ + random_.in_cube(1.0);
    q[axis] = p[axis];
    return q;
  }

  static Vec3 rounded(Vec3 p) {
    return {std::floor(8.0 * p.x) / 8.0, std::floor(8.0 * p.y) / 8.0, std::floor(8.0 * p.z) / 8.0};
  }

  void add_facet() {
    int i = any_vertex(), j = any_vertex(), k = any_vertex();
    if (!facets_.empty()) {
      const auto& last = facets_[random_.below(static_cast<int>(facets_.size()))];
      switch (random_.below(8)) {
        case 0: i = last[0], j = last[1], k = last[2]; break;  // again
        case 1: i = last[2], j = last[1], k = last[0]; break;  // reversed
        case 2: k = i; break;                                  // a segment
        case 3: j = k = i; break;                              // a point
        case 4:
        case 5: i = last[1], j = last[0]; break;  // one more on an edge
        default: break;
      }
    }
    facets_.push_back({i, j, k});
    builder_.facet(i, j, k);
  }

  Vec3 middle_;
  Random& random_;
  MeshBuilder builder_;
  std::vector<Vec3> points_;
  std::vector<std::array<int, 3>> facets_;
};

}  // namespace

std::vector<Mesh> messy_soups(int facets, std::uint64_t seed) {
  Random random(seed);
  const Vec3 middle = kFarAway * random.direction();
  const Mesh first = MessySoup(middle, random).make(facets, nullptr);
  return {first, MessySoup(middle + 0.5 * random.in_ball(), random).make(facets, &first)};
}

}  // namespace tact::tests
