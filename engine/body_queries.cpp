#include "engine/body_queries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

#include "engine/base/text.h"
#include "engine/body_search.h"
#include "engine/eigen_vectors.h"
#include "engine/queries.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/queries/mesh_distance.h"
#include "narrowphase/queries/mesh_overlap.h"
#include "narrowphase/queries/mesh_queries.h"
#include "narrowphase/queries/mesh_sweep.h"

namespace tact {

namespace {

using base::Box;
using narrowphase::MeshDistance;
using narrowphase::SweptHit;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestAngle = 1000.0;

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::invalid_argument, what); }

// Of a body that is no plane: a place in it.
const Body& placed_mesh(const Bodies& bodies, BodyId body) { return bodies.placed(body.index); }

// Those whose box may be as near to a box as `within`, metres.
struct NearSearch : Search {
  static constexpr bool kScansByRank = true;  // what is found early makes others too far away

  NearSearch(const Box& wanted, double most) : box(wanted), within(most) {}

  Box around() const { return grown(box, within * (1.0 + 0x1p-40)); }
  double rank(const Box& other) const { return distance_below(box, other).least; }
  bool wants(double distance) const { return distance <= within; }

  Box box;
  double within;
};

MeshDistance swapped(const MeshDistance& found) {
  return {found.facet_b, found.facet_a, found.distance, found.weight_b, found.weight_a};
}

// Whether a body lies wholly in another one, from whose surface its own is apart.
bool is_inside(const Body& inner, const Body& outer) {
  if (inner.plane != nullptr) return false;
  if (outer.plane == nullptr) return outer.has_inside && narrowphase::lies_inside(inner.mesh, outer.mesh);
  // The highest corner is the lowest one over the other side.
  const narrowphase::HalfSpace& space = *outer.plane;
  const narrowphase::HalfSpace other_side{-space.normal, -space.offset};
  return !inner.mesh.box().empty() && (height_over(other_side, lowest_corner(other_side, inner.mesh.box())) > 0.0 ||
                                       !least_distance(inner.mesh, other_side, 0.0));
}

// Of bodies of which not both are planes.
BodyDistance distance_of(const Body& a, const Body& b, double within) {
  BodyDistance answer{.a = a.id, .b = b.id};
  std::optional<MeshDistance> found;
  if (a.plane != nullptr) {
    found = least_distance(b.mesh, *a.plane, within);
    if (found) found = swapped(*found);
  } else {
    found = b.plane != nullptr ? least_distance(a.mesh, *b.plane, within) : least_distance(a.mesh, b.mesh, within);
  }
  if (found) {
    answer.distance = found->distance;
    answer.a_facet = found->facet_a, answer.b_facet = found->facet_b;
    answer.a_barycentric = found->weight_a, answer.b_barycentric = found->weight_b;
  }
  const bool meet = found && found->distance == 0.0 && a.plane == nullptr && b.plane == nullptr;
  if (!meet && is_inside(a, b)) answer.containment = Containment::a_in_b;
  if (!meet && is_inside(b, a)) answer.containment = Containment::b_in_a;
  return answer;
}

narrowphase::TurningWay way_of(const Sweep& sweep) {
  const double scale = narrowphase::unit_scale(sweep.axis.cwiseAbs().maxCoeff());
  return {from_eigen(sweep.way), normalized(scale * from_eigen(sweep.axis)), from_eigen(sweep.center), sweep.angle};
}

}  // namespace

void check_query(const Bodies& bodies, const DistanceQuery& query) {
  const Body &a = bodies.at(query.a), &b = bodies.at(query.b);
  if (query.a == query.b) refuse("the distance of body '" + a.name + "' to itself");
  if (a.plane != nullptr && b.plane != nullptr)
    refuse("the distance of two planes, '" + a.name + "' and '" + b.name + "'");
  check_within(query.within);
}

void check_query(const Bodies& bodies, const NearestBodiesQuery& query) {
  bodies.at(query.body);
  check_within(query.within);
}

