#include "tests/support/oracles/crossing_oracle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace tact::tests {

namespace {

using Long3 = Eigen::Matrix<long double, 3, 1>;
using VertexPair = std::pair<int, int>;

constexpr long double kBand = 1e-11L;  // of lengths near 1 and of cosines

struct Shape {
  std::vector<Long3> x;
  std::vector<std::array<int, 3>> facets;
  std::map<VertexPair, std::vector<int>> third;  // of each edge
};

Long3 to_long(Vec3 v) { return {v.x, v.y, v.z}; }

Shape shape_of(const Mesh& mesh) {
  Shape s;
  for (int v = 0; v < mesh.vertex_count(); ++v) s.x.push_back(to_long(mesh.position(v)));
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const std::array<int, 3> c{mesh.facets(0, f), mesh.facets(1, f), mesh.facets(2, f)};
    s.facets.push_back(c);
    for (std::size_t k = 0; k < 3; ++k) s.third[std::minmax(c[k], c[(k + 1) % 3])].push_back(c[(k + 2) % 3]);
  }
  return s;
}

const Long3& at(const Shape& s, int v) { return s.x[v]; }

// How often a closed surface winds around p (van Oosterom and Strackee, 1983).
bool inside(const Shape& s, const Long3& p) {
  long double sum = 0;
  for (const auto& c : s.facets) {
    const Long3 u = at(s, c[0]) - p, v = at(s, c[1]) - p, w = at(s, c[2]) - p;
    const long double a = u.norm(), b = v.norm(), d = w.norm();
    sum += 2 * std::atan2(u.dot(v.cross(w)), a * b * d + u.dot(v) * d + v.dot(w) * a + w.dot(u) * b);
  }
  return std::abs(sum) > 2 * std::numbers::pi_v<long double>;
}

Long3 nearest_in_facet(const Shape& s, const std::array<int, 3>& c, const Long3& v) {
  const Long3 p = at(s, c[0]), q = at(s, c[1]), r = at(s, c[2]), n = (q - p).cross(r - p);
  const Long3 foot = v - n.dot(v - p) / n.squaredNorm() * n;
  const auto left = [&](const Long3& from, const Long3& to) { return n.dot((to - from).cross(foot - from)) >= 0; };
  if (left(p, q) && left(q, r) && left(r, p)) return foot;
  Long3 best = p;
  for (const auto& [from, to] : {std::pair(p, q), std::pair(q, r), std::pair(r, p)}) {
    const long double t = std::clamp((v - from).dot(to - from) / (to - from).squaredNorm(), 0.0L, 1.0L);
    const Long3 place = from + t * (to - from);
    if ((place - v).norm() < (best - v).norm()) best = place;
  }
  return best;
}

long double distance_to(const Shape& s, const Long3& v) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const auto& c : s.facets) least = std::min(least, (nearest_in_facet(s, c, v) - v).norm());
  return least;
}

Long3 normal_of(const Shape& s, const std::array<int, 3>& c) {
  return (at(s, c[1]) - at(s, c[0])).cross(at(s, c[2]) - at(s, c[0])).normalized();
}

// A place on a facet, and the way there.
struct Way {
  long double distance = std::numeric_limits<long double>::infinity();
  Long3 out = Long3::Zero();
};

Way nearest_facing(const Shape& s, const Long3& v, const Long3& facing, long double cosine) {
  Way best;
  for (const auto& c : s.facets) {
    const Long3 n = normal_of(s, c);
    if (n.dot(facing) <= cosine || n.dot(v - at(s, c[0])) > 1e-12L) continue;
    const Long3 to = nearest_in_facet(s, c, v) - v;
    if (to.norm() < best.distance) best = {to.norm(), to.norm() > 0 ? Long3(to.normalized()) : n};
  }
  return best;
}

