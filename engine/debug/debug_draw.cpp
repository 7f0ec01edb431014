// Made from the public interface, but for the facets that were kept: whatever else is drawn here, a program can draw in
// its own way.
#include <tact/debug_draw.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/floating_point_mode.h"
#include "engine/debug/pen.h"
#include "engine/eigen_vectors.h"
#include "engine/facet_outcomes.h"
#include "engine/mesh_copies.h"
#include "engine/with_memory.h"

namespace tact {
namespace {

using Eigen::Vector3d;

constexpr float kFaint = 0.3f;

class Drawing {
 public:
  Drawing(const World& world, const Report& report, DebugDrawer& drawer, const DebugDrawOptions& options)
      : world_(world), report_(report), drawer_(drawer), options_(options) {
    if (options.kept_facets) outcomes_.emplace(report);
  }

  void draw() {
    draw_bodies();
    for (const CandidatePair& pair : report_.candidate_pairs()) draw_candidate(pair);
    for (const Contact& contact : report_.contacts()) draw_contact(contact);
  }

 private:
  // A square as wide as all bodies, below the middle of them.
  void draw_half_space(BodyId body, const Plane& plane) {
    const Vector3d at = foot(plane, middle_);
    const Vector3d u = 0.5 * size_ * plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    if (options_.surfaces) {
      const std::array<Vector3d, 4> corner{at - u - v, at + u - v, at + u + v, at - u + v};
      for (std::size_t k = 0; k < 4; ++k) drawer_.line(corner[k], corner[(k + 1) % 4], options_.surface);
    }
    if (options_.names) drawer_.text(at, world_.name(body), options_.word);
  }

  void draw_bodies() {
    if (const Bounds all = bounds_of_all(world_); !is_empty(all)) middle_ = middle(all), size_ = size(all);
    std::vector<BodyId> paired;
    for (const CandidatePair& pair : report_.candidate_pairs()) paired.insert(paired.end(), {pair.a, pair.b});
    std::ranges::sort(paired);
    for (const BodyId body : world_.bodies()) {
      if (const std::optional<Plane> plane = world_.plane(body)) {
        draw_half_space(body, *plane);
        continue;
      }
      const Bounds bounds = world_.bounds(body);
      if (is_empty(bounds)) continue;
      const bool has_pair = std::ranges::binary_search(paired, body);
      if (options_.boxes) draw_box(bounds, has_pair ? options_.moved_box : options_.box);
      if (options_.surfaces) draw_surface(meshes_.mesh(body), world_.margin(body));
      if (options_.names) {
        Vector3d top = middle(bounds);
        top.z() = bounds.upper[2];
        drawer_.text(top, world_.name(body), options_.word);
      }
    }
  }

  void draw_candidate(const CandidatePair& pair) {
    if (!options_.candidate_pairs) return;
    const std::optional<Plane> plane_a = world_.plane(pair.a), plane_b = world_.plane(pair.b);
    const Vector3d of_body = middle(world_.bounds(plane_a ? pair.b : pair.a));
    const Vector3d other = plane_a   ? foot(*plane_a, of_body)
                           : plane_b ? foot(*plane_b, of_body)
                                     : middle(world_.bounds(pair.b));
    drawer_.line(of_body, other, options_.candidate);
  }

  void draw_contact(const Contact& contact) {
    const bool with_itself = contact.a == contact.b;
    if (!with_itself) draw_hulls(contact);
    if (outcomes_) draw_kept_facets(contact);
    if (options_.facet_pairs) draw_facet_pairs(contact);
    if (options_.patches) {
      for (const Patch& patch : contact.patches())
        pen_.arrow(patch.point, patch.depth * patch.direction, options_.patch);
    }
    if (options_.points) {
      for (const ContactPoint& point : contact.points()) draw_point(contact, point);
    }
    if (options_.curves) {
      for (const IntersectionCurve& curve : contact.curves()) draw_curve(curve);
    }
    if (options_.within_reach) {
      for (const ReachPair& pair : contact.within_reach())
        drawer_.line(place_on(contact.a, pair.a_vertices, pair.a_weights),
                     place_on(contact.b, pair.b_vertices, pair.b_weights), options_.reach);
    }
  }

  // The direction begins in the middle of what the two boxes have in common.
  void draw_hulls(const Contact& contact) {
    const Bounds a = world_.bounds(contact.a), b = world_.bounds(contact.b);
    const Vector3d at = 0.5 * lower(a).cwiseMax(lower(b)) + 0.5 * upper(a).cwiseMin(upper(b));
    const Vector3d n = contact.direction;
    if (options_.directions) {
      pen_.arrow(at, contact.depth * n, options_.direction);
      drawer_.text(at, metres(contact.depth), options_.word);
    }
    if (options_.planes) {
      const double width = 0.5 * std::min(size(a), size(b));
      draw_plane(at + (contact.plane_a - n.dot(at)) * n, n, width);
      draw_plane(at + (contact.plane_b - n.dot(at)) * n, n, width);
    }
    if (options_.zones) {
      draw_disk(contact.zone_a, n);
      draw_disk(contact.zone_b, n);
    }
  }

