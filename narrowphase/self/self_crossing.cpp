#include "narrowphase/self/self_crossing.h"

#include <algorithm>
#include <numbers>
#include <tuple>

#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {
// As in crossing.cpp: a facet that stands along a side to 3 degrees does not face it.
constexpr double kFaces = 0.05;
// What is nearer touches: rounding would choose its side. Lengths are near 1.
constexpr double kTouches = 1e-12;
constexpr double kAnywhere = 16.0;  // beyond the mesh, whose lengths are at most 2

double negative(double distance) { return distance > 0.0 ? -distance : 0.0; }

std::span<const int> used(const std::array<int, 3>& feature) {
  return std::span(feature).first(std::ranges::find(feature, -1) - feature.begin());
}

}  // namespace

void SelfCrossing::run(const SelfCrossingInput& input, std::vector<FeaturePoint>& found) {
  begin(input);
  sides_.find(mesh(), input_, hits_);
  find_crossed();
  drop_vertex_points(found);
  sign_edges(found);
  append_edges(found);
  append_vertices(found);
}

void SelfCrossing::begin(const SelfCrossingInput& input) {
  input_ = input;
  const Vec3 size = input.mesh.mesh->box().upper - input.mesh.mesh->box().lower;
  scale_ = unit_scale(std::max({size.x, size.y, size.z}));
  if (nearest_ == nullptr) nearest_ = std::make_unique<NearestAround>(*input.mesh.mesh);
  crossed_at_.clear(input.mesh.mesh->source_vertex_count());
  crossed_.clear();
  edge_hits_.run(input.mesh, input.mesh, input.facet_pairs, hits_, hits_of_second_);
  hits_.insert(hits_.end(), hits_of_second_.begin(), hits_of_second_.end());
  std::ranges::sort(hits_);
  hits_.erase(std::unique(hits_.begin(), hits_.end()), hits_.end());
  limit_ = limit();
}

double SelfCrossing::limit() const {
  if (input_.surface == SurfaceKind::closed) return kAnywhere;
  double longest = 0.0;
  for (const EdgeHit& hit : hits_) {
    const EdgeVertices ends = input_.mesh.features->edge(hit.edge);
    longest = std::max(longest, norm(mesh().position(ends[1]) - mesh().position(ends[0])));
  }
  return longest;
}

EdgeVertices SelfCrossing::source_ends(int edge) const {
  const EdgeVertices ends = input_.mesh.features->edge(edge);
  return {input_.mesh.mesh->source_vertex(ends[0]), input_.mesh.mesh->source_vertex(ends[1])};
}

SelfCrossing::EdgePair SelfCrossing::edge_pair(int edge, int other_edge) const {
  return source_ends(edge) < source_ends(other_edge) ? EdgePair{edge, other_edge} : EdgePair{other_edge, edge};
}

std::span<const EdgeHit> SelfCrossing::hits_of(const EdgeVertices& vertices) const {
  return {std::ranges::lower_bound(hits_, vertices, {}, &EdgeHit::vertices),
          std::ranges::upper_bound(hits_, vertices, {}, &EdgeHit::vertices)};
}

const SelfCrossing::Crossed* SelfCrossing::crossed(int source_vertex) const {
  const int at = crossed_at_[source_vertex];
  return at < 0 ? nullptr : &crossed_[at];
}

bool SelfCrossing::along_surface(std::span<const int> from, Vec3 from_point, std::span<const int> to, Vec3 to_point) {
  const double limit = 0.5 * std::numbers::pi * (scale_ * input_.reach);
  return input_.reach > 0.0 && surface_distance_below(limit, *input_.mesh.mesh, *input_.mesh.features, scale_,
                                                      {from, from_point}, {to, to_point}, ways_);
}

void SelfCrossing::find_crossed() {
  reach_from_hits();
  while (!reached_.empty()) {
    take_reached();
    spread();
  }
}

void SelfCrossing::reach_from_hits() {
  const ClusteredMesh& m = *input_.mesh.mesh;
  reached_.clear();
  PredicateCounts counts;
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const EdgeHit& hit = hits_[i];
    const double along = dot(unit_normal_of_source(mesh(), hit.facet), sides_.sides()[i]);
    if (std::abs(along) <= kFaces) continue;
    const int facet = m.facet_of_source(hit.facet);
    const Triangle t = m.triangle(facet);
    const EdgeVertices ends = input_.mesh.features->edge(hit.edge);
    for (std::size_t k = 0; k < 2; ++k) {
      const int below = orient3d(t[0], t[1], t[2], m.position(ends[k]), counts);
      if (below == (along > 0.0 ? 1 : -1)) reached_.push_back({hit.vertices[k], ends[k], facet, sides_.sides()[i]});
    }
  }
}

