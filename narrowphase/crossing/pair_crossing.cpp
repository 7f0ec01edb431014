#include "narrowphase/crossing/pair_crossing.h"

#include <algorithm>

#include "narrowphase/queries/mesh_queries.h"

namespace tact::narrowphase {

namespace {

// How far beyond the hulls' depth an exit may seem to be by rounding; lengths are near 1.
constexpr double kDepthRounding = 1e-12;
// A vertex on the surface itself looks for the other side from so far below it. Lengths are near 1.
constexpr double kBeside = 1e-9;
// Facets beside the place of an exit may be met a little before it.
constexpr double kShorter = 0x1p-6;
// A vertex that has become at most so many times as deep in a step keeps its side, whatever the mesh is like there.
constexpr double kSlowly = 2.0;
// Less than every cosine: each facet faces a direction by so much.
constexpr double kFacesAnything = -2.0;

void set_without_near_points(CrossedSurface& own) {
  own.without_near_points.assign(static_cast<std::size_t>(own.mesh.mesh->vertex_count()) / 64 + 1, 0);
  for (const int source : own.exits.vertices()) {
    const auto vertex = static_cast<std::size_t>(own.mesh.features->vertex_of_source(source));
    own.without_near_points[vertex / 64] |= std::uint64_t{1} << vertex % 64;
  }
}

}  // namespace

const Crossing& PairCrossing::find(const PairCrossingInput& input) {
  begin(input);
  auto& [a, b] = crossing_.surfaces;
  a.cut.begin(a.mesh, input.facet_pairs, Cut::Which::a);
  b.cut.begin(b.mesh, input.facet_pairs, Cut::Which::b);
  edge_hits_.run(a.mesh, b.mesh, input.facet_pairs, a.cut.edge_hits(), b.cut.edge_hits());
  a.cut.order_hits();
  b.cut.order_hits();
  if (b.surface == SurfaceKind::closed) a.cut.find_inside(*b.mesh.mesh);
  if (a.surface == SurfaceKind::closed) b.cut.find_inside(*a.mesh.mesh);
  a.cut.number_patches();
  b.cut.number_patches();
  ways_apart_.clear();
  const bool any_sheet = a.surface == SurfaceKind::sheet || b.surface == SurfaceKind::sheet;
  if (!any_sheet) find_kept();
  any_sheet ? separation_.clear() : separation_.find(crossing_);
  // Inside a closed mesh first: the exits from it tell on which side of a sheet it belongs.
  const bool into_a_first = a.surface == SurfaceKind::closed && b.surface == SurfaceKind::sheet;
  find_past(into_a_first ? b : a, into_a_first ? a : b);
  find_past(into_a_first ? a : b, into_a_first ? b : a);
  for (CrossedSurface* const own : {&a, &b}) {
    own->cut.number_patches();
    set_without_near_points(*own);
  }
  if (any_sheet) {
    crossing_.groups = nullptr;  // what is past a sheet has joined patches
    find_kept();
  }
  return crossing_;
}

void PairCrossing::find_groups() {
  if (crossing_.groups != nullptr) return;
  groups_.find(crossing_);
  crossing_.groups = &groups_;
}

void PairCrossing::find_kept() {
  if (!KeptDirections::may_be(crossing_)) return;
  find_groups();
  kept_.find(crossing_, groups_);
  for (CrossedSurface& surface : crossing_.surfaces) kept_.give(groups_, surface);
}

void PairCrossing::begin(const PairCrossingInput& input) {
  const double scale = unit_scale_of(merged(input.a.mesh->box(), input.b.mesh->box()));
  crossing_.within = scale * input.depth + kDepthRounding;
  crossing_.direction = input.direction;
  crossing_.facet_pairs = input.facet_pairs;
  crossing_.carried = input.carried;
  crossing_.groups = nullptr;
  crossing_.surfaces[0].begin(input.a, input.surface_a, -1.0, scale);
  crossing_.surfaces[1].begin(input.b, input.surface_b, 1.0, scale);
  for (const bool of_b : {false, true}) {
    carried_[of_b].clear((of_b ? input.b : input.a).mesh->source_vertex_count());
    for (const CarriedNormal& one : of_b ? input.carried.of_b : input.carried.of_a) carried_[of_b].add(one.vertex, one);
  }
}

void PairCrossing::find_past(CrossedSurface& own, const CrossedSurface& other) {
  if (other.surface == SurfaceKind::closed) {
    find_exits(own, other);
  } else {
    find_exits_through(own, other);
  }
}

// In the order of the caller's numbers, so that sums do not depend on how facets are grouped.
void PairCrossing::find_patch_directions(CrossedSurface& own, const CrossedSurface& other) {
  patches_.assign(own.cut.patch_count(), {});
  for (const CarriedNormal& one : carried(own).values()) {
    const int patch = own.cut.patch_of(one.vertex);
    if (patch < 0) continue;
    (one.gap < 0.0 ? patches_[patch].of_past : patches_[patch].of_others).add(own.sign * one.normal);
  }
  for (const EdgeHit& hit : own.cut.hits()) add_entry(own, other, hit, patches_[own.cut.patch_of(hit.vertices[0])]);
  for (PatchDirection& one : patches_) {
    const bool of_past = one.of_past.sum != Vec3{}, of_others = !of_past && one.of_others.sum != Vec3{};
    const bool entered = !of_past && !of_others && one.entered.count > 0 && one.entered.agrees();
    one.facing = of_past     ? one.of_past.sum
                 : of_others ? one.of_others.sum
                 : entered   ? one.entered.sum
                             : own.sign * crossing_.direction;
    one.facing = normalized(one.facing);
    one.agrees = of_past     ? one.of_past.agrees()
                 : of_others ? one.of_others.agrees()
                             : entered || one.entered.count == 0;
  }
}

void PairCrossing::add_entry(const CrossedSurface& own, const CrossedSurface& other, const EdgeHit& hit,
                             PatchDirection& patch) {
  const int facet = other.mesh.mesh->facet_of_source(hit.facet);
  if (other.surface == SurfaceKind::closed) {
    patch.entered.add(other.scaled().unit_normal(facet));
  } else if (own.surface == SurfaceKind::closed) {
    for (const int corner : other.mesh.features->corners(facet)) {
      const int source = other.mesh.mesh->source_vertex(corner);
      const NearestExit* exit = other.exits.find(source);
      const CarriedNormal* last = carried(other).find(source);
      if (exit == nullptr || (last != nullptr && last->gap < 0.0)) continue;
      patch.entered.add(-exit->direction);
    }
  }
}

Vec3 PairCrossing::facing_of_patch(const CrossedSurface& own, int source_vertex) const {
  const int patch = own.cut.patch_of(source_vertex);
  return patch < 0 ? own.sign * crossing_.direction : patches_[patch].facing;
}

std::optional<Vec3> PairCrossing::facing_of_vertex(const CrossedSurface& own, int source_vertex,
                                                   SurfaceKind other) const {
  const CarriedNormal* last = carried(own).find(source_vertex);
  if (last == nullptr) return {};
  const Vec3 facing = own.sign * last->normal;
  if (other == SurfaceKind::sheet) return facing;
  const bool is_against =
      dot(facing, facing_of_patch(own, source_vertex)) < 0.0 || dot(last->normal, own.kept_by(source_vertex)) < 0.0;
  if (last->gap >= 0.0 && is_against) return {};
  return facing;
}

void PairCrossing::find_exits(CrossedSurface& own, const CrossedSurface& other) {
  if (own.cut.past().empty()) return;
  find_patch_directions(own, other);
  Box around;
  for (const int vertex : own.cut.past()) around = extended(around, own.mesh.mesh->position(vertex));
  exits_.begin(other.scaled(), around, crossing_.within);
  int hint = -1;
  for (const int vertex : own.cut.past()) {
    const auto exit = exit_inside(own, other, vertex, hint);
    if (!exit) continue;
    hint = exit->facet;
    own.exits.add(own.mesh.mesh->source_vertex(vertex), *exit);
  }
}

std::optional<NearestExit> PairCrossing::exit_inside(const CrossedSurface& own, const CrossedSurface& other, int vertex,
                                                     int hint) {
  std::optional<NearestExit> exit;
  if (!separation_.leads_all()) {
    exit = own_exit_inside(own, other, vertex, hint);
    const CarriedNormal* last = carried(own).find(own.mesh.mesh->source_vertex(vertex));
    const bool is_new = last == nullptr || last->gap >= 0.0;
    if (!exit || !is_new || !separation_.is_against(own.sign * exit->direction)) return exit;
  }
  const Vec3 v = own.scaled().position(vertex), facing = own.sign * separation_.direction();
  for (const double cosine : {kSameSide, kFaces}) {
    if (const auto led = exits_.nearest_exit(v, facing, cosine, crossing_.within, hint)) return led;
  }
  return exit ? exit : own_exit_inside(own, other, vertex, hint);
}

// By what the vertex and its patch tell.
std::optional<NearestExit> PairCrossing::own_exit_inside(const CrossedSurface& own, const CrossedSurface& other,
                                                         int vertex, int hint) {
  const int source = own.mesh.mesh->source_vertex(vertex), patch = own.cut.patch_of(source);
  const Vec3 v = own.scaled().position(vertex);
  Vec3 facing = facing_of_patch(own, source);
  const double within = crossing_.within;
  std::optional<NearestExit> exit;
  std::optional<double> last_depth;
  if (const auto last = facing_of_vertex(own, source, SurfaceKind::closed)) {
    exit = exits_.nearest_exit(v, *last, kSameSide, within, hint);
    if (exit) last_depth = -own.scale * std::min(0.0, carried(own).find(source)->gap);
    if (exit && exit->distance <= kSlowly * *last_depth) return exit;
  }
  const Vec3 kept = own.sign * own.kept_by(source);
  if (!exit) {
    if (dot(facing, kept) < 0.0) {
      facing = kept;
    } else if (patch >= 0 && !patches_[patch].agrees) {
      facing = own.sign * way_apart_of(own, source);
    }
    exit = exits_.nearest_exit(v, facing, kFaces, within, hint);
  }
  const auto nearest = exits_.nearest_exit(v, facing, kFacesAnything, within, hint);
  if (!nearest || (exit && exit->distance == nearest->distance)) return nearest;
  const ScaledMesh surface = other.scaled();
  if (exit && is_local(*exit, *nearest, surface, v, last_depth)) return exit;
  if (dot(nearest->direction, kept) < 0.0) {
    exit = exits_.nearest_exit(v, own.sign * way_apart_of(own, source), kSameSide, within, hint);
    if (exit && is_local(*exit, *nearest, surface, v, {})) return exit;
  }
  return nearest;
}

// `last_depth` of a vertex whose side the last step named.
bool PairCrossing::is_local(const NearestExit& exit, const NearestExit& nearest, const ScaledMesh& other, Vec3 v,
                            const std::optional<double>& last_depth) {
  return is_thicker(other, v, nearest, exit.distance - last_depth.value_or(0.0)) &&
         (last_depth.has_value() || is_straight(other, v, nearest, exit));
}

// That of the crossing that a vertex is of, which is found once; of a part that no longer meets anything the contact
// direction.
Vec3 PairCrossing::way_apart_of(const CrossedSurface& own, int source_vertex) {
  if (crossing_.within <= kHardlyDeep) return crossing_.direction;
  find_groups();
  ways_apart_.resize(static_cast<std::size_t>(groups_.count()));
  const int group = groups_.group_of(own, source_vertex);
  if (group < 0) return crossing_.direction;
  std::optional<Vec3>& way = ways_apart_[group];
  if (!way) {
    groups_.take_parts(group, part_a_, part_b_);
    way = way_apart_.direction({.a = crossing_.a().scaled(),
                                .b = crossing_.b().scaled(),
                                .part_a = part_a_,
                                .part_b = part_b_,
                                .came = own.kept_by(source_vertex),
                                .direction = crossing_.direction,
                                .depth = crossing_.within});
  }
  return *way;
}

// Whether the mesh around `v`, from its nearest place through `v` to the other side, is thicker than `distance`.
bool PairCrossing::is_thicker(const ScaledMesh& other, Vec3 v, const NearestExit& nearest, double distance) {
  if (distance <= nearest.distance) return true;
  const double back = 1.0 / other.scale;
  const Vec3 from = v - kBeside * nearest.direction, to = v - (distance - nearest.distance) * nearest.direction;
  return !any_hit(other.mesh, PreparedSegment({back * from, back * to}));
}

// Whether nothing of the mesh is between `v` and the place of `exit`, seen from so far inside of the nearest place: `v`
// may lie on a facet that stands along the exit.
bool PairCrossing::is_straight(const ScaledMesh& other, Vec3 v, const NearestExit& nearest, const NearestExit& exit) {
  const double back = 1.0 / other.scale;
  const Vec3 from = v - kBeside * nearest.direction, to = from + (1.0 - kShorter) * exit.distance * exit.direction;
  return !any_hit(other.mesh, PreparedSegment({back * from, back * to}));
}

void PairCrossing::find_exits_through(CrossedSurface& own, const CrossedSurface& sheet) {
  find_patch_directions(own, sheet);
  const ScaledMesh surface = sheet.scaled(), from = own.scaled();
  exits_.begin(surface);
  through_.clear(own.mesh.mesh->source_vertex_count());
  spread_.begin(own, surface, 0.0, [&](const EdgeHit& hit, std::size_t end) {
    const int v = hit.vertices[end];
    const auto last = facing_of_vertex(own, v, SurfaceKind::sheet);
    return last ? *last : facing_of_patch(own, v);
  });
  spread_.run(own, surface, [&](const ReachedVertex& one) -> std::optional<NearestExit> {
    // Found once: a vertex that is not beyond the sheet is reached again and again.
    const auto* through = through_.find(one.source_vertex);
    if (through == nullptr) {
      const int hint = surface.mesh.facet_of_source(one.facet);
      const auto nearest = exits_.nearest_exit_through(from.position(one.vertex), crossing_.within, hint);
      through = through_.add(one.source_vertex, nearest);
    }
    const CarriedNormal* last = carried(own).find(one.source_vertex);
    const Vec3 facing = last != nullptr && last->gap > 0.0 ? own.sign * last->normal : one.facing;
    if (!*through || !(*through)->is_beyond(facing)) return {};
    return (*through)->exit;
  });
}

}  // namespace tact::narrowphase