  void draw_kept_facets(const Contact& contact) {
    const std::optional<FacetOutcomes> outcomes = outcomes_->find(contact);
    if (!outcomes) return;
    for (const auto& [body, of_facets] : {std::pair{contact.a, &outcomes->a}, std::pair{contact.b, &outcomes->b}}) {
      for (std::size_t f = 0; f < of_facets->size(); ++f) {
        if ((*of_facets)[f] == FacetOutcome::kept || (!options_.facet_pairs && (*of_facets)[f] == FacetOutcome::meets))
          draw_triangle(meshes_.mesh(body), static_cast<int>(f), options_.kept);
      }
    }
  }

  Vector3d place_on(BodyId body, const std::array<int, 3>& vertices, const std::array<double, 3>& weights) {
    return to_eigen(meshes_.positions(body).place(vertices, weights));
  }

  // Each facet once, however many it meets.
  void draw_facet_pairs(const Contact& contact) {
    std::vector<int> a, b;
    for (const FacetPair& pair : contact.facet_pairs()) a.push_back(pair.a), b.push_back(pair.b);
    if (contact.a == contact.b) a.insert(a.end(), b.begin(), b.end()), b.clear();
    for (auto [body, facets] : {std::pair{contact.a, &a}, std::pair{contact.b, &b}}) {
      std::ranges::sort(*facets);
      facets->erase(std::unique(facets->begin(), facets->end()), facets->end());
      for (const int f : *facets) {
        if (!world_.plane(body)) draw_triangle(meshes_.mesh(body), f, options_.meeting);
      }
    }
  }

  void draw_point(const Contact& contact, const ContactPoint& point) {
    Vector3d on_a = place_on(contact.a, point.a_vertices, point.a_weights);
    Vector3d on_b = place_on(contact.b, point.b_vertices, point.b_weights);
    if (point.kind == FeaturePair::vertex_plane) on_b = on_a + point.gap * point.normal;
    if (point.kind == FeaturePair::plane_vertex) on_a = on_b - point.gap * point.normal;
    const double reach = world_.margin(contact.a) + world_.margin(contact.b);
    DebugColor color = options_.point;
    if (!point.minimum) color.alpha *= kFaint;
    drawer_.line(on_a, on_b, color);
    pen_.arrow(on_a, std::max(reach, std::abs(point.gap)) * point.normal, color);
  }

  void draw_curve(const IntersectionCurve& curve) {
    const auto& points = curve.points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      drawer_.line(points[i].position, points[i + 1].position, options_.curve);
    if (curve.closed) drawer_.line(points.back().position, points.front().position, options_.curve);
  }

  // Points as crosses as wide as their balls.
  void draw_surface(const MeshCopy& mesh, double margin) {
    const auto at = [&](int v) { return to_eigen(mesh.vertex(v)); };
    for (std::size_t e = 0; e + 1 < mesh.ends().size(); e += 2)
      drawer_.line(at(mesh.ends()[e]), at(mesh.ends()[e + 1]), options_.surface);
    for (const int v : mesh.points()) {
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d arm = margin * Vector3d::Unit(axis);
        drawer_.line(at(v) - arm, at(v) + arm, options_.surface);
      }
    }
    for (int f = 0; f < mesh.facet_count(); ++f) {
      const auto [p, q, r] = mesh.corners(f);
      drawer_.line(at(p), at(q), options_.surface);
      drawer_.line(at(q), at(r), options_.surface);
      drawer_.line(at(r), at(p), options_.surface);
    }
  }

  void draw_triangle(const MeshCopy& mesh, int f, const DebugColor& color) {
    const auto [p, q, r] = mesh.facet(f);
    drawer_.triangle(to_eigen(p), to_eigen(q), to_eigen(r), color);
  }

  void draw_box(const Bounds& bounds, const DebugColor& color) {
    const auto corner = [&](int bits) {
      Vector3d at;
      for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        at[axis] = bits >> axis & 1 ? bounds.upper[k] : bounds.lower[k];
      }
      return at;
    };
    for (int bits = 0; bits < 8; ++bits) {
      for (int axis = 0; axis < 3; ++axis) {
        if ((bits >> axis & 1) == 0) drawer_.line(corner(bits), corner(bits | 1 << axis), color);
      }
    }
  }

  void draw_plane(const Vector3d& at, const Vector3d& n, double width) {
    const Vector3d u = width * n.unitOrthogonal(), v = n.cross(u);
    drawer_.triangle(at - u - v, at + u - v, at + u + v, options_.plane);
    drawer_.triangle(at - u - v, at + u + v, at - u + v, options_.plane);
  }

  void draw_disk(const ZoneDisk& disk, const Vector3d& n) {
    if (disk.radius >= 0.0) pen_.circle(disk.center, disk.radius, n, options_.zone);
  }

  const World& world_;
  const Report& report_;
  DebugDrawer& drawer_;
  const DebugDrawOptions& options_;
  std::optional<FacetOutcomeFinder> outcomes_;
  Vector3d middle_ = Vector3d::Zero();
  double size_ = 1.0;
  Pen pen_{drawer_};
  MeshCopies meshes_{world_};
};

}  // namespace

DebugDrawer::~DebugDrawer() = default;

void debug_draw(const World& world, const Report& report, DebugDrawer& drawer, const DebugDrawOptions& options) {
  const base::FloatingPointMode mode;
  with_memory("drawing ran out of memory", [&] { Drawing(world, report, drawer, options).draw(); });
}

}  // namespace tact