// In the order of the caller's numbers, so that no answer depends on how facets are grouped.
void SelfCrossing::take_reached() {
  const ClusteredMesh& m = *input_.mesh.mesh;
  std::ranges::sort(reached_, {}, [&](const Reached& one) {
    return std::tuple(one.source_vertex, m.source_facet(one.from), one.side.x, one.side.y, one.side.z);
  });
  next_.clear();
  for (std::size_t i = 0; i < reached_.size();) {
    const int source = reached_[i].source_vertex, vertex = reached_[i].vertex;
    std::optional<WayOut> best;
    for (; i < reached_.size() && reached_[i].source_vertex == source; ++i) {
      if (crossed(source) != nullptr) continue;
      const auto way = way_out(reached_[i]);
      if (way && (!best || way->distance < best->distance)) best = way;
    }
    if (!best) continue;
    crossed_at_.set(source, crossed_.size());
    crossed_.push_back({source, *best});
    next_.push_back({source, vertex, best->facet, best->out});
  }
}

std::optional<WayOut> SelfCrossing::way_out(const Reached& reached) {
  const Vec3 v = mesh().position(reached.vertex);
  auto way = nearest_->find(mesh(), reached.vertex, reached.from);
  if (!way || way->distance <= kTouches) return {};
  if (nearest_->is_beside(*input_.mesh.mesh, reached.vertex, *way)) return {};
  const double height = -dot(nearest_->normal_at(mesh(), *way), way->out);
  const int source_facet = input_.mesh.mesh->source_facet(way->facet);
  const double along = dot(unit_normal_of_source(mesh(), source_facet), reached.side);
  if (!(along > 0.0 ? height < 0.0 : along < 0.0 && height > 0.0)) return {};
  const auto corners = source_corners(*input_.mesh.mesh, source_facet);
  const double known = dot(sides_.last_points().side({&reached.source_vertex, 1}, corners), way->out);
  if (known < 0.0 || (known == 0.0 && way->distance > limit_)) return {};
  if (along_surface({&reached.vertex, 1}, v, used(way->feature), v + way->distance * way->out)) return {};
  return way;
}

void SelfCrossing::spread() {
  reached_.clear();
  for (const Reached& one : next_) {
    for (const int to : input_.mesh.features->neighbors(one.vertex)) {
      const int source = input_.mesh.mesh->source_vertex(to);
      const auto [first, second] = std::minmax(one.source_vertex, source);
      if (crossed(source) == nullptr && hits_of({first, second}).empty())
        reached_.push_back({source, to, one.from, one.side});
    }
  }
}

void SelfCrossing::drop_vertex_points(std::vector<FeaturePoint>& found) const {
  std::erase_if(found, [&](const FeaturePoint& point) {
    if (point.kind != FeaturePair::vertex_facet) return false;
    const Crossed* one = crossed(point.a[0]);
    return one != nullptr && dot(point.normal, one->way.out) >= 0.0;
  });
}

// The sum of the ways out of an edge's ends.
Vec3 SelfCrossing::way_back(int edge) const {
  Vec3 sum;
  for (const int v : source_ends(edge)) {
    if (const Crossed* one = crossed(v)) sum = sum + one->way.out;
  }
  return sum;
}

// `place` is 0 at the edge's first end and 1 at its second.
bool SelfCrossing::is_on_crossed_piece(int edge, double place) const {
  const EdgeVertices ends = source_ends(edge);
  double first = 1.0, last = 0.0;  // where it meets something
  for (const EdgeHit& hit : hits_of(ends)) {
    const Corners c = input_.mesh.mesh->corners(input_.mesh.mesh->facet_of_source(hit.facet));
    const Vec3 corner = mesh().position(c[0]);
    const Vec3 normal = cross(mesh().position(c[1]) - corner, mesh().position(c[2]) - corner);
    const EdgeVertices e = input_.mesh.features->edge(edge);
    const double p = dot(normal, mesh().position(e[0]) - corner), q = dot(normal, mesh().position(e[1]) - corner);
    const double at = p != q ? p / (p - q) : 0.5;
    first = std::min(first, at);
    last = std::max(last, at);
  }
  return (crossed(ends[0]) != nullptr && place < first) || (crossed(ends[1]) != nullptr && place > last);
}

bool SelfCrossing::meets_beside(int edge, int other_edge) const {
  const EdgeVertices ends = source_ends(other_edge);
  return std::ranges::any_of(hits_of(source_ends(edge)), [&](const EdgeHit& hit) {
    const auto corners = source_corners(*input_.mesh.mesh, hit.facet);
    return std::ranges::all_of(ends, [&](int v) { return std::ranges::find(corners, v) != corners.end(); });
  });
}

