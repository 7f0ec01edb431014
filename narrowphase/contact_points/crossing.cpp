#include "narrowphase/contact_points/crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/queries/mesh_queries.h"

namespace tact::narrowphase {

namespace {

// A vertex keeps to facets within 60 degrees of its last normal: a wall at a right angle to them stays another side
// however the body turns in a step.
constexpr double kSameSide = 0.5;
// Facets that stand along a part's direction to 3 degrees do not face it: rounding would choose between them.
constexpr double kFaces = 0.05;
// The facets through which a part comes in agree on a direction if their mean normal is so long: those of a cap of 37
// degrees do, two walls at a right angle do not.
constexpr double kAgree = 0.8;
// How far beyond the hulls' depth a way may seem to be by rounding; lengths are near 1.
constexpr double kDepthRounding = 1e-12;
constexpr double kAnywhere = 16.0;  // beyond both meshes, whose lengths are at most 2

Vec3 unit_or(Vec3 v, Vec3 otherwise) {
  const double length = norm(v);
  return length > 0.0 ? (1.0 / length) * v : otherwise;
}

EdgeEnds ends_of(const ScaledMesh& m, int edge) {
  const EdgeVertices ends = m.features.edge(edge);
  return {m.position(ends[0]), m.position(ends[1])};
}

EdgeVertices source_ends(const FeaturedMesh& m, int edge) {
  const EdgeVertices ends = m.features->edge(edge);
  return {m.mesh->source_vertex(ends[0]), m.mesh->source_vertex(ends[1])};
}

std::span<const int> used(const std::array<int, 3>& feature) {
  return std::span(feature).first(std::ranges::find(feature, -1) - feature.begin());
}

double negative(double distance) { return distance > 0.0 ? -distance : 0.0; }

}  // namespace

bool is_contained(const FeaturedMesh& inner, const ClusteredMesh& outer) {
  const Box &in = inner.mesh->box(), &out = outer.box();
  if (in.empty() || !contains(out, in.lower) || !contains(out, in.upper)) return false;
  return std::ranges::all_of(inner.features->one_of_each_part(),
                             [&](int v) { return contains(outer, inner.mesh->position(v)); });
}

const CarriedNormal* CrossingSearch::Side::carried_normal(int source_vertex) const {
  const int place = carried_at[source_vertex];
  return place < 0 ? nullptr : &carried[place];
}

const CrossingSearch::Crossed* CrossingSearch::Side::find(int source_vertex) const {
  const int place = crossed_at[source_vertex];
  return place < 0 ? nullptr : &crossed[place];
}

void CrossingSearch::Side::mark_crossed() {
  has_crossed.assign(static_cast<std::size_t>(mesh.mesh->vertex_count()) / 64 + 1, 0);
  for (const Crossed& one : crossed) {
    const auto vertex = static_cast<std::size_t>(mesh.features->vertex_of_source(one.source_vertex));
    has_crossed[vertex / 64] |= std::uint64_t{1} << vertex % 64;
  }
}

CrossedVertices CrossingSearch::begin(const CrossingInput& input) {
  const Box whole = merged(input.a.mesh->box(), input.b.mesh->box());
  const Vec3 size = whole.upper - whole.lower;
  scale_ = unit_scale(std::max({size.x, size.y, size.z}));
  limit_ = scale_ * input.depth + kDepthRounding;
  direction_ = input.direction;
  const auto set = [](Side& side, const FeaturedMesh& mesh, SurfaceKind surface, auto carried, double sign) {
    side.mesh = mesh;
    side.surface = surface;
    side.carried = carried;
    side.sign = sign;
    side.carried_at.clear(mesh.mesh->source_vertex_count());
    for (std::size_t i = 0; i < carried.size(); ++i) side.carried_at.set(carried[i].vertex, i);
    side.crossed.clear();
    side.crossed_at.clear(mesh.mesh->source_vertex_count());
  };
  set(a_, input.a, input.surface_a, input.carried_a, -1.0);
  set(b_, input.b, input.surface_b, input.carried_b, 1.0);
  a_.cut.begin(a_.mesh, input.facet_pairs, Cut::Which::a);
  b_.cut.begin(b_.mesh, input.facet_pairs, Cut::Which::b);
  edge_hits_.run(a_.mesh, b_.mesh, input.facet_pairs, a_.cut.edge_hits(), b_.cut.edge_hits());
  a_.cut.order_hits();
  b_.cut.order_hits();
  // Into a closed mesh first: the ways out of it tell on which side of a sheet it belongs.
  const bool into_a_first = a_.surface == SurfaceKind::closed && b_.surface == SurfaceKind::sheet;
  find_crossed(into_a_first ? b_ : a_, into_a_first ? a_ : b_);
  find_crossed(into_a_first ? a_ : b_, into_a_first ? b_ : a_);
  a_.mark_crossed();
  b_.mark_crossed();
  return {a_.has_crossed, b_.has_crossed};
}

void CrossingSearch::finish(std::vector<FeaturePoint>& found) {
  sign_edges(found);
  append_edge_points(found);
  append_running_edges(a_, b_, found);
  append_running_edges(b_, a_, found);
  append_vertex_points(a_, b_, found);
  append_vertex_points(b_, a_, found);
}

void CrossingSearch::find_crossed(Side& own, const Side& other) {
  if (other.surface == SurfaceKind::closed) {
    find_ways_out(own, other);
  } else {
    find_ways_through(own, other);
  }
  std::ranges::sort(own.crossed, {}, &Crossed::source_vertex);
  for (std::size_t i = 0; i < own.crossed.size(); ++i) own.crossed_at.set(own.crossed[i].source_vertex, i);
}

// In the order of the caller's numbers, so that sums do not depend on how facets are grouped.
void CrossingSearch::find_patch_directions(Side& own, const Side& other) {
  own.cut.number_patches();
  patches_.assign(own.cut.patch_count(), {});
  for (const CarriedNormal& one : own.carried) {
    const int patch = own.cut.patch_of(one.vertex);
    if (patch < 0) continue;
    PatchDirection& direction = patches_[patch];
    Vec3& sum = one.gap < 0.0 ? direction.of_crossed : direction.of_others;
    sum = sum + own.sign * one.normal;
  }
  for (const EdgeHit& hit : own.cut.hits()) {
    PatchDirection& one = patches_[own.cut.patch_of(hit.vertices[0])];
    const int facet = other.mesh.mesh->facet_of_source(hit.facet);
    if (other.surface == SurfaceKind::closed) {
      one.entered = one.entered + other.scaled(scale_).unit_normal(facet);
      ++one.entries;
    } else if (own.surface == SurfaceKind::closed) {
      for (const int corner : other.mesh.features->corners(facet)) {
        const int source = other.mesh.mesh->source_vertex(corner);
        const Crossed* crossed = other.find(source);
        const CarriedNormal* carried = other.carried_normal(source);
        if (crossed == nullptr || (carried != nullptr && carried->gap < 0.0)) continue;
        one.entered = one.entered - crossed->way.out;
        ++one.entries;
      }
    }
  }
  for (PatchDirection& one : patches_) {
    const bool agree = one.entries > 0 && norm(one.entered) > kAgree * one.entries;
    one.facing = one.of_crossed != Vec3{}  ? one.of_crossed
                 : one.of_others != Vec3{} ? one.of_others
                 : agree                   ? one.entered
                                           : own.sign * direction_;
    one.facing = normalized(one.facing);
  }
}

Vec3 CrossingSearch::facing_of_patch(const Side& own, int source_vertex) const {
  const int patch = own.cut.patch_of(source_vertex);
  return patch < 0 ? own.sign * direction_ : patches_[patch].facing;
}

std::optional<Vec3> CrossingSearch::facing_of_vertex(const Side& own, int source_vertex, SurfaceKind other) const {
  const CarriedNormal* carried = own.carried_normal(source_vertex);
  if (carried == nullptr) return {};
  const Vec3 facing = own.sign * carried->normal;
  if (other == SurfaceKind::sheet) return facing;
  if (carried->gap >= 0.0 && dot(facing, facing_of_patch(own, source_vertex)) < 0.0) return {};
  return facing;
}

void CrossingSearch::find_ways_out(Side& own, const Side& other) {
  own.cut.find_inside(own.mesh, *other.mesh.mesh);
  if (own.cut.inside().empty()) return;
  find_patch_directions(own, other);
  const ScaledMesh surface = other.scaled(scale_), from = own.scaled(scale_);
  const Vec3 contact = own.sign * direction_;
  Box around;
  for (const int vertex : own.cut.inside()) around = extended(around, own.mesh.mesh->position(vertex));
  ways_.begin(surface, around, limit_);
  int hint = -1;
  for (const int vertex : own.cut.inside()) {
    const int source = own.mesh.mesh->source_vertex(vertex);
    const Vec3 v = from.position(vertex), facing = facing_of_patch(own, source);
    std::optional<WayOut> way;
    if (const auto carried = facing_of_vertex(own, source, SurfaceKind::closed))
      way = ways_.nearest_out(v, *carried, kSameSide, limit_, hint);
    if (!way) way = ways_.nearest_out(v, facing, kFaces, limit_, hint);
    if (!way) way = way_out_along(surface, v, contact, limit_);
    // A surface with holes may not be met.
    if (!way) way = ways_.nearest_out(v, facing, -2.0, kAnywhere, hint);
    if (!way) continue;
    hint = way->facet;
    own.crossed.push_back({source, *way});
  }
}

void CrossingSearch::find_ways_through(Side& own, const Side& sheet) {
  reached_.clear();
  find_patch_directions(own, sheet);
  const ScaledMesh surface = sheet.scaled(scale_);
  PredicateCounts counts;
  for (const EdgeHit& hit : own.cut.hits()) {
    const int facet = sheet.mesh.mesh->facet_of_source(hit.facet);
    const Triangle t = sheet.mesh.mesh->triangle(facet);
    const Vec3 normal = surface.unit_normal(facet);
    const EdgeVertices ends = own.mesh.features->edge(hit.edge);
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 facing =
          facing_of_vertex(own, hit.vertices[k], SurfaceKind::sheet).value_or(facing_of_patch(own, hit.vertices[k]));
      const double along = dot(normal, facing);
      const int below = orient3d(t[0], t[1], t[2], own.mesh.mesh->position(ends[k]), counts);
      if (along != 0.0 && below == (along > 0.0 ? 1 : -1))
        reached_.push_back({hit.vertices[k], ends[k], -1, facing, facet});
    }
  }
  ways_.begin(surface);
  through_.clear();
  through_at_.clear(own.mesh.mesh->source_vertex_count());
  while (!reached_.empty()) {
    reach_through(own);
    spread_through(own);
  }
}

