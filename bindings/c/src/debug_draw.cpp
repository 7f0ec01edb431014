#include <tact/debug_draw.h>

#include <string>

#include "handles.h"

namespace tact::c {
namespace {

tact_debug_color color_of(const DebugColor& c) { return {c.red, c.green, c.blue, c.alpha}; }
DebugColor color_of(const tact_debug_color& c) { return {c.red, c.green, c.blue, c.alpha}; }

// The functions of C as a drawer.
class CDrawer : public DebugDrawer {
 public:
  explicit CDrawer(const tact_debug_drawer& drawer) : drawer_(drawer) {}
  void line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const DebugColor& color) override {
    drawer_.line(drawer_.user, from.data(), to.data(), color_of(color));
  }
  void triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                const DebugColor& color) override {
    drawer_.triangle(drawer_.user, p.data(), q.data(), r.data(), color_of(color));
  }
  void text(const Eigen::Vector3d& at, std::string_view words, const DebugColor& color) override {
    drawer_.text(drawer_.user, at.data(), std::string(words).c_str(), color_of(color));
  }

 private:
  tact_debug_drawer drawer_;
};

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
      pass(c.reach, o.reach), pass(c.curve, o.curve), pass(c.word, o.word);
}

tact_debug_draw_options defaults() {
  const DebugDrawOptions options;
  tact_debug_draw_options result{};
  result.struct_size = sizeof result;
  for_each_option(result, options, [](bool& to, bool from) { to = from; });
  for_each_color(result, options, [](tact_debug_color& to, const DebugColor& from) { to = color_of(from); });
  return result;
}

DebugDrawOptions options_of(const tact_debug_draw_options& given) {
  const tact_debug_draw_options c = read_struct(given, defaults());
  DebugDrawOptions result;
  for_each_option(c, result, [](bool from, bool& to) { to = from; });
  for_each_color(c, result, [](const tact_debug_color& from, DebugColor& to) { to = color_of(from); });
  return result;
}

}  // namespace
}  // namespace tact::c

using tact::c::check_not_null, tact::c::guarded, tact::c::reading, tact::c::WorldEntry;

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
    check_not_null(drawer);
    if (drawer->line == nullptr || drawer->triangle == nullptr || drawer->text == nullptr)
      throw tact::c::Failure{TACT_ERROR_NULL_ARGUMENT, "a function of the drawer is null"};
    if (entry.report == nullptr)
      throw tact::c::Failure{TACT_ERROR_WRONG_ORDER,
                             "nothing was found: no step since the world or its settings were made"};
    tact::c::CDrawer to(*drawer);
    tact::debug_draw(entry.world, *entry.report, to,
                     options != nullptr ? tact::c::options_of(*options) : tact::DebugDrawOptions{});
  });
}
}