bool SelfCrossing::have_passed(const FeaturePoint& point) const {
  if (meets_beside(point.edge_a, point.edge_b) || meets_beside(point.edge_b, point.edge_a)) return true;
  return (is_on_crossed_piece(point.edge_a, point.weight_a[1]) && dot(way_back(point.edge_a), point.normal) >= 0.0) ||
         (is_on_crossed_piece(point.edge_b, point.weight_b[1]) && dot(way_back(point.edge_b), point.normal) <= 0.0);
}

// From the first edge to the second, as they lay before: what their ends say, or the facets that they meet.
Vec3 SelfCrossing::sides_of(const EdgePair& edges) const {
  Vec3 sum = way_back(edges.second) - way_back(edges.first);
  if (sum == Vec3{}) {
    for (const auto& [edge, other, sign] :
         {std::tuple(edges.first, edges.second, -1.0), std::tuple(edges.second, edges.first, 1.0)}) {
      const EdgeVertices ends = source_ends(other);
      for (const EdgeHit& hit : hits_of(source_ends(edge))) {
        const auto corners = source_corners(*input_.mesh.mesh, hit.facet);
        if (std::ranges::all_of(ends, [&](int v) { return std::ranges::find(corners, v) != corners.end(); }))
          sum = sum + sign * sides_.sides()[&hit - hits_.data()];
      }
    }
  }
  const double length = norm(sum);
  return length > 0.0 ? (1.0 / length) * sum : Vec3{};
}

std::optional<FeaturePoint> SelfCrossing::passed_point(const EdgePair& edges) {
  const ScaledMesh m = mesh();
  const EdgeVertices e = m.features.edge(edges.first), f = m.features.edge(edges.second);
  if (share_a_vertex(e, f)) return {};
  const EdgeEnds at_e{m.position(e[0]), m.position(e[1])}, at_f{m.position(f[0]), m.position(f[1])};
  const auto nearest = nearest_between_edges(at_e, m.around(m.features.opposite(edges.first)), at_f,
                                             m.around(m.features.opposite(edges.second)), kAnywhere, EdgeSide::passed);
  if (!nearest || nearest->distance <= kTouches || dot(nearest->normal, sides_of(edges)) <= kFaces) return {};
  const EdgeVertices a = source_ends(edges.first), b = source_ends(edges.second);
  if (nearest->distance > limit_ && !(dot(sides_.last_points().side(b, a), nearest->normal) > 0.0)) return {};
  const Vec3 on_e = nearest->first[0] * at_e.p + nearest->first[1] * at_e.q;
  if (along_surface(e, on_e, f, on_e - nearest->distance * nearest->normal)) return {};
  return point_of_edges(*nearest, {a[0], a[1], -1}, {b[0], b[1], -1}, edges.first, edges.second,
                        negative(nearest->distance / scale_));
}

void SelfCrossing::sign_edges(std::vector<FeaturePoint>& found) {
  known_.clear();
  std::size_t kept = 0;
  for (FeaturePoint& point : found) {
    if (point.kind == FeaturePair::edge_edge) {
      const EdgePair edges{point.edge_a, point.edge_b};
      known_.push_back(edges);
      if (scale_ * point.gap > kTouches && have_passed(point)) {
        const auto passed = passed_point(edges);
        if (!passed) continue;
        point = *passed;
      }
    }
    found[kept++] = point;
  }
  found.resize(kept);
  std::ranges::sort(known_);
}

void SelfCrossing::append_edges(std::vector<FeaturePoint>& found) {
  candidates_.clear();
  for (const EdgeHit& hit : hits_) {
    const int facet = input_.mesh.mesh->facet_of_source(hit.facet);
    for (int k = 0; k < 3; ++k) {
      const int edge = input_.mesh.features->facet_edge(facet, k);
      if (edge >= 0) candidates_.push_back(edge_pair(hit.edge, edge));
    }
  }
  std::ranges::sort(candidates_);
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  for (const EdgePair& edges : candidates_) {
    if (std::ranges::binary_search(known_, edges)) continue;
    if (const auto point = passed_point(edges)) found.push_back(*point);
  }
}

void SelfCrossing::append_vertices(std::vector<FeaturePoint>& found) const {
  for (const Crossed& one : crossed_) {
    found.push_back({.kind = FeaturePair::vertex_facet,
                     .a = {one.source_vertex, -1, -1},
                     .b = source_vertices(*input_.mesh.mesh, used(one.way.feature)),
                     .weight_a = {1.0, 0.0, 0.0},
                     .weight_b = one.way.feature_weight,
                     .normal = -one.way.out,
                     .gap = negative(one.way.distance / scale_)});
  }
}

}  // namespace tact::narrowphase