// Looks at what was reached, in the order of the caller's numbers; keeps what is beyond the sheet.
void CrossingSearch::reach_through(Side& own) {
  // Of those that reach a vertex, the first in that order.
  std::ranges::sort(reached_, {}, [](const Reached& one) {
    return std::tuple(one.source_vertex, one.from, one.facing.x, one.facing.y, one.facing.z);
  });
  const ScaledMesh from = own.scaled(scale_);
  next_.clear();
  int last = -1;
  for (const Reached& one : reached_) {
    if (one.source_vertex == last || own.cut.is_inside(one.source_vertex)) continue;
    const CarriedNormal* carried = own.carried_normal(one.source_vertex);
    const Vec3 facing = carried != nullptr && carried->gap > 0.0 ? own.sign * carried->normal : one.facing;
    const WayThrough* through = way_through(one, from);
    if (through == nullptr || !through->is_beyond(facing)) continue;
    const WayOut& way = through->way;
    last = one.source_vertex;
    own.cut.add_inside(own.mesh, one.vertex, one.from);
    own.crossed.push_back({one.source_vertex, way});
    next_.push_back({one.source_vertex, one.vertex, one.from, way.out, way.facet});
  }
}

// That of a vertex, found once: a vertex that is not beyond the sheet is reached again and again.
const WayThrough* CrossingSearch::way_through(const Reached& one, const ScaledMesh& from) {
  int place = through_at_[one.source_vertex];
  if (place < 0) {
    place = static_cast<int>(through_.size());
    through_at_.set(one.source_vertex, through_.size());
    through_.push_back(ways_.nearest_through(from.position(one.vertex), limit_, one.hint));
  }
  return through_[place] ? &*through_[place] : nullptr;
}