// First met along a direction, from inside.
Way along(const Shape& s, const Long3& v, const Long3& direction) {
  Way best;
  for (const auto& c : s.facets) {
    const Long3 p = at(s, c[0]), q = at(s, c[1]), r = at(s, c[2]), n = (q - p).cross(r - p);
    const long double rise = n.dot(direction);
    if (rise == 0) continue;
    const long double t = n.dot(p - v) / rise;
    const Long3 x = v + t * direction;
    const auto left = [&](const Long3& from, const Long3& to) { return n.dot((to - from).cross(x - from)) >= 0; };
    if (t >= 0 && t < best.distance && left(p, q) && left(q, r) && left(r, p)) best = {t, direction};
  }
  return best;
}

// How two convex bodies are parted of which most vertices that were past each other have come out.
struct Separation {
  Long3 direction;  // from a to b
  bool leads_all = false;
};

bool segment_meets(const Long3& p, const Long3& q, const Shape& s, const std::array<int, 3>& c) {
  const Long3 u = at(s, c[0]), v = at(s, c[1]), w = at(s, c[2]), n = (v - u).cross(w - u);
  if (n.dot(p - u) * n.dot(q - u) > 0) return false;
  const auto side = [&](const Long3& from, const Long3& to) { return (q - p).dot((from - p).cross(to - p)); };
  const long double x = side(u, v), y = side(v, w), z = side(w, u);
  return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

// One body in the other.
class Crossed {
 public:
  Crossed(const Shape& own, const Shape& other, const Long3& out, long double depth,
          const std::map<int, LastNormals::Of>& last, long double sign)
      : own_(own), other_(other), out_(out), depth_(depth), sign_(sign), last_(last) {
    for (const auto& [edge, _] : own.third) {
      for (std::size_t f = 0; f < other.facets.size(); ++f) {
        if (segment_meets(at(own, edge.first), at(own, edge.second), other, other.facets[f])) hits_[edge].push_back(f);
      }
    }
    for (std::size_t v = 0; v < own.x.size(); ++v) {
      if (inside(other, own.x[v])) inside_.insert(static_cast<int>(v));
    }
    find_patches();
    for (const int v : inside_) ways_[v] = way_of(v);
  }

  std::map<int, ExpectedGap> gaps() const {
    std::map<int, ExpectedGap> result;
    for (const auto& [v, way] : ways_)
      result[v] = {-static_cast<double>(way.first.distance), is_certain(v) && distance_to(other_, at(own_, v)) > kBand};
    return result;
  }
  bool is_inside(int v) const { return inside_.contains(v); }
  const std::set<int>& inside_vertices() const { return inside_; }
  const Way& way(int v) const { return ways_.at(v).first; }
  bool is_certain(int v) const { return !led_.contains(v) && (!is_inside(v) || ways_.at(v).second); }
  // The crossing of these vertices leads them: their ways are not looked for here.
  void set_led(std::set<int> vertices) { led_ = std::move(vertices); }
  // Vertices that came in and whose ways are against the direction, or all, take the nearest way along it.
  void lead(const Separation& separation) {
    for (auto& [v, one] : ways_) {
      auto& [way, certain] = one;
      const long double along = sign_ * way.out.dot(separation.direction);
      const bool was_inside = last_.contains(v) && last_.at(v).gap < 0.0;
      if (!separation.leads_all) {
        if (was_inside || along > kBand) continue;
        certain = certain && along < -kBand;
      }
      const auto led = [&, &vertex = v, &own_way = way](long double shift) {  // by name: Clang 14 captures no binding
        Way found;
        for (const long double cosine : {0.5L, 0.05L}) {
          found = nearest_facing(other_, at(own_, vertex), sign_ * separation.direction, cosine + shift);
          if (found.distance <= depth_ + 1e-12L + shift) return found;
        }
        return own_way;
      };
      const Way found = led(0);
      certain = (certain || separation.leads_all) && std::abs(led(kBand).distance - found.distance) <= kBand &&
                std::abs(led(-kBand).distance - found.distance) <= kBand;
      way = found;
    }
  }
  const std::map<int, int>& patches() const { return patch_; }
  bool is_cut(const VertexPair& edge) const { return hits_.contains(edge); }
  bool runs_through(const VertexPair& edge) const {
    return is_cut(edge) && hits_.at(edge).size() > 1 && !is_inside(edge.first) && !is_inside(edge.second);
  }
  bool meets_beside(const VertexPair& edge, const VertexPair& others) const {
    const auto found = hits_.find(edge);
    return found != hits_.end() && std::ranges::any_of(found->second, [&](std::size_t f) {
             const auto& c = other_.facets[f];
             return std::ranges::find(c, others.first) != c.end() && std::ranges::find(c, others.second) != c.end();
           });
  }

 private:
  // Corners of a facet that meets another, and inside vertices with an edge that is not cut, are in one patch: the
  // least number spreads.
  void find_patches() {
    std::vector<std::pair<int, int>> links;
    for (const auto& c : own_.facets) {
      if (!std::ranges::any_of(other_.facets, [&](const auto& d) { return facets_meet(c, d); })) continue;
      for (std::size_t k = 0; k < 3; ++k) links.emplace_back(c[k], c[(k + 1) % 3]);
    }
    for (const auto& [edge, _] : own_.third) {
      if (is_inside(edge.first) && is_inside(edge.second) && !is_cut(edge)) links.push_back(edge);
    }
    for (const int v : inside_) patch_[v] = v;
    for (const auto& [p, q] : links) patch_[p] = p, patch_[q] = q;
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [p, q] : links) {
        const int least = std::min(patch_[p], patch_[q]);
        changed = changed || patch_[p] != least || patch_[q] != least;
        patch_[p] = patch_[q] = least;
      }
    }
  }
  bool facets_meet(const std::array<int, 3>& c, const std::array<int, 3>& d) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (segment_meets(at(own_, c[k]), at(own_, c[(k + 1) % 3]), other_, d)) return true;
      if (segment_meets(at(other_, d[k]), at(other_, d[(k + 1) % 3]), own_, c)) return true;
    }
    return false;
  }

  // Which way a patch goes out; whether that is known of what is inside.
  std::pair<Long3, bool> facing(int v) const {
    const int patch = patch_.at(v);
    Long3 crossed = Long3::Zero(), others = Long3::Zero(), entered = Long3::Zero();
    long double crossings = 0, other_points = 0, entries = 0;
    for (const auto& [w, one] : patch_) {
      if (one != patch || !last_.contains(w)) continue;
      const bool was_inside = last_.at(w).gap < 0.0;
      (was_inside ? crossed : others) += sign_ * to_long(last_.at(w).normal);
      ++(was_inside ? crossings : other_points);
    }
    for (const auto& [edge, facets] : hits_) {
      if (patch_.at(edge.first) != patch) continue;
      for (const std::size_t f : facets) entered += normal_of(other_, other_.facets[f]), ++entries;
    }
    if (crossed.norm() > 0) return {crossed.normalized(), crossed.norm() > 0.8L * crossings};
    if (others.norm() > 0) return {others.normalized(), others.norm() > 0.8L * other_points};
    const bool agree = entries > 0 && entered.norm() > 0.8L * entries;
    return {agree ? Long3(entered.normalized()) : out_, agree || entries == 0};
  }

  // Besides, whether something tells the side: the last step, unless that way is too long by now, or the patch.
  std::pair<Way, bool> way_with(int v, long double shift) const {
    const Long3& x = at(own_, v);
    const long double limit = depth_ + 1e-12L + shift;
    const auto& [out, is_known] = facing(v);
    Way way;
    std::optional<long double> last_depth;  // if the last step names the side
    if (last_.contains(v)) {
      const Long3 carried = sign_ * to_long(last_.at(v).normal);
      const double gap = last_.at(v).gap;
      if (gap < 0.0 || carried.dot(out) >= 0) way = nearest_facing(other_, x, carried, 0.5L + shift);
      if (way.distance <= limit) last_depth = std::max(0.0, -gap);
    }
    const bool was_inside = last_depth > 0.0L, is_told = is_known || was_inside;
    if (was_inside && way.distance <= 2 * *last_depth + shift) return {way, is_told};
    if (way.distance > limit && is_known) way = nearest_facing(other_, x, out, 0.05L + shift);
    const Way nearest = nearest_facing(other_, x, out, -2);
    if (way.distance > limit) return {nearest, is_told};
    // No deeper than the last step by more than the body is thick there; without a last step straight through the body.
    const Long3 below = x - 1e-9L * nearest.out;
    const long double thickness = nearest.distance + along(other_, below, -nearest.out).distance;
    const long double deeper = way.distance - last_depth.value_or(0);
    const bool is_thick = deeper <= nearest.distance || deeper < thickness + shift;
    const bool is_straight = along(other_, below, way.out).distance > (1 - 0x1p-6L + shift) * way.distance;
    return {is_thick && (last_depth || is_straight) ? way : nearest, is_told};
  }

  // With thresholds moved to and fro: certain if that changes nothing.
  std::pair<Way, bool> way_of(int v) const {
    const auto [way, is_told] = way_with(v, 0);
    // Where nothing tells the side, the engine takes a local one.
    const bool certain = is_told && std::abs(way_with(v, kBand).first.distance - way.distance) <= kBand &&
                         std::abs(way_with(v, -kBand).first.distance - way.distance) <= kBand;
    return {way, certain};
  }

  const Shape &own_, &other_;
  Long3 out_;
  long double depth_, sign_;
  const std::map<int, LastNormals::Of>& last_;
  std::map<VertexPair, std::vector<std::size_t>> hits_;  // by edge, the other's facets
  std::set<int> inside_;
  std::map<int, int> patch_;  // its least vertex
  std::map<int, std::pair<Way, bool>> ways_;
  std::set<int> led_;
};

