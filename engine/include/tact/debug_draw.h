/// What a step found, as lines, triangles and words for an engine's own debug view.
///
///     class Overlay : public tact::DebugDrawer { ... };  // three functions
///     tact::debug_draw(world, world.detect(), overlay, {.zones = true});
#pragma once

#include <tact/report.h>
#include <tact/world.h>

#include <Eigen/Core>
#include <string_view>

namespace tact {

/// Each 0 to 1; alpha 1 covers what is behind.
struct DebugColor {
  float red = 0.0f;
  float green = 0.0f;
  float blue = 0.0f;
  float alpha = 1.0f;
};

/// Where it is drawn. Called on the thread that calls debug_draw(); what these throw passes through it.
class TACT_API DebugDrawer {
 public:
  virtual ~DebugDrawer();
  /// Positions in metres.
  virtual void line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const DebugColor& color) = 0;
  /// Corners in metres, counter-clockwise as in the body.
  virtual void triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                        const DebugColor& color) = 0;
  /// A short word at a place; valid during the call.
  virtual void text(const Eigen::Vector3d& at, std::string_view words, const DebugColor& color) = 0;
};

/// What is drawn, and in which colour. What a step was not asked for (Settings::outputs) is left out.
struct DebugDrawOptions {
  bool surfaces = false;        ///< every facet of every body, as lines
  bool boxes = true;            ///< the box of each body with its margin
  bool candidate_pairs = true;  ///< a line between the centres of two bodies whose boxes overlap
  bool directions = true;       ///< of each contact: an arrow as long as its depth, and the depth as a word
  bool planes = false;          ///< its two contact planes, as squares as wide as the bodies
  bool zones = true;            ///< the disks around its impact zones
  bool kept_facets = false;     ///< the facets that the criteria left, also those that meet none: found once more
  bool facet_pairs = true;      ///< the facets that meet
  bool patches = true;          ///< of each patch: an arrow as long as its depth
  bool points = true;           ///< of each contact point: a line from a to b, and its normal
  bool names = true;            ///< the name of each body, at the top of its box

  DebugColor surface{0.6f, 0.6f, 0.6f, 0.4f};
  DebugColor box{0.5f, 0.5f, 0.5f, 1.0f};
  DebugColor moved_box{1.0f, 1.0f, 1.0f, 1.0f};  ///< of a body with a candidate pair
  DebugColor candidate{0.4f, 0.4f, 0.9f, 1.0f};
  DebugColor direction{1.0f, 0.8f, 0.0f, 1.0f};
  DebugColor plane{0.3f, 0.8f, 1.0f, 0.3f};
  DebugColor zone{0.2f, 1.0f, 0.6f, 1.0f};
  DebugColor kept{1.0f, 0.6f, 0.1f, 0.4f};
  DebugColor meeting{1.0f, 0.1f, 0.1f, 0.8f};
  DebugColor patch{1.0f, 0.4f, 0.0f, 1.0f};
  DebugColor point{1.0f, 0.0f, 1.0f, 1.0f};
  DebugColor word{1.0f, 1.0f, 1.0f, 1.0f};
};

/// Draws what `report`, the last of `world`, found. Bodies are drawn at the positions that were set last: draw before
/// they are set anew. Reads all positions of the bodies whose facets are drawn.
/// Errors: stale_body (a body of the report was removed since), out_of_memory, backend_failure (kept_facets).
TACT_API void debug_draw(const World& world, const Report& report, DebugDrawer& drawer,
                         const DebugDrawOptions& options = {});

}  // namespace tact
