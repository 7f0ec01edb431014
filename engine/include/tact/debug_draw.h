/// Draws what a step found as lines, triangles and words.
///
///     class Overlay : public tact::DebugDrawer { ... };  // three functions
///     tact::debug_draw(world, world.detect(), overlay, {.zones = true});
#pragma once

#include <tact/body_queries.h>
#include <tact/contact_sums.h>
#include <tact/report.h>
#include <tact/world.h>

#include <Eigen/Core>
#include <span>
#include <string_view>

namespace tact {

/// A colour; an alpha of 1 covers what is behind.
struct DebugColor {
  float red = 0.0f;    ///< 0 to 1
  float green = 0.0f;  ///< 0 to 1
  float blue = 0.0f;   ///< 0 to 1
  float alpha = 1.0f;  ///< 0 to 1
};

/// Takes the drawing, on the thread of debug_draw(), which passes exceptions on.
class TACT_API DebugDrawer {
 public:
  virtual ~DebugDrawer();
  /// Draws a line; metres.
  virtual void line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const DebugColor& color) = 0;
  /// Draws a triangle, counter-clockwise as in the body; metres.
  virtual void triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                        const DebugColor& color) = 0;
  /// Writes a short word, which is valid during the call.
  virtual void text(const Eigen::Vector3d& at, std::string_view words, const DebugColor& color) = 0;
};

/// What is drawn, and in which colour. Outputs that the step did not compute are left out.
struct DebugDrawOptions {
  bool surfaces = false;        ///< every facet of every body, as lines
  bool boxes = true;            ///< the box of each body with its margin
  bool candidate_pairs = true;  ///< a line between the centres of two bodies whose boxes overlap
  bool directions = true;       ///< the direction of each contact, as long as its depth, and the depth
  bool planes = false;          ///< the contact planes, as squares as wide as the bodies
  bool zones = true;            ///< the disks around impact zones
  bool kept_facets = false;     ///< the facets that the criteria kept, found once more
  bool facet_pairs = true;      ///< the facets that meet
  bool patches = true;          ///< the direction of each patch, as long as its depth
  bool points = true;           ///< each contact point, as a line from a to b, and its normal; faint if no minimum
  bool within_reach = true;     ///< each pair of features within reach, as a line from a to b
  bool curves = true;           ///< the curves in which surfaces cross
  bool names = true;            ///< the name of each body, at the top of its box

  DebugColor surface{0.6f, 0.6f, 0.6f, 0.4f};
  DebugColor box{0.5f, 0.5f, 0.5f, 1.0f};
  DebugColor moved_box{1.0f, 1.0f, 1.0f, 1.0f};  ///< the box of a body with a candidate pair
  DebugColor candidate{0.4f, 0.4f, 0.9f, 1.0f};
  DebugColor direction{1.0f, 0.8f, 0.0f, 1.0f};
  DebugColor plane{0.3f, 0.8f, 1.0f, 0.3f};
  DebugColor zone{0.2f, 1.0f, 0.6f, 1.0f};
  DebugColor kept{1.0f, 0.6f, 0.1f, 0.4f};
  DebugColor meeting{1.0f, 0.1f, 0.1f, 0.8f};
  DebugColor patch{1.0f, 0.4f, 0.0f, 1.0f};
  DebugColor point{1.0f, 0.0f, 1.0f, 1.0f};
  DebugColor curve{1.0f, 1.0f, 0.0f, 1.0f};
  DebugColor reach{0.9f, 0.6f, 1.0f, 0.6f};
  DebugColor distance{0.4f, 1.0f, 1.0f, 1.0f};
  DebugColor sum{1.0f, 0.7f, 0.4f, 1.0f};
  DebugColor force{1.0f, 0.2f, 0.6f, 1.0f};
  DebugColor word{1.0f, 1.0f, 1.0f, 1.0f};
};

/// Draws the last report of `world` at the current positions. Errors: stale_body (a body of the report was removed),
/// wrong_order (its facets have changed since), out_of_memory, backend_failure.
TACT_API void debug_draw(const World& world, const Report& report, DebugDrawer& drawer,
                         const DebugDrawOptions& options = {});

/// Draws distances of bodies of `world`: a line between the two places, and its length. Those of bodies that are
/// farther apart than requested are left out. Errors: stale_body, wrong_order (facets have changed since),
/// out_of_memory.
TACT_API void debug_draw_distances(const World& world, std::span<const BodyDistance> distances, DebugDrawer& drawer,
                                   const DebugDrawOptions& options = {});
/// Draws each patch of `sums` as a circle of its area across its normal, and forces as arrows, the largest half as long
/// as all bodies of `world`. Forces of a contact with patches are drawn at these. Errors: out_of_memory.
TACT_API void debug_draw_sums(const World& world, const ContactSums& sums, DebugDrawer& drawer,
                              const DebugDrawOptions& options = {});

}  // namespace tact