class EdgeOracle {
 public:
  EdgeOracle(const Shape& a, const Shape& b, const Crossed& in_b, const Crossed& in_a, const Long3& direction,
             long double depth)
      : a_(a), b_(b), in_b_(in_b), in_a_(in_a), direction_(direction), depth_(depth) {}

  std::map<std::array<int, 4>, ExpectedGap> run() const {
    std::map<std::array<int, 4>, ExpectedGap> result;
    const auto put = [&](const VertexPair& e, const VertexPair& f, const Passed& one) {
      result[{e.first, e.second, f.first, f.second}] = {-static_cast<double>(one.distance), one.certain};
    };
    std::set<VertexPair> with_point_a, with_point_b;
    for (const auto& [e, _] : a_.third) {
      for (const auto& [f, __] : b_.third) {
        if (!in_b_.meets_beside(e, f) && !in_a_.meets_beside(f, e)) continue;
        const auto one = between(e, f);
        if (!one) continue;
        put(e, f, *one);
        with_point_a.insert(e), with_point_b.insert(f);
      }
    }
    for (const auto& [e, _] : a_.third) {
      if (!in_b_.runs_through(e) || with_point_a.contains(e)) continue;
      std::optional<std::pair<VertexPair, Passed>> best;
      for (const auto& [f, __] : b_.third) {
        const auto one = between(e, f);
        if (one && (!best || one->distance < best->second.distance) && inside(b_, one->on_e)) best = {f, *one};
      }
      if (best) put(e, best->first, best->second);
    }
    for (const auto& [f, _] : b_.third) {
      if (!in_a_.runs_through(f) || with_point_b.contains(f)) continue;
      std::optional<std::pair<VertexPair, Passed>> best;
      for (const auto& [e, __] : a_.third) {
        const auto one = between(e, f);
        if (one && (!best || one->distance < best->second.distance) && inside(a_, one->on_f)) best = {e, *one};
      }
      if (best) put(best->first, f, best->second);
    }
    return result;
  }

