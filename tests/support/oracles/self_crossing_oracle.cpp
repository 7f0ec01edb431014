#include "tests/support/oracles/self_crossing_oracle.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::tests {

namespace {

using Long3 = Eigen::Matrix<long double, 3, 1>;
using Edge = std::pair<int, int>;
using Facet = std::array<int, 3>;

struct Place {
  long double distance = 0;
  Long3 at = Long3::Zero();
  std::array<int, 3> feature{-1, -1, -1};
  std::size_t facet = 0;
};

// A vertex, and the way to where it belongs.
struct Way {
  Place place;
  Long3 out = Long3::Zero();
};

bool has(const Facet& facet, int v) { return std::ranges::find(facet, v) != facet.end(); }
bool has_some(const std::array<int, 3>& some, const Facet& facet) {
  return std::ranges::any_of(some, [&](int v) { return v >= 0 && has(facet, v); });
}

class SelfCrossingOracle {
 public:
  SelfCrossingOracle(const Mesh& mesh, Surface surface, double reach, double band, std::span<const ContactPoint> last)
      : mesh_(mesh), surface_(surface), reach_(reach), band_(band), last_(last) {
    for (int v = 0; v < mesh.vertex_count(); ++v) x_.push_back(to_long(mesh.positions.col(v)));
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const Facet c{mesh.facets(0, f), mesh.facets(1, f), mesh.facets(2, f)};
      facets_.push_back(c);
      for (std::size_t k = 0; k < 3; ++k) {
        third_[std::minmax(c[k], c[(k + 1) % 3])].push_back(c[(k + 2) % 3]);
        around_[c[k]].push_back(facets_.size() - 1);
      }
    }
    pairs_ = self_facet_pairs_by_oracle(mesh);
    std::erase_if(pairs_, [&](const FacetPair& pair) { return has_some(facets_[pair.a], facets_[pair.b]); });
    find_hits();
    find_layers();
    find_sides();
    find_crossed();
  }

  std::map<PointKey, ExpectedPoint> run() const {
    std::map<PointKey, ExpectedPoint> result;
    const std::map<PointKey, ExpectedPoint> near =
        reach_ > 0 ? self_points_by_brute_force(mesh_, static_cast<double>(reach_), band_)
                   : std::map<PointKey, ExpectedPoint>();
    std::set<std::pair<Edge, Edge>> looked_at;
    for (const auto& [key, point] : near) {
      const auto& [kind, a, b] = key;
      const Long3 way = to_long(point.b) - to_long(point.a);
      if (kind == FeaturePair::vertex_facet) {
        const auto crossed = ways_.find(a[0]);
        if (crossed == ways_.end() || way.dot(crossed->second.out) < 0) result[key] = point;
        continue;
      }
      const Edge e{a[0], a[1]}, f{b[0], b[1]};
      looked_at.emplace(e, f);
      const bool passed =
          std::abs(point.gap) > band_ && (meets_beside(e, f) || meets_beside(f, e) ||
                                          (on_crossed_piece(e, to_long(point.a)) && way.dot(way_back(e)) >= 0) ||
                                          (on_crossed_piece(f, to_long(point.b)) && way.dot(way_back(f)) <= 0));
      if (passed) {
        put_passed(e, f, result);
      } else {
        result[key] = point;
      }
    }
    for (const auto& [e, _] : third_) {
      for (const auto& [f, __] : third_) {
        if (e < f && (meets_beside(e, f) || meets_beside(f, e)) && !looked_at.contains({e, f}))
          put_passed(e, f, result);
      }
    }
    for (const auto& [v, way] : ways_)
      result[{FeaturePair::vertex_facet, {v, -1, -1}, way.place.feature}] = {
          to_vec3(x_[v]), to_vec3(way.place.at), -static_cast<double>(way.place.distance), true};
    return result;
  }

 private:
  struct Hit {
    Edge edge;
    std::size_t facet;
    long double where;  // 0 at the edge's first vertex, 1 at its second
    Long3 side;         // on which the edge belongs
  };

