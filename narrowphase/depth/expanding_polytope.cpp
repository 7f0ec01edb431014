#include "narrowphase/depth/expanding_polytope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "narrowphase/depth/convex_polytope.h"
#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/frame.h"

namespace tact::narrowphase {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Support queries that any pair may take, and more for each vertex of the bodies.
constexpr int kLimit = 2000;
constexpr int kLimitPerVertex = 4;
// The bounds have met when they are this near, relative to the size of M, or within twice the error of a height.
constexpr double kTolerance = 1e-14;
// A triangle thinner than this has no normal in double-double. The face across its longest side is as near to the
// origin.
constexpr double kSmallestSine = 0x1p-92;

bool collinear(Vec3 p, Vec3 q, Vec3 r) {
  PredicateCounts counts;
  return orient2d({p.x, p.y}, {q.x, q.y}, {r.x, r.y}, counts) == 0 &&
         orient2d({p.y, p.z}, {q.y, q.z}, {r.y, r.z}, counts) == 0 &&
         orient2d({p.z, p.x}, {q.z, q.x}, {r.z, r.x}, counts) == 0;
}

// The unit vector along e × f, if that can be told.
std::optional<Vec3> normal_across(const DoubleDoubleVec3& e, const DoubleDoubleVec3& f) {
  const Vec3 n = double_double_cross(e, f);
  if (!(norm(n) > kSmallestSine * norm(heads(e)) * norm(heads(f)))) return std::nullopt;
  return unit_vector(n);
}

using Queried = QueriedDirections::Queried;

class PolytopeExpansion {
 public:
  PolytopeExpansion(const MinkowskiDifference& m, Vec3 preferred, PolytopeMemory& memory)
      : m_(m),
        preferred_(preferred_direction(preferred)),
        tolerance_(height_tolerance(m)),
        seeds_(memory.seeds),
        open_(memory.open),
        normals_(memory.normals),
        queried_(memory.queried),
        polytope_(memory.polytope) {
    seeds_.clear();
    open_.clear();
    normals_.clear();
    queried_.restart();
  }

  SmallestSeparation run() {
    query(preferred_);
    if (const auto tetrahedron = first_tetrahedron()) expand(*tetrahedron);
    Queried best = choose();
    if (dot(best.direction, preferred_) < 0.0) {
      query(-best.direction);
      best = choose();
    }
    return {.direction = best.direction,
            .height = best.height,
            .lower_bound = std::min(lower_bound_ - 2.0 * m_.height_error(), best.height),
            .face = {},
            .support_queries = queried_.count(),
            .limit_reached = limit_reached_};
  }

 private:
  MinkowskiVertex query(Vec3 n) { return queried_.query(m_, n); }
  double height() const { return queried_.least(); }
  Queried choose() const { return queried_.choose(preferred_, m_.height_error()); }

  void query_seed(Vec3 n) {
    seeds_.push_back(query(n));
    seeds_.push_back(query(-n));
  }

  // The seed with the largest measure above zero.
  template <class Measure>
  std::optional<Vec3> best_seed(const Measure& measure) const {
    std::optional<Vec3> best;
    double largest = 0.0;
    for (const MinkowskiVertex& seed : seeds_) {
      const double value = measure(seed.point);
      if (value > largest) {
        largest = value;
        best = seed.point;
      }
    }
    return best;
  }

  // Four vertices of M that do not lie in one plane. Nothing if M is flat, straight or a point, as far as support
  // queries across it tell. The directions across it have then been queried, so that the result is complete.
  std::optional<std::array<Vec3, 4>> first_tetrahedron() {
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) query_seed(axis);
    const Vec3 p = seeds_[0].point;
    const auto q = best_seed([&](Vec3 x) { return norm_squared(x - p); });
    if (!q) return std::nullopt;
    const auto r = seed_off_line(p, *q);
    if (!r) return std::nullopt;
    const auto normal = normal_across(double_double_difference(*q, p), double_double_difference(*r, p));
    if (!normal) return std::nullopt;
    query_seed(*normal);
    const auto s = best_seed([&](Vec3 x) {
      PredicateCounts counts;
      if (orient3d(p, *q, *r, x, counts) == 0) return 0.0;
      return std::max(std::abs(dot(*normal, x - p)), std::numeric_limits<double>::min());
    });
    if (!s) return std::nullopt;
    return std::array<Vec3, 4>{p, *q, *r, *s};
  }