 private:
  struct Passed {
    long double distance = 0;
    Long3 on_e, on_f;
    bool certain = false;
  };
  std::optional<Passed> between(const VertexPair& e, const VertexPair& f) const {
    const Long3 p = at(a_, e.first), u = at(a_, e.second) - p, r = at(b_, f.first), w = at(b_, f.second) - r;
    const Long3 across = u.cross(w);
    const long double square = across.squaredNorm();
    if (!(square > 0)) return {};
    const long double s = (r - p).cross(w).dot(across) / square, t = (r - p).cross(u).dot(across) / square;
    long double least = std::min({s, 1 - s, t, 1 - t});
    const long double height = across.dot(r - p) / across.norm(), distance = std::abs(height);
    const Long3 normal = (height > 0 ? -1 : 1) * across.normalized();
    for (const int c : a_.third.at(e)) least = std::min(least, -normal.dot(at(a_, c) - p));
    for (const int c : b_.third.at(f)) least = std::min(least, normal.dot(at(b_, c) - r));
    const bool is_told = in_b_.is_certain(e.first) && in_b_.is_certain(e.second) && in_a_.is_certain(f.first) &&
                         in_a_.is_certain(f.second);
    if (is_told) least = std::min(least, facing(e, f).dot(normal) - 0.05L);
    least = std::min(least, depth_ + 1e-12L - distance);
    if (least < -kBand) return {};
    return Passed{distance, p + s * u, r + t * w, is_told && least > kBand && distance > kBand};
  }
  Long3 facing(const VertexPair& e, const VertexPair& f) const {
    Long3 sum = Long3::Zero();
    for (const int v : {e.first, e.second}) {
      if (in_b_.is_inside(v)) sum -= in_b_.way(v).out;
    }
    for (const int v : {f.first, f.second}) {
      if (in_a_.is_inside(v)) sum += in_a_.way(v).out;
    }
    return sum.norm() > 0 ? Long3(sum.normalized()) : direction_;
  }