void CrossingSearch::spread_through(Side& own) {
  reached_.clear();
  for (const Reached& one : next_) {
    for (const int to : own.mesh.features->neighbors(one.vertex)) {
      const int source = own.mesh.mesh->source_vertex(to);
      if (own.cut.is_inside(source)) continue;
      const auto [first, second] = std::minmax(one.source_vertex, source);
      if (!own.cut.is_cut({first, second})) reached_.push_back({source, to, one.source_vertex, one.facing, one.hint});
    }
  }
}

void CrossingSearch::append_vertex_points(const Side& own, const Side& other, std::vector<FeaturePoint>& found) const {
  const bool of_a = &own == &a_;
  for (const Crossed& one : own.crossed) {
    FeaturePoint point;
    point.kind = of_a ? FeaturePair::vertex_facet : FeaturePair::facet_vertex;
    (of_a ? point.a : point.b) = {one.source_vertex, -1, -1};
    (of_a ? point.weight_a : point.weight_b) = {1.0, 0.0, 0.0};
    (of_a ? point.b : point.a) = source_vertices(*other.mesh.mesh, used(one.way.feature));
    (of_a ? point.weight_b : point.weight_a) = one.way.feature_weight;
    point.normal = own.sign * one.way.out;
    point.gap = negative(one.way.distance / scale_);
    found.push_back(point);
  }
}