  // The seed that is farthest from the line through p and q, if one is off it.
  std::optional<Vec3> seed_off_line(Vec3 p, Vec3 q) {
    const Vec3 along = unit_vector(q - p);
    const Frame across = frame_across(along);
    query_seed(across.u);
    query_seed(across.v);
    const auto distance = [&](Vec3 x) {
      return collinear(p, q, x)
                 ? 0.0
                 : norm(double_double_cross(double_double_difference(x, p), {{along.x}, {along.y}, {along.z}}));
    };
    const auto r = best_seed(distance);
    const Vec3 preferred_across = preferred_ - dot(preferred_, along) * along;
    const bool is_straight = !r || distance(*r) <= m_.height_error();  // but for rounding
    if (is_straight && norm(preferred_across) > 0.0) query(unit_vector(preferred_across));
    return r;
  }

  // Expands the polytope over its nearest face until that face is one of M, or as good.
  void expand(const std::array<Vec3, 4>& tetrahedron) {
    polytope_.restart(tetrahedron);
    for (const MinkowskiVertex& seed : seeds_) {
      const int below = polytope_.face_below(seed.point);
      if (below >= 0) polytope_.expand(below, seed.point);
    }
    add_open_faces(0);
    const int limit = query_limit(m_);
    double closed = kInfinity;  // the nearest plane of the faces that cannot be expanded
    lower_bound_ = -kInfinity;
    while (!open_.empty()) {
      std::pop_heap(open_.begin(), open_.end(), std::greater<>());
      const OpenFace nearest = open_.back();
      open_.pop_back();
      if (polytope_.faces()[nearest.face].removed) continue;
      lower_bound_ = std::min(nearest.distance, closed);
      if (height() - nearest.distance <= tolerance_ || queried_.count() >= limit) break;
      const MinkowskiVertex vertex = query(normals_[nearest.face]);
      if (height() - nearest.distance <= tolerance_) break;
      // By rounding, the vertex may lie higher than the face and yet not beyond it: such a face stays as it is.
      if (polytope_.is_beyond(nearest.face, vertex.point)) {
        add_open_faces(polytope_.expand(nearest.face, vertex.point));
      } else {
        closed = std::min(closed, nearest.distance);
      }
    }
    if (open_.empty()) lower_bound_ = std::min(height(), closed);
    limit_reached_ = height() - lower_bound_ > tolerance_;
  }

  // A face whose plane is as far as the best height is never the nearest, nor does it have to be expanded.
  void add_open_faces(int first) {
    normals_.resize(polytope_.faces().size());
    for (int f = first; f < static_cast<int>(polytope_.faces().size()); ++f) {
      if (polytope_.faces()[f].removed) continue;
      const Vec3 p = polytope_.corner(f, 0);
      const auto normal = normal_across(double_double_difference(polytope_.corner(f, 1), p),
                                        double_double_difference(polytope_.corner(f, 2), p));
      if (!normal) continue;
      const double distance = dot(*normal, p);
      if (!(distance < height())) continue;
      normals_[f] = *normal;
      open_.push_back({distance, f});
      std::push_heap(open_.begin(), open_.end(), std::greater<>());
    }
  }

  const MinkowskiDifference& m_;
  Vec3 preferred_;
  double tolerance_;
  std::vector<MinkowskiVertex>& seeds_;
  std::vector<OpenFace>& open_;  // a heap, the nearest on top
  std::vector<Vec3>& normals_;   // of the faces that are or were open
  QueriedDirections& queried_;
  ConvexPolytope& polytope_;
  double lower_bound_ = 0.0;
  bool limit_reached_ = false;
};

}  // namespace

SmallestSeparation expanding_polytope(const MinkowskiDifference& m, Vec3 preferred, PolytopeMemory& memory) {
  return PolytopeExpansion(m, preferred, memory).run();
}

Vec3 preferred_direction(Vec3 preferred) { return preferred == Vec3{} ? Vec3{0.0, 0.0, 1.0} : unit_vector(preferred); }

double height_tolerance(const MinkowskiDifference& m) {
  return std::max(2.0 * m.height_error(), kTolerance * m.size());
}

int query_limit(const MinkowskiDifference& m) {
  return kLimit + kLimitPerVertex * (m.a().vertex_count() + m.b().vertex_count());
}

}  // namespace tact::narrowphase