  const Shape &a_, &b_;
  const Crossed &in_b_, &in_a_;
  Long3 direction_;
  long double depth_;
};

template <class Key>
::testing::AssertionResult same_gaps(const std::map<Key, ExpectedGap>& expected, const std::map<Key, double>& found,
                                     double tolerance, const char* what) {
  const auto name = [](const Key& key) {
    if constexpr (std::is_same_v<Key, int>) {
      return std::to_string(key);
    } else {
      return std::to_string(key[0]) + "-" + std::to_string(key[1]) + " " + std::to_string(key[2]) + "-" +
             std::to_string(key[3]);
    }
  };
  for (const auto& [key, one] : expected) {
    if (!one.certain) continue;
    if (!found.contains(key))
      return ::testing::AssertionFailure() << what << " " << name(key) << " has no point, expected gap " << one.gap;
    if (!(std::abs(found.at(key) - one.gap) <= tolerance))
      return ::testing::AssertionFailure()
             << what << " " << name(key) << " has gap " << found.at(key) << ", expected " << one.gap;
  }
  for (const auto& [key, gap] : found) {
    if (!expected.contains(key))
      return ::testing::AssertionFailure() << what << " " << name(key) << " has gap " << gap << ", expected no point";
  }
  return ::testing::AssertionSuccess();
}

}  // namespace

LastNormals last_normals(const Contact& contact) {
  LastNormals last;
  std::map<int, double> gap_a, gap_b;
  for (const ContactPoint& point : contact.points()) {
    const auto &a = point.a_vertices, &b = point.b_vertices;
    const Vec3 normal{point.normal.x(), point.normal.y(), point.normal.z()};
    if (point.kind == FeaturePair::edge_edge && point.gap < 0.0) last.crossed_edges[{a[0], a[1], b[0], b[1]}] = normal;
    if (point.kind == FeaturePair::edge_edge) continue;
    const bool of_a = point.kind == FeaturePair::vertex_facet;
    const int v = of_a ? a[0] : b[0];
    auto& gaps = of_a ? gap_a : gap_b;
    if (gaps.contains(v) && gaps[v] <= point.gap) continue;
    gaps[v] = point.gap;
    (of_a ? last.of_a : last.of_b)[v] = {normal, point.gap};
  }
  return last;
}