// Both ends inside, or beyond a sheet, and cut by nothing between.
bool CrossingSearch::goes_on_inside(const Side& own, int edge) const {
  const EdgeVertices ends = source_ends(own.mesh, edge);
  return own.cut.is_inside(ends[0]) && own.cut.is_inside(ends[1]) && !own.cut.is_cut(ends);
}

// Does an edge meet a facet that has the other edge?
bool CrossingSearch::meets_beside(const Side& own, int edge, const Side& other, int other_edge) const {
  const EdgeVertices ends = other.mesh.features->edge(other_edge);
  return std::ranges::any_of(own.cut.hits_of(source_ends(own.mesh, edge)), [&](const EdgeHit& hit) {
    const Corners& corners = other.mesh.features->corners(other.mesh.mesh->facet_of_source(hit.facet));
    return std::ranges::all_of(ends, [&](int v) { return std::ranges::find(corners, v) != corners.end(); });
  });
}

bool CrossingSearch::have_passed(int edge_a, int edge_b, const FeaturePoint& point) const {
  if (goes_on_inside(a_, edge_a) || goes_on_inside(b_, edge_b)) return true;
  const EdgeVertices ends_a = source_ends(a_.mesh, edge_a), ends_b = source_ends(b_.mesh, edge_b);
  const bool cut_a = a_.cut.is_cut(ends_a), cut_b = b_.cut.is_cut(ends_b);
  if ((cut_a && meets_beside(a_, edge_a, b_, edge_b)) || (cut_b && meets_beside(b_, edge_b, a_, edge_a))) return true;
  // An edge that is cut somewhere: is its point inside?
  return (cut_a && is_inside(a_, edge_a, point.weight_a, b_)) || (cut_b && is_inside(b_, edge_b, point.weight_b, a_));
}

bool CrossingSearch::is_inside(const Side& own, int edge, const std::array<double, 3>& weight,
                               const Side& other) const {
  if (other.surface != SurfaceKind::closed) return false;
  const EdgeVertices ends = own.mesh.features->edge(edge);
  return contains(*other.mesh.mesh,
                  weight[0] * own.mesh.mesh->position(ends[0]) + weight[1] * own.mesh.mesh->position(ends[1]));
}

Vec3 CrossingSearch::facing_of_edges(int edge_a, int edge_b) const {
  Vec3 sum;
  for (const auto& [side, edge] : {std::pair(&a_, edge_a), std::pair(&b_, edge_b)}) {
    for (const int v : source_ends(side->mesh, edge)) {
      if (const Crossed* one = side->find(v)) sum = sum + side->sign * one->way.out;
    }
  }
  return unit_or(sum, direction_);
}

bool CrossingSearch::passed_point(int edge_a, int edge_b, FeaturePoint& point) const {
  const ScaledMesh a = a_.scaled(scale_), b = b_.scaled(scale_);
  const auto nearest =
      nearest_between_edges(ends_of(a, edge_a), a.around(a.features.opposite(edge_a)), ends_of(b, edge_b),
                            b.around(b.features.opposite(edge_b)), limit_, EdgeSide::passed);
  if (!nearest || dot(nearest->normal, facing_of_edges(edge_a, edge_b)) <= kFaces) return false;
  const EdgeVertices ends_a = source_ends(a_.mesh, edge_a), ends_b = source_ends(b_.mesh, edge_b);
  point = point_of_edges(*nearest, {ends_a[0], ends_a[1], -1}, {ends_b[0], ends_b[1], -1}, edge_a, edge_b,
                         negative(nearest->distance / scale_));
  return true;
}

