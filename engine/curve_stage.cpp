#include "engine/curve_stage.h"

#include "engine/base/parallel.h"

namespace tact {

namespace {

constexpr std::size_t kPairsAtATime = 16;  // of most only the facet pairs are looked for

CurvePoint to_point(const narrowphase::CurveCorner& corner) {
  CurvePoint point;
  point.position = {corner.position.x, corner.position.y, corner.position.z};
  point.fraction = corner.fraction;
  point.edge = corner.node.edge;
  point.facet = corner.node.facet;
  point.facet_pair = corner.pair;
  point.edge_of_b = corner.node.edge_of_b;
  return point;
}

void take(const narrowphase::IntersectionCurves& found, CurveSet& set) {
  set.points.clear();
  for (const narrowphase::CurveCorner& corner : found.corners()) set.points.push_back(to_point(corner));
  set.curves.clear();
  for (const narrowphase::CurveRange& range : found.curves())
    set.curves.push_back(
        {.closed = range.closed, .points = std::span(set.points).subspan(range.begin, range.end - range.begin)});
}

void find_curves(const Body& a, const Body& b, std::span<const FacetPair> facet_pairs, const Eigen::Vector3d& apart,
                 narrowphase::IntersectionCurves& search, std::unique_ptr<CurveSet>& set) {
  if (facet_pairs.empty()) {
    set.reset();
    return;
  }
  if (set == nullptr) set = std::make_unique<CurveSet>();
  search.find(a.mesh, b.mesh, facet_pairs, {apart.x(), apart.y(), apart.z()});
  take(search, *set);
}

}  // namespace

void CurveStage::find(std::span<const MovedPair> moved, const Bodies& bodies, const Settings& settings) {
  searches_.resize(settings.threads);
  base::parallel_for(moved.size(), kPairsAtATime, settings.threads, [&](std::size_t i, int thread) {
    PairRecord& record = *moved[i].record;
    find_curves(bodies.in_slot(record.a.index), bodies.in_slot(record.b.index), record.facet_pairs,
                record.contact.direction, searches_[thread], record.curves);
  });
}

void CurveStage::find(std::span<SelfRecord* const> selves, const Bodies& bodies, const Settings& settings) {
  searches_.resize(settings.threads);
  base::parallel_for(selves.size(), 1, settings.threads, [&](std::size_t i, int thread) {
    const Body& body = bodies.in_slot(selves[i]->body.index);
    find_curves(body, body, selves[i]->facet_pairs, Eigen::Vector3d::Zero(), searches_[thread], selves[i]->curves);
  });
}

}  // namespace tact