namespace {

using VertexSets = std::map<int, int>;

// Vertices of facets that meet, a's as they are and b's below zero, by sets that facet pairs join.
VertexSets vertex_sets(const Crossed& in_b, const Crossed& in_a, std::span<const FacetPair> pairs, const Shape& a,
                       const Shape& b) {
  VertexSets set;
  for (const auto& [v, patch] : in_b.patches()) set[v] = patch;
  for (const auto& [v, patch] : in_a.patches()) set[-1 - v] = -1 - patch;
  for (bool changed = true; changed;) {
    changed = false;
    for (const FacetPair& pair : pairs) {
      const int one = set.at(a.facets[static_cast<std::size_t>(pair.a)][0]),
                other = set.at(-1 - b.facets[static_cast<std::size_t>(pair.b)][0]);
      if (one == other) continue;
      changed = true;
      for (auto& [_, root] : set) root = root == other ? one : root;
    }
  }
  return set;
}

// Sets that had negative gaps, and of whose vertices with one none is inside still, keep their direction.
void find_led(const VertexSets& set, const LastNormals& last, Crossed& in_b, Crossed& in_a) {
  std::set<int> had_crossed, go_on, led_a, led_b;
  const auto take = [&](int v, bool is_inside) {
    if (!set.contains(v)) return;
    had_crossed.insert(set.at(v));
    if (is_inside) go_on.insert(set.at(v));
  };
  for (const auto& [v, one] : last.of_a) {
    if (one.gap < 0.0) take(v, in_b.is_inside(v));
  }
  for (const auto& [v, one] : last.of_b) {
    if (one.gap < 0.0) take(-1 - v, in_a.is_inside(v));
  }
  for (const auto& [e, _] : last.crossed_edges) {
    for (const int v : {e[0], e[1], -1 - e[2], -1 - e[3]}) take(v, false);
  }
  for (const auto& [v, root] : set) {
    if (!had_crossed.contains(root) || go_on.contains(root)) continue;
    v < 0 ? led_b.insert(-1 - v) : led_a.insert(v);
  }
  in_b.set_led(std::move(led_a));
  in_a.set_led(std::move(led_b));
}

bool is_convex(const Shape& s) {
  return std::ranges::all_of(s.facets, [&](const auto& c) {
    const Long3 n = normal_of(s, c);
    return std::ranges::all_of(s.x, [&](const Long3& x) { return n.dot(x - at(s, c[0])) <= kBand; });
  });
}

// Of convex bodies if no more than a third of what had negative gaps is past the other one still, and others are.
std::optional<Separation> separation_of(const Shape& a, const Shape& b, const Crossed& in_b, const Crossed& in_a,
                                        const LastNormals& last, const Long3& direction) {
  std::vector<Long3> normals;
  std::size_t still = 0;
  for (const bool of_a : {true, false}) {
    for (const auto& [v, one] : of_a ? last.of_a : last.of_b) {
      if (one.gap >= 0.0) continue;
      normals.push_back(to_long(one.normal));
      still += (of_a ? in_b : in_a).is_inside(v) ? 1 : 0;
    }
  }
  for (const auto& [_, normal] : last.crossed_edges) normals.push_back(to_long(normal));
  const std::size_t all = in_b.inside_vertices().size() + in_a.inside_vertices().size();
  if (normals.empty() || still == all || 3 * still > normals.size() || !is_convex(a) || !is_convex(b)) return {};
  Long3 sum = Long3::Zero();
  for (const Long3& n : normals) sum += n;
  if (sum.norm() > 0.8L * static_cast<long double>(normals.size())) return Separation{sum.normalized()};
  return Separation{direction, std::ranges::any_of(normals, [&](const Long3& n) { return n.dot(direction) < 0.5L; })};
}

// Those sets that are not known to have a point: of edges that are not certain the engine may find none, and ways
// instead.
void find_without_point(const VertexSets& set, ExpectedGaps& expected) {
  std::set<int> with_point;
  for (const auto& [v, _] : expected.vertices_of_a) with_point.insert(set.at(v));
  for (const auto& [v, _] : expected.vertices_of_b) with_point.insert(set.at(-1 - v));
  for (const auto& [e, one] : expected.edges) {
    if (!one.certain) continue;
    for (const int v : {e[0], e[1], -1 - e[2], -1 - e[3]}) {
      if (set.contains(v)) with_point.insert(set.at(v));
    }
  }
  for (const auto& [v, root] : set) {
    if (!with_point.contains(root)) (v < 0 ? expected.others_of_b : expected.others_of_a)[v < 0 ? -1 - v : v] = root;
  }
}

}  // namespace