void CrossingSearch::sign_edges(std::vector<FeaturePoint>& found) {
  known_edges_.clear();
  std::size_t kept = 0;
  for (FeaturePoint& point : found) {
    if (point.kind == FeaturePair::edge_edge) {
      const auto [edge_a, edge_b] = std::pair(point.edge_a, point.edge_b);
      known_edges_.emplace_back(edge_a, edge_b);
      if (have_passed(edge_a, edge_b, point) && !passed_point(edge_a, edge_b, point)) continue;
    }
    found[kept++] = point;
  }
  found.resize(kept);
  std::ranges::sort(known_edges_);
}

// Takes two edges for the filter, which may have some that wait visited.
template <class Visit>
void CrossingSearch::wait(int edge_a, int edge_b, const Visit& visit) {
  waiting_.add(a_.scaled(scale_), edge_a, b_.scaled(scale_), edge_b, limit_, EdgeSide::passed, visit);
}

// Calls visit(edge_a, edge_b) for those that wait and may have a point.
template <class Visit>
void CrossingSearch::visit_waiting(const Visit& visit) {
  waiting_.visit_all(a_.scaled(scale_), b_.scaled(scale_), limit_, EdgeSide::passed, visit);
}

// Edges that are cut, and those of the facets that they meet.
void CrossingSearch::append_edge_points(std::vector<FeaturePoint>& found) {
  candidates_.clear();
  const auto keep = [&](int edge_a, int edge_b) { candidates_.emplace_back(edge_a, edge_b); };
  for (const Side* own : {&a_, &b_}) {
    const Side& other = own == &a_ ? b_ : a_;
    for (const EdgeHit& hit : own->cut.hits()) {
      const int facet = other.mesh.mesh->facet_of_source(hit.facet);
      for (int k = 0; k < 3; ++k) {
        const int edge = other.mesh.features->facet_edge(facet, k);
        if (edge < 0) continue;
        own == &a_ ? wait(hit.edge, edge, keep) : wait(edge, hit.edge, keep);
      }
    }
  }
  visit_waiting(keep);
  std::ranges::sort(candidates_);
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  FeaturePoint point;
  for (const auto& [edge_a, edge_b] : candidates_) {
    if (std::ranges::binary_search(known_edges_, std::pair(edge_a, edge_b))) continue;
    if (passed_point(edge_a, edge_b, point)) found.push_back(point);
  }
}

void CrossingSearch::append_running_edges(const Side& own, const Side& other, std::vector<FeaturePoint>& found) {
  if (other.surface != SurfaceKind::closed) return;
  with_point_.clear();
  for (const FeaturePoint& point : found) {
    if (point.kind == FeaturePair::edge_edge && point.gap < 0.0)
      with_point_.push_back(&own == &a_ ? point.edge_a : point.edge_b);
  }
  std::ranges::sort(with_point_);
  const auto hits = own.cut.hits();
  for (std::size_t i = 0, end = 0; i < hits.size(); i = end) {
    for (end = i + 1; end < hits.size() && hits[end].edge == hits[i].edge;) ++end;
    if (end == i + 1 || std::ranges::binary_search(with_point_, hits[i].edge)) continue;
    if (own.cut.is_inside(hits[i].vertices[0]) || own.cut.is_inside(hits[i].vertices[1])) continue;
    if (const auto point = nearest_passed(own, hits.subspan(i, end - i), other)) found.push_back(*point);
  }
}

std::optional<FeaturePoint> CrossingSearch::nearest_passed(const Side& own, std::span<const EdgeHit> hits,
                                                           const Side& other) {
  const int edge = hits[0].edge;
  const ScaledMesh surface = other.scaled(scale_);
  RunningEdge running(ends_of(own.scaled(scale_), edge));
  for (const EdgeHit& hit : hits) running.add_hit(surface.triangle(surface.mesh.facet_of_source(hit.facet)));
  std::optional<FeaturePoint> best;
  const auto look_at = [&](int edge_a, int edge_b) {
    FeaturePoint point;
    if (!passed_point(edge_a, edge_b, point)) return;
    const bool better =
        !best || point.gap > best->gap || (point.gap == best->gap && point.features() < best->features());
    if (better && is_inside(own, edge, &own == &a_ ? point.weight_a : point.weight_b, other)) best = point;
  };
  for (const int f : beside_running_.find(running, surface, limit_))
    &own == &a_ ? wait(edge, f, look_at) : wait(f, edge, look_at);
  visit_waiting(look_at);
  return best;
}

}  // namespace tact::narrowphase
