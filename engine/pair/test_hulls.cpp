#include "engine/pair/test_hulls.h"

#include "narrowphase/hull/hull_verdict.h"

namespace tact {

namespace {

using namespace narrowphase;

// Whether the vertices that showed the hulls to overlap in the last step still do. No support query.
bool still_overlap(const PairTask& pair, HullTest& test) {
  const PairRecord& record = pair.record;
  const PairHistory& history = record.history;
  test.surface_is_placed = history.has_surface && pair.work.smallest.surface.start(pair.difference, *record.surface);
  if (test.surface_is_placed) return true;
  return history.kind == PairHistory::Kind::overlapping && holds_origin(pair.difference, history.hulls);
}

// Whether the direction of the last step still separates the hulls, by more than the margins and the rounding.
bool still_separated(const PairTask& pair) {
  const PairHistory& history = pair.record.history;
  const MinkowskiDifference& m = pair.difference;
  const int a = history.hulls.a[0], b = history.hulls.b[0];
  if (pair.reach == 0.0 && m.separated_by_plane(history.direction, a, b)) return true;
  ++pair.work.counts.gjk_iterations;
  const double height = dot(history.direction, m.support(history.direction, m.vertex(a, b)).point);
  return height < -(m.height_error() + m.scale() * pair.reach);
}

void set_apart(PairRecord& record, base::Vec3 direction) {
  record.hulls_overlap = record.near = false;
  record.history.kind = PairHistory::Kind::separated;
  record.history.direction = direction;
  record.history.has_surface = false;
}

// The hulls are apart along the history's direction, by less than the margins: `distance` and the planes in metres.
void set_near(PairRecord& record, double distance, double plane_a, double plane_b, bool limit_reached) {
  const base::Vec3 direction = record.history.direction;
  record.near = true;
  Contact& contact = record.contact;
  contact = Contact{};
  contact.a = record.a;
  contact.b = record.b;
  contact.direction = {direction.x, direction.y, direction.z};
  contact.depth = -distance;
  contact.limit_reached = limit_reached;
  contact.plane_a = plane_a;
  contact.plane_b = plane_b;
}

// In doubles, and in integers where these cannot tell.
HullTest test_by_gjk(const PairTask& pair, bool carries) {
  PairRecord& record = pair.record;
  PairCounts& counts = pair.work.counts;
  const MinkowskiDifference& m = pair.difference;
  PairHistory& history = record.history;
  const GjkResult hulls = gjk(m, {}, carries ? history.hulls : GjkSimplex{}, {pair.settings.gjk_tolerance});
  history.hulls = hulls.simplex;
  counts.gjk_iterations += hulls.support_queries;
  HullTest test{.overlap = hulls.status != GjkStatus::apart,
                .limit_reached = hulls.status == GjkStatus::limit_reached,
                .took_gjk = true};
  base::Vec3 direction = -hulls.offset;
  if (hulls.status != GjkStatus::apart && hulls.status != GjkStatus::overlapping) {
    const HullVerdict exact = hull_verdict(m, hulls.simplex, pair.work.chosen);
    counts.gjk_iterations += exact.support_queries;
    history.hulls = exact.simplex;
    test.overlap = !exact.apart;
    direction = exact.direction;
  }
  if (test.overlap) return test;
  ++counts.separated;
  counts.limits_reached += test.limit_reached ? 1 : 0;
  set_apart(record, normalized(direction));
  if (hulls.distance < m.scale() * pair.reach) {
    const ClosestPoints closest = closest_points(m, hulls);
    set_near(record, hulls.distance / m.scale(), dot(history.direction, closest.a), dot(history.direction, closest.b),
             test.limit_reached);
  }
  return test;
}

}  // namespace

HullTest test_hulls(const PairTask& pair) {
  PairRecord& record = pair.record;
  PairCounts& counts = pair.work.counts;
  // The last step's result shortens the search; its direction is a part of the answer and is always carried.
  const bool carries = pair.tuning.carries_hulls;
  HullTest test;
  if (carries && still_overlap(pair, test)) {
    ++counts.still_overlapping;
    test.overlap = true;
    return test;
  }
  if (carries && record.history.kind == PairHistory::Kind::separated && still_separated(pair)) {
    ++counts.still_separated;
    set_apart(record, record.history.direction);
    return test;
  }
  return test_by_gjk(pair, carries);
}

}  // namespace tact