  const Long3& at(int v) const { return x_[v]; }
  Long3 normal_of(const Facet& c) const {
    const Long3 n = (at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0]));
    return n.norm() > 0 ? Long3(n.normalized()) : Long3(Long3::Zero());
  }

  void find_hits() {
    std::set<std::pair<Edge, std::size_t>> found;
    const auto look_at = [&](const Facet& own, std::size_t other) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge edge = std::minmax(own[k], own[(k + 1) % 3]);
        const Facet& c = facets_[other];
        const Long3 p = at(edge.first), q = at(edge.second), n = normal_of(c);
        const long double above = n.dot(p - at(c[0])), below = n.dot(q - at(c[0]));
        if (above * below > 0) continue;
        const auto volume = [&](int u, int v) { return (q - p).dot((at(u) - p).cross(at(v) - p)); };
        const long double i = volume(c[0], c[1]), j = volume(c[1], c[2]), l = volume(c[2], c[0]);
        if (!((i >= 0 && j >= 0 && l >= 0) || (i <= 0 && j <= 0 && l <= 0))) continue;
        if (found.emplace(edge, other).second) hits_.push_back({edge, other, above / (above - below), Long3::Zero()});
      }
    };
    for (const FacetPair& pair : pairs_) {
      look_at(facets_[pair.a], static_cast<std::size_t>(pair.b));
      look_at(facets_[pair.b], static_cast<std::size_t>(pair.a));
    }
  }

  // Colours spread over facets that meet, from the least facet of each line.
  void find_layers() {
    std::map<int, std::vector<int>> met;
    for (const FacetPair& pair : pairs_) met[pair.a].push_back(pair.b), met[pair.b].push_back(pair.a);
    for (const auto& [first, _] : met) {
      if (layer_.contains(first)) continue;
      std::vector<int> line{first};
      layer_[first] = 1;
      bool mixed = false;
      for (std::size_t i = 0; i < line.size(); ++i) {
        for (const int other : met.at(line[i])) {
          if (layer_.try_emplace(other, -layer_[line[i]]).second) {
            line.push_back(other);
          } else {
            mixed = mixed || layer_[other] == layer_[line[i]];
          }
        }
      }
      for (const int f : line) {
        line_[f] = first;
        if (mixed) mixed_.insert(f);
      }
    }
  }

  Long3 remembered(const std::set<int>& own, const Facet& other) const {
    Long3 sum = Long3::Zero();
    for (const ContactPoint& point : last_) {
      const auto of_own = [&](const std::array<int, 3>& some) {
        return std::ranges::any_of(some, [&](int v) { return v >= 0 && own.contains(v); });
      };
      if (of_own(point.a_vertices) && has_some(point.b_vertices, other)) sum -= to_long(point.normal);
      if (of_own(point.b_vertices) && has_some(point.a_vertices, other)) sum += to_long(point.normal);
    }
    return sum;
  }

  void find_sides() {
    std::map<int, Long3> known, guessed;
    std::vector<Long3> guesses;
    const auto add = [&](std::map<int, Long3>& sums, int f, const Long3& one) {
      sums.try_emplace(line_.at(f), Long3::Zero()).first->second += layer_.at(f) * one;
    };
    for (Hit& hit : hits_) {
      const int f = static_cast<int>(hit.facet);
      const Long3 normal = normal_of(facets_[hit.facet]);
      const long double p = normal.dot(at(hit.edge.first) - at(facets_[hit.facet][0])),
                        q = normal.dot(at(hit.edge.second) - at(facets_[hit.facet][0]));
      guesses.push_back((p + q) / (std::abs(p) + std::abs(q)) * normal);
      if (surface_ == Surface::closed) {
        hit.side = normal;
        continue;
      }
      hit.side = remembered({hit.edge.first, hit.edge.second}, facets_[hit.facet]);
      if (!mixed_.contains(f)) add(known, f, hit.side), add(guessed, f, guesses.back());
    }
    std::map<int, std::set<int>> beyond, before;
    for (const Hit& hit : hits_) {
      const int f = static_cast<int>(hit.facet);
      if (surface_ == Surface::closed || mixed_.contains(f)) continue;
      const Long3 normal = normal_of(facets_[hit.facet]);
      const long double along = layer_.at(f) * normal.dot(guessed.at(line_.at(f)));
      for (const int v : {hit.edge.first, hit.edge.second})
        (along * normal.dot(at(v) - at(facets_[hit.facet][0])) < 0 ? beyond : before)[line_.at(f)].insert(v);
    }
    for (auto& [line, sum] : guessed) {
      if (beyond[line].size() > before[line].size()) sum = -sum;
    }
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      Hit& hit = hits_[i];
      const int f = static_cast<int>(hit.facet);
      if (hit.side.norm() == 0) {
        const bool mixed = mixed_.contains(f);
        const bool is_known = !mixed && known.at(line_.at(f)).norm() > 0;
        hit.side = is_known ? Long3(layer_.at(f) * known.at(line_.at(f)))
                   : mixed  ? guesses[i]
                            : Long3(layer_.at(f) * guessed.at(line_.at(f)));
      }
      if (hit.side.norm() > 0) hit.side.normalize();
    }
  }

  Place nearest_in(std::size_t facet, const Long3& v) const {
    const Facet& c = facets_[facet];
    const Long3 n = normal_of(c), foot = v - n.dot(v - at(c[0])) * n;
    Place place;
    place.facet = facet;
    bool within = true;
    for (std::size_t k = 0; k < 3; ++k)
      within = within && n.dot((at(c[(k + 1) % 3]) - at(c[k])).cross(foot - at(c[k]))) > 0;
    if (within) {
      place.feature = c;
      place.at = foot;
      place.distance = (foot - v).norm();
      return place;
    }
    place.distance = std::numeric_limits<long double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = std::minmax(c[k], c[(k + 1) % 3]);
      const Long3 along = at(j) - at(i);
      const long double t = std::clamp((v - at(i)).dot(along) / along.squaredNorm(), 0.0L, 1.0L);
      const Long3 p = at(i) + t * along;
      if ((p - v).norm() >= place.distance) continue;
      place.at = p;
      place.distance = (p - v).norm();
      place.feature = t <= 0 ? std::array{i, -1, -1} : t >= 1 ? std::array{j, -1, -1} : std::array{i, j, -1};
    }
    return place;
  }

  std::optional<Place> nearest_around(int v, std::size_t from) const {
    if (has(facets_[from], v) || normal_of(facets_[from]).norm() == 0) return {};
    Place best = nearest_in(from, at(v));
    const long double within = best.distance + band_;
    std::set<std::size_t> seen{from};
    for (std::vector<std::size_t> next{from}; !next.empty();) {
      const std::size_t f = next.back();
      next.pop_back();
      for (const int corner : facets_[f]) {
        for (const std::size_t g : around_.at(corner)) {
          if (!seen.insert(g).second || has(facets_[g], v) || normal_of(facets_[g]).norm() == 0) continue;
          const Place place = nearest_in(g, at(v));
          if (place.distance > within) continue;
          next.push_back(g);
          if (place.distance < best.distance || (place.distance == best.distance && g < best.facet)) best = place;
        }
      }
    }
    for (const std::size_t g : around_.at(best.feature[0])) {
      const bool has_all = std::ranges::all_of(best.feature, [&](int w) { return w < 0 || has(facets_[g], w); });
      if (has_all && normal_of(facets_[g]).norm() > 0) {
        best.facet = g;
        break;
      }
    }
    return best;
  }

  // Of a place: the sum of the normals around it, by their angles there; zero on the border.
  Long3 normal_at(const Place& place) const {
    const auto count = std::ranges::count_if(place.feature, [](int v) { return v >= 0; });
    if (count == 3) return normal_of(facets_[place.facet]);
    Long3 sum = Long3::Zero();
    for (const std::size_t f : around_.at(place.feature[0])) {
      const Facet& c = facets_[f];
      if (count == 2) {
        if (has(c, place.feature[1])) sum += normal_of(c);
        continue;
      }
      const auto k = static_cast<std::size_t>(std::ranges::find(c, place.feature[0]) - c.begin());
      const Long3 p = (at(c[(k + 1) % 3]) - at(c[k])).normalized(), q = (at(c[(k + 2) % 3]) - at(c[k])).normalized();
      for (const int w : {c[(k + 1) % 3], c[(k + 2) % 3]}) {
        if (third_.at(std::minmax(c[k], w)).size() == 1) return Long3::Zero();
      }
      sum += std::acos(std::clamp(p.dot(q), -1.0L, 1.0L)) * normal_of(c);
    }
    if (count == 2 && third_.at({place.feature[0], place.feature[1]}).size() == 1) return Long3::Zero();
    return sum;
  }

  std::optional<Way> way_out(int v, std::size_t from, const Long3& side) const {
    const auto place = nearest_around(v, from);
    if (!place || place->distance <= band_) return {};
    for (const std::size_t f : around_.at(v)) {
      if (std::ranges::all_of(place->feature, [&](int w) { return w < 0 || has(facets_[f], w); })) return {};
    }
    const Long3 out = (place->at - at(v)).normalized(), normal = normal_at(*place);
    // The facet that was chosen says which way `side` shows.
    const long double along = normal_of(facets_[place->facet]).dot(side), height = -normal.dot(out);
    if (!((along > 0 && height < 0) || (along < 0 && height > 0))) return {};
    const long double known = remembered({v}, facets_[place->facet]).dot(out);
    if (known < 0 || (known == 0 && place->distance > limit())) return {};
    if (is_near_along({v, -1, -1}, at(v), place->feature, place->at)) return {};
    return Way{*place, out};
  }

  long double limit() const {
    if (surface_ == Surface::closed) return std::numeric_limits<long double>::infinity();
    long double longest = 0;
    for (const Hit& hit : hits_) longest = std::max(longest, (at(hit.edge.first) - at(hit.edge.second)).norm());
    return longest;
  }

  bool is_near_along(const std::array<int, 3>& a, const Long3& p, const std::array<int, 3>& b, const Long3& q) const {
    if (!(reach_ > 0)) return false;
    return way_along_edges(mesh_, a, to_vec3(p), b, to_vec3(q)) < 0.5L * std::numbers::pi_v<long double> * reach_;
  }

  void find_crossed() {
    struct Reached {
      std::size_t from;
      Long3 side;
    };
    std::map<int, std::vector<Reached>> reached;
    for (const Hit& hit : hits_) {
      const Long3 normal = normal_of(facets_[hit.facet]);
      const long double along = normal.dot(hit.side);
      if (std::abs(along) <= 0.05L) continue;
      for (const int v : {hit.edge.first, hit.edge.second}) {
        const long double height = normal.dot(at(v) - at(facets_[hit.facet][0]));
        if ((along > 0 && height < 0) || (along < 0 && height > 0)) reached[v].push_back({hit.facet, hit.side});
      }
    }
    while (!reached.empty()) {
      std::map<int, Way> found;
      for (const auto& [v, ways] : reached) {
        for (const Reached& one : ways) {
          const auto way = way_out(v, one.from, one.side);
          if (way && (!found.contains(v) || way->place.distance < found.at(v).place.distance)) found[v] = *way;
        }
      }
      ways_.insert(found.begin(), found.end());
      reached.clear();
      for (const auto& [v, way] : found) {
        for (const auto& [edge, _] : third_) {
          if (edge.first != v && edge.second != v) continue;
          const int w = edge.first == v ? edge.second : edge.first;
          if (!ways_.contains(w) && !is_cut(edge)) reached[w].push_back({way.place.facet, way.out});
        }
      }
    }
  }

  bool is_cut(const Edge& edge) const {
    return std::ranges::any_of(hits_, [&](const Hit& hit) { return hit.edge == edge; });
  }
  bool meets_beside(const Edge& edge, const Edge& other) const {
    return std::ranges::any_of(hits_, [&](const Hit& hit) {
      return hit.edge == edge && has(facets_[hit.facet], other.first) && has(facets_[hit.facet], other.second);
    });
  }
  bool on_crossed_piece(const Edge& edge, const Long3& p) const {
    const long double place = (p - at(edge.first)).norm() / (at(edge.second) - at(edge.first)).norm();
    long double first = 1, last = 0;
    for (const Hit& hit : hits_) {
      if (hit.edge == edge) first = std::min(first, hit.where), last = std::max(last, hit.where);
    }
    return (ways_.contains(edge.first) && place < first) || (ways_.contains(edge.second) && place > last);
  }
  Long3 way_back(const Edge& edge) const {
    Long3 sum = Long3::Zero();
    for (const int v : {edge.first, edge.second}) {
      if (ways_.contains(v)) sum += ways_.at(v).out;
    }
    return sum;
  }
  Long3 sides_of(const Edge& e, const Edge& f) const {
    Long3 sum = way_back(f) - way_back(e);
    if (sum.norm() > 0) return sum.normalized();
    for (const Hit& hit : hits_) {
      const Facet& c = facets_[hit.facet];
      if (hit.edge == e && has(c, f.first) && has(c, f.second)) sum -= hit.side;
      if (hit.edge == f && has(c, e.first) && has(c, e.second)) sum += hit.side;
    }
    return sum.norm() > 0 ? Long3(sum.normalized()) : Long3(Long3::Zero());
  }

  void put_passed(const Edge& e, const Edge& f, std::map<PointKey, ExpectedPoint>& result) const {
    if (e.first == f.first || e.first == f.second || e.second == f.first || e.second == f.second) return;
    const Long3 p = at(e.first), u = at(e.second) - p, r = at(f.first), w = at(f.second) - r, across = u.cross(w);
    const long double square = across.squaredNorm();
    if (!(square > 0)) return;
    const long double s = (r - p).cross(w).dot(across) / square, t = (r - p).cross(u).dot(across) / square;
    if (!(s > 0 && s < 1 && t > 0 && t < 1)) return;
    const long double height = across.dot(r - p) / across.norm();
    const Long3 normal = (height > 0 ? -1 : 1) * across.normalized();
    for (const int c : third_.at(e)) {
      if (normal.dot(at(c) - p) > 0) return;
    }
    for (const int c : third_.at(f)) {
      if (normal.dot(at(c) - r) < 0) return;
    }
    if (std::abs(height) <= band_ || normal.dot(sides_of(e, f)) <= 0.05L) return;
    const Long3 on_e = p + s * u, on_f = r + t * w;
    const std::array<int, 3> a{e.first, e.second, -1}, b{f.first, f.second, -1};
    if (std::abs(height) > limit() && !(remembered({f.first, f.second}, a).dot(normal) > 0)) return;
    if (is_near_along(a, on_e, b, on_f)) return;
    result[{FeaturePair::edge_edge, a, b}] = {to_vec3(on_e), to_vec3(on_f), -static_cast<double>(std::abs(height)),
                                              true};
  }

  static Vec3 to_vec3(const Long3& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
  }
  static Long3 to_long(const Vec3& v) { return {v.x, v.y, v.z}; }
  static Long3 to_long(const Eigen::Vector3d& v) { return v.cast<long double>(); }

  const Mesh& mesh_;
  Surface surface_;
  long double reach_;
  double band_;
  std::span<const ContactPoint> last_;
  std::vector<Long3> x_;
  std::vector<Facet> facets_;
  std::map<Edge, std::vector<int>> third_;
  std::map<int, std::vector<std::size_t>> around_;
  std::vector<FacetPair> pairs_;
  std::vector<Hit> hits_;
  std::map<int, int> layer_, line_;
  std::set<int> mixed_;
  std::map<int, Way> ways_;
};

}  // namespace

std::map<PointKey, ExpectedPoint> self_points_with_gaps(const Mesh& mesh, Surface surface, double reach, double band,
                                                        std::span<const ContactPoint> last) {
  return SelfCrossingOracle(mesh, surface, reach, band, last).run();
}

}  // namespace tact::tests
