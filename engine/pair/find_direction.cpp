#include "engine/pair/find_direction.h"

#include <algorithm>
#include <memory>

#include "narrowphase/direction/contact_direction.h"

namespace tact {

namespace {

using base::Vec3;
using namespace narrowphase;

struct FoundDirection {
  ContactDirection found;
  DirectionSource source = DirectionSource::smallest;
};

// The surface that the search for the smallest separation starts from and leaves, if every step searches.
SurfaceShape* surface_of(const PairTask& pair) {
  PairRecord& record = pair.record;
  if (pair.settings.direction != DirectionPolicy::smallest || !pair.tuning.carries_hulls) return nullptr;
  if (record.surface == nullptr) record.surface = std::make_unique<SurfaceShape>();
  if (!record.history.has_surface) record.surface->face_count = 0;
  return record.surface.get();
}

FoundDirection carried_direction(const PairTask& pair, const DirectionSettings& settings) {
  const PairHistory& history = pair.record.history;
  const bool was_overlapping = history.kind == PairHistory::Kind::overlapping;
  const GjkSimplex face = was_overlapping && pair.tuning.carries_hulls ? pair.record.face : GjkSimplex{};
  return {contact_direction(pair.difference, history.direction, face, settings, pair.work.faces),
          was_overlapping ? DirectionSource::carried : DirectionSource::fresh};
}

FoundDirection smallest_direction(const PairTask& pair, const HullTest& hulls, const DirectionSettings& settings) {
  PairHistory& history = pair.record.history;
  PairWork& work = pair.work;
  const bool is_new = history.kind == PairHistory::Kind::none;
  const SmallestStart start{.preferred = is_new ? Vec3{0.0, 0.0, 1.0} : history.direction,
                            .hulls = history.hulls,
                            .shape = surface_of(pair),
                            .is_placed = hulls.surface_is_placed};
  const SmallestSeparation smallest = smallest_separation(pair.difference, start, work.smallest);
  history.has_surface = start.shape != nullptr && start.shape->face_count > 0;
  work.counts.gjk_iterations += smallest.support_queries;
  FoundDirection direction{contact_direction(pair.difference, smallest.direction, smallest.face, settings, work.faces),
                           DirectionSource::smallest};
  direction.found.limit_reached = direction.found.limit_reached || smallest.limit_reached;
  return direction;
}

FoundDirection search_direction(const PairTask& pair, const HullTest& hulls) {
  const DirectionSettings settings{{pair.settings.gjk_tolerance}, pair.settings.iteration_limit};
  const bool is_new = pair.record.history.kind == PairHistory::Kind::none;
  return !is_new && pair.settings.direction == DirectionPolicy::carried ? carried_direction(pair, settings)
                                                                        : smallest_direction(pair, hulls, settings);
}

// The planes go through the vertices that the last support query of the direction found.
Slab slab_of(const MinkowskiDifference& m, const ContactDirection& found) {
  const double upper = dot(found.n, m.a().position(found.top_a) - m.origin());
  const double lower = dot(found.n, m.b().position(found.top_b) - m.origin());
  return make_slab(found.n, m.origin(), lower, upper, m.vertex_height_error());
}

void fill_contact(const PairTask& pair, const HullTest& hulls, const FoundDirection& direction, const Slab& slab) {
  Contact& contact = pair.record.contact;
  contact = Contact{};
  contact.a = pair.record.a;
  contact.b = pair.record.b;
  contact.direction = {slab.n.x, slab.n.y, slab.n.z};
  contact.depth = std::max(0.0, direction.found.height / pair.difference.scale());
  contact.source = direction.source;
  contact.iterations = direction.found.iterations;
  contact.limit_reached = hulls.limit_reached || direction.found.limit_reached;
  const double base = dot(slab.n, slab.origin);
  contact.plane_a = base + slab.upper;
  contact.plane_b = base + slab.lower;
}

void count_contact(const Contact& contact, PairCounts& counts) {
  counts.limits_reached += contact.limit_reached ? 1 : 0;
  counts.direction_iterations += contact.iterations;
  counts.carried_directions += contact.source == DirectionSource::carried ? 1 : 0;
  counts.fresh_directions += contact.source == DirectionSource::fresh ? 1 : 0;
  counts.smallest_directions += contact.source == DirectionSource::smallest ? 1 : 0;
}

}  // namespace

Slab find_direction(const PairTask& pair, const HullTest& hulls) {
  PairRecord& record = pair.record;
  const FoundDirection direction = search_direction(pair, hulls);
  pair.work.counts.gjk_iterations += direction.found.support_queries;
  record.hulls_overlap = true;
  record.near = false;
  record.history.kind = PairHistory::Kind::overlapping;
  record.history.direction = direction.found.n;
  record.face = direction.found.face;
  const Slab slab = slab_of(pair.difference, direction.found);
  record.slab_lower = slab.lower;
  record.slab_upper = slab.upper;
  fill_contact(pair, hulls, direction, slab);
  count_contact(record.contact, pair.work.counts);
  return slab;
}

}  // namespace tact