void check_query(const Bodies& bodies, const Sweep& sweep) {
  if (bodies.at(sweep.body).plane != nullptr) refuse("plane '" + bodies.at(sweep.body).name + "' is swept");
  check_point(sweep.way, "the way of a sweep");
  check_point(sweep.axis, "the axis of a sweep");
  check_point(sweep.center, "the centre of a sweep");
  if (!(std::abs(sweep.angle) <= kLargestAngle))
    refuse("the angle of a sweep is " + base::text_of(sweep.angle) + ", not -1000 to 1000");
  if (sweep.axis.isZero(0.0)) refuse("the axis of a sweep is zero");
}

BodyDistance find_distance(const Bodies& bodies, const DistanceQuery& query) {
  return distance_of(placed_mesh(bodies, query.a), placed_mesh(bodies, query.b), query.within);
}

std::vector<BodyDistance> find_nearest_bodies(const Bodies& bodies, const NearestBodiesQuery& query) {
  std::vector<BodyDistance> nearest;  // a heap, the farthest in front
  if (query.count == 0) return nearest;
  const Body& own = placed_mesh(bodies, query.body);
  const bool is_plane = own.plane != nullptr;
  NearSearch search(
      is_plane ? Box{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}} : own.mesh.box(),
      query.within);
  const auto order = [&](const BodyDistance& one) { return std::tuple(one.distance, bodies.keys().of(one.b.index)); };
  const auto look_at = [&](std::uint32_t slot) {
    if (slot == query.body.index) return;
    const BodyDistance found = distance_of(own, bodies.placed(slot), search.within);
    if (found.a_facet < 0) return;
    nearest.push_back(found);
    std::ranges::push_heap(nearest, {}, order);
    if (nearest.size() > query.count) {
      std::ranges::pop_heap(nearest, {}, order);
      nearest.pop_back();
    }
    if (nearest.size() == query.count) search.within = nearest.front().distance;
  };
  if (!is_plane) {
    if (own.mesh.box().empty()) return nearest;
    for_each_plane(bodies, query.filter, [&](std::uint32_t slot, const narrowphase::HalfSpace&) { look_at(slot); });
  }
  for_each_body(bodies, query.filter, search, look_at);
  std::ranges::sort_heap(nearest, {}, order);
  return nearest;
}

SweepHit find_swept(const Bodies& bodies, const Sweep& sweep) {
  const Body& own = placed_mesh(bodies, sweep.body);
  const narrowphase::TurningWay way = way_of(sweep);
  SweepHit best;
  const auto take = [&](std::uint32_t slot, const std::optional<SweptHit>& hit) {
    const auto order = [&](double time, std::uint32_t of_slot) { return std::tuple(time, bodies.keys().of(of_slot)); };
    if (!hit || (best.facet >= 0 && order(hit->time, slot) >= order(best.fraction, best.body.index))) return;
    best = {bodies.in_slot(slot).id, hit->facet_a,  hit->facet_b, hit->time,
            to_eigen(hit->normal),   hit->weight_a, hit->weight_b};
  };
  if (own.mesh.box().empty()) return best;
  for_each_plane(bodies, sweep.filter, [&](std::uint32_t slot, const narrowphase::HalfSpace& plane) {
    take(slot, first_on_way(own.mesh, way, plane, best.fraction));
  });
  BoxSearch search(box_of_way(own.mesh.box(), way));
  for_each_body(bodies, sweep.filter, search, [&](std::uint32_t slot) {
    if (slot != sweep.body.index) take(slot, first_on_way(own.mesh, way, bodies.placed(slot).mesh, best.fraction));
  });
  return best;
}

Overlap find_overlap(const Bodies& bodies, BodyId a, BodyId b) {
  const auto closed = [&](BodyId id) -> narrowphase::ClosedMesh {
    const Body& body = bodies.at(id);
    if (body.plane != nullptr) refuse("body '" + body.name + "' is a plane, which has no volume");
    if (!body.has_inside) refuse("body '" + body.name + "' is not closed");
    return {&bodies.placed(id.index).mesh, body.is_outward};
  };
  const narrowphase::ClosedMesh of_a = closed(a), of_b = closed(b);
  if (a == b) refuse("the overlap of body '" + bodies.at(a).name + "' with itself");
  const narrowphase::OverlapSize size = overlap_size(of_a, of_b);
  return {size.volume, size.area};
}

}  // namespace tact