ExpectedGaps gaps_by_brute_force(const Mesh& a, const Mesh& b, const Contact& contact, const LastNormals& last) {
  const Shape shape_a = shape_of(a), shape_b = shape_of(b);
  const Long3 direction = contact.direction.cast<long double>();
  Crossed in_b(shape_a, shape_b, -direction, contact.depth, last.of_a, -1);
  Crossed in_a(shape_b, shape_a, direction, contact.depth, last.of_b, 1);
  if (const auto separation = separation_of(shape_a, shape_b, in_b, in_a, last, direction)) {
    in_b.lead(*separation);
    in_a.lead(*separation);
  }
  const VertexSets sets = vertex_sets(in_b, in_a, contact.facet_pairs(), shape_a, shape_b);
  find_led(sets, last, in_b, in_a);
  const EdgeOracle edges(shape_a, shape_b, in_b, in_a, direction, contact.depth);
  ExpectedGaps expected{in_b.gaps(), in_a.gaps(), edges.run(), {}, {}};
  find_without_point(sets, expected);
  return expected;
}

::testing::AssertionResult has_gaps(const Contact& contact, const ExpectedGaps& expected, double tolerance) {
  std::map<int, double> of_a, of_b;
  std::map<std::array<int, 4>, double> edges;
  std::set<int> without_point;  // so far
  for (const auto* others : {&expected.others_of_a, &expected.others_of_b}) {
    for (const auto& [_, crossing] : *others) without_point.insert(crossing);
  }
  for (const ContactPoint& point : contact.points()) {
    const auto &a = point.a_vertices, &b = point.b_vertices;
    bool is_other = false;
    const auto look_at = [&](const std::array<int, 3>& vertices, const std::map<int, int>& others) {
      for (const int v : vertices) {
        if (!others.contains(v)) continue;
        is_other = true;
        without_point.erase(others.at(v));
      }
    };
    const bool crosses = point.gap < 0.0;
    if (crosses) look_at(a, expected.others_of_a), look_at(b, expected.others_of_b);
    if (is_other && -point.gap > contact.depth + tolerance)
      return ::testing::AssertionFailure() << "a way apart of " << -point.gap << " is longer than " << contact.depth;
    if (is_other) continue;
    bool fresh = true;
    if (point.kind == FeaturePair::edge_edge) {
      if (crosses) fresh = edges.try_emplace({a[0], a[1], b[0], b[1]}, point.gap).second;
    } else {
      const bool is_a = point.kind == FeaturePair::vertex_facet;
      auto& vertices = is_a ? of_a : of_b;
      const int v = is_a ? a[0] : b[0];
      if (crosses) fresh = vertices.try_emplace(v, point.gap).second;
      const auto& inside = is_a ? expected.vertices_of_a : expected.vertices_of_b;
      if (!crosses && point.gap > tolerance && inside.contains(v) && inside.at(v).certain)
        return ::testing::AssertionFailure() << "vertex " << v << " is inside and has gap " << point.gap;
    }
    if (!fresh) return ::testing::AssertionFailure() << "a point stands twice, gap " << point.gap;
  }
  for (const auto& result : {same_gaps(expected.vertices_of_a, of_a, tolerance, "vertex of a"),
                             same_gaps(expected.vertices_of_b, of_b, tolerance, "vertex of b"),
                             same_gaps(expected.edges, edges, tolerance, "edges")}) {
    if (!result) return result;
  }
  if (!without_point.empty()) return ::testing::AssertionFailure() << "a crossing has no point";
  return ::testing::AssertionSuccess();
}

}  // namespace tact::tests
