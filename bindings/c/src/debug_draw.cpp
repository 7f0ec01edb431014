#include <tact/debug_draw.h>

#include "drawer.h"
#include "handles.h"

namespace tact::c {
namespace {

// Calls pass(field of C, field of C++) for each switch, and for each colour.
template <class ForC, class Options, class Pass>
void for_each_option(ForC& c, Options& o, const Pass& pass) {
  pass(c.surfaces, o.surfaces), pass(c.boxes, o.boxes), pass(c.candidate_pairs, o.candidate_pairs);
  pass(c.directions, o.directions), pass(c.planes, o.planes), pass(c.zones, o.zones);
  pass(c.kept_facets, o.kept_facets), pass(c.facet_pairs, o.facet_pairs), pass(c.patches, o.patches),
      pass(c.points, o.points), pass(c.within_reach, o.within_reach), pass(c.curves, o.curves), pass(c.names, o.names);
}
template <class ForC, class Options, class Pass>
void for_each_color(ForC& c, Options& o, const Pass& pass) {
  pass(c.surface, o.surface), pass(c.box, o.box), pass(c.moved_box, o.moved_box), pass(c.candidate, o.candidate);
  pass(c.direction, o.direction), pass(c.plane, o.plane), pass(c.zone, o.zone);
  pass(c.kept, o.kept), pass(c.meeting, o.meeting), pass(c.patch, o.patch), pass(c.point, o.point),
      pass(c.reach, o.reach), pass(c.curve, o.curve), pass(c.distance, o.distance), pass(c.sum, o.sum),
      pass(c.force, o.force), pass(c.word, o.word);
}

tact_debug_draw_options defaults() {
  const DebugDrawOptions options;
  tact_debug_draw_options result{};
  result.struct_size = sizeof result;
  for_each_option(result, options, [](bool& to, bool from) { to = from; });
  for_each_color(result, options, [](tact_debug_color& to, const DebugColor& from) { to = color_of(from); });
  return result;
}

DebugDrawOptions options_of(const tact_debug_draw_options* given) {
  if (given == nullptr) return {};
  const tact_debug_draw_options c = read_struct(*given, defaults());
  DebugDrawOptions result;
  for_each_option(c, result, [](bool from, bool& to) { to = from; });
  for_each_color(c, result, [](const tact_debug_color& from, DebugColor& to) { to = color_of(from); });
  return result;
}

}  // namespace
}  // namespace tact::c

using tact::c::CDrawer, tact::c::check_not_null, tact::c::guarded, tact::c::options_of, tact::c::reading,
    tact::c::WorldEntry;

extern "C" {

tact_error tact_debug_draw_defaults(tact_debug_draw_options* options) {
  return guarded([&] {
    check_not_null(options);
    *options = tact::c::defaults();
  });
}

tact_error tact_world_debug_draw(tact_world world, const tact_debug_drawer* drawer,
                                 const tact_debug_draw_options* options) {
  return reading(world, [&](const WorldEntry& entry) {
    CDrawer to(drawer);
    if (entry.report == nullptr)
      throw tact::c::Failure{TACT_ERROR_WRONG_ORDER,
                             "nothing was found: no step since the world or its settings were made"};
    tact::debug_draw(entry.world, *entry.report, to, options_of(options));
  });
}

tact_error tact_world_debug_draw_distances(tact_world world, const tact_body_distance* distances, size_t count,
                                           const tact_debug_drawer* drawer, const tact_debug_draw_options* options) {
  return reading(world, [&](const WorldEntry& entry) {
    CDrawer to(drawer);
    if (count > 0) check_not_null(distances);
    // They have the same bits: queries.cpp.
    const std::span given(reinterpret_cast<const tact::BodyDistance*>(distances), count);
    tact::debug_draw_distances(entry.world, given, to, options_of(options));
  });
}

tact_error tact_world_debug_draw_sums(tact_world world, const tact_point_impulse* impulses, size_t count,
                                      const tact_debug_drawer* drawer, const tact_debug_draw_options* options) {
  return reading(world, [&](const WorldEntry& entry) {
    CDrawer to(drawer);
    if (count > 0) check_not_null(impulses);
    const tact::ContactSums sums =
        sum_contacts(entry.world, tact::c::report_of(entry), tact::c::impulses_of(impulses, count));
    tact::debug_draw_sums(entry.world, sums, to, options_of(options));
  });
}
}
