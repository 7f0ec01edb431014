// What queries and sums tell, drawn.
#include <tact/debug_draw.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/floating_point_mode.h"
#include "engine/debug/pen.h"
#include "engine/eigen_vectors.h"
#include "engine/mesh_copies.h"
#include "engine/with_memory.h"

namespace tact {
namespace {

using Eigen::Vector3d;

constexpr const char* kNoMemory = "drawing ran out of memory";
constexpr double kLargestForce = 0.5;  // of the size of all bodies

// A place on a facet as queries name it; none on a plane.
std::optional<Vector3d> place_on(const World& world, MeshCopies& meshes, BodyId body, int facet,
                                 const std::array<double, 3>& barycentric) {
  if (world.plane(body)) return {};
  const MeshCopy& mesh = meshes.mesh(body);
  return to_eigen(mesh.place(mesh.corners(facet), barycentric));
}

void draw_distance(const World& world, const BodyDistance& one, MeshCopies& meshes, DebugDrawer& drawer,
                   const DebugDrawOptions& options) {
  if (one.a_facet < 0 || one.b_facet < 0) return;
  std::optional<Vector3d> on_a = place_on(world, meshes, one.a, one.a_facet, one.a_barycentric),
                          on_b = place_on(world, meshes, one.b, one.b_facet, one.b_barycentric);
  if (!on_a && !on_b) return;  // two planes
  if (!on_a) on_a = foot(*world.plane(one.a), *on_b);
  if (!on_b) on_b = foot(*world.plane(one.b), *on_a);
  drawer.line(*on_a, *on_b, options.distance);
  drawer.text(0.5 * *on_a + 0.5 * *on_b, metres(one.distance), options.word);
}

void draw_sum(const ContactSum& sum, double metres_a_newton, Pen& pen, const DebugDrawOptions& options) {
  if (sum.points == 0) return;
  if (sum.kind == ContactSum::Kind::patch && !sum.normal.isZero()) {
    const double radius = std::sqrt(sum.area / std::numbers::pi);
    pen.circle(sum.center, radius, sum.normal.normalized(), options.sum);
    pen.arrow(sum.center, radius * sum.normal, options.sum);
  }
  if (!sum.force.isZero()) pen.arrow(sum.center, metres_a_newton * sum.force, options.force);
}

}  // namespace

void debug_draw_distances(const World& world, std::span<const BodyDistance> distances, DebugDrawer& drawer,
                          const DebugDrawOptions& options) {
  const base::FloatingPointMode mode;
  with_memory(kNoMemory, [&] {
    MeshCopies meshes(world);
    for (const BodyDistance& one : distances) draw_distance(world, one, meshes, drawer, options);
  });
}

void debug_draw_sums(const World& world, const ContactSums& sums, DebugDrawer& drawer,
                     const DebugDrawOptions& options) {
  const base::FloatingPointMode mode;
  with_memory(kNoMemory, [&] {
    const Bounds all = bounds_of_all(world);
    double largest = 0.0;
    for (const ContactSum& sum : sums.sums) largest = std::max(largest, sum.force.norm());
    const double metres_a_newton = largest > 0.0 && !is_empty(all) ? kLargestForce * size(all) / largest : 0.0;
    Pen pen(drawer);
    for (std::size_t i = 0; i < sums.sums.size(); ++i) {
      // Its patches have its forces.
      const bool has_patches = i + 1 < sums.sums.size() && sums.sums[i + 1].kind == ContactSum::Kind::patch;
      if (sums.sums[i].kind != ContactSum::Kind::contact || !has_patches)
        draw_sum(sums.sums[i], metres_a_newton, pen, options);
    }
  });
}

}  // namespace tact
