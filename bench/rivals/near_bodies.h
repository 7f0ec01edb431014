// What the rivals for contact points have in common: bodies with boxes of their facets, pairs of bodies, and the loop
// over the features of two facets.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/rivals/near_distances.h"
#include "bench/rivals/near_points.h"
#include "broadphase/sweep_and_prune.h"
#include "narrowphase/contact_points/own_inside.h"
#include "narrowphase/distance/surface_distance.h"
#include "narrowphase/mesh/features.h"
#include "narrowphase/mesh/refit.h"

namespace tact::bench {

using base::Box;
using base::Vec3;
using narrowphase::ClusteredMesh;
using narrowphase::Features;

// A body: what does not change, the boxes of its facets, grown by its margin, and where they are.
struct NearBody {
  NearBody(const WorkloadBody& body, double margin_of_it)
      : mesh({body.positions(0).data(), static_cast<std::size_t>(body.positions(0).size())},
             {body.facets.data(), static_cast<std::size_t>(body.facets.size())}),
        features(mesh),
        margin(margin_of_it),
        is_solid(body.surface == Surface::closed && features.is_closed()),
        boxes(static_cast<std::size_t>(mesh.facet_count())) {
    find_boxes();
  }

  void set(const WorkloadBody& body, int frame) {
    narrowphase::refit(mesh, body.positions(frame).data(), {.largest = kLargestCoordinate, .threads = 1});
    find_boxes();
  }
  void find_boxes() {
    all = {};
    for (int f = 0; f < mesh.facet_count(); ++f) {
      Box box;
      for (const Vec3& p : mesh.triangle(f)) box = base::extended(box, p);
      box = base::grown(box, margin);
      boxes[f] = box;
      all = base::merged(all, box);
    }
  }
  ScaledVertices around(std::span<const int> vertices) const { return {mesh.points(), vertices, 1.0}; }

  ClusteredMesh mesh;
  Features features;
  double margin;
  bool is_solid;  // no point leads through its own inside
  std::vector<Box> boxes;
  Box all;
};

// The points of a pair of facets: those of the vertices and edges that either has first. Of a body with itself features
// that share a vertex have none, nor do those that are too near along the surface, as tact leaves them out.
class FacetPoints {
 public:
  FacetPoints(const NearBody& a, const NearBody& b, int body_a, int body_b, std::vector<NearPoint>& found)
      : a_(a), b_(b), body_a_(body_a), body_b_(body_b), reach_(a.margin + b.margin), found_(found) {}

  /// Of one body each two facets once, and each with itself.
  void find(int facet_a, int facet_b) {
    from_vertices(a_, facet_a, b_, facet_b, FeaturePair::vertex_facet);
    if (!same()) from_vertices(b_, facet_b, a_, facet_a, FeaturePair::facet_vertex);
    if (same() && facet_a != facet_b) from_vertices(b_, facet_b, a_, facet_a, FeaturePair::vertex_facet);
    if (same() && facet_a == facet_b) return;  // its edges share vertices
    for (int i = 0; i < 3; ++i) {
      const int e = own_edge(a_, facet_a, i);
      if (e < 0) continue;
      for (int k = 0; k < 3; ++k) {
        const int f = own_edge(b_, facet_b, k);
        if (f >= 0) between(e, f);
      }
    }
  }

 private:
  static int own_edge(const NearBody& body, int facet, int k) {
    const bool is_own = (body.features.firsts_of_facet(facet) >> k & 1u) != 0;
    return is_own ? body.features.facet_edge(facet, k) : -1;
  }
  bool same() const { return &a_ == &b_; }
  // Whether a way between two features leads through the inside of a body, or back to the same place of a surface.
  bool is_none(const NearBody& one, std::span<const int> of_one, const NearBody& other, std::span<const int> of_other,
               const Nearest& nearest, Vec3 from) {
    const auto leads_inside = [&](const NearBody& body, std::span<const int> feature, Vec3 way) {
      return body.is_solid && narrowphase::leads_inside({&body.mesh, &body.features}, feature, way);
    };
    if (nearest.distance > 0.0 &&
        (leads_inside(one, of_one, nearest.normal) || leads_inside(other, of_other, -nearest.normal)))
      return true;
    return same() &&
           narrowphase::too_near_along([&](int v) { return a_.mesh.position(v); }, a_.features, reach_, {of_one, from},
                                       {of_other, from + nearest.distance * nearest.normal}, ways_);
  }
  void from_vertices(const NearBody& own, int own_facet, const NearBody& other, int facet, FeaturePair kind) {
    const narrowphase::Corners corners = other.mesh.corners(facet);
    const narrowphase::Triangle t = other.mesh.triangle(facet);
    const Vec3 corner[3] = {t[0], t[1], t[2]};
    for (const int vertex : own.mesh.corners(own_facet)) {
      if (own.features.first_facet_of_vertex(vertex) != own_facet) continue;
      const Vec3 v = own.mesh.position(vertex);
      const auto add = [&](const std::optional<Nearest>& nearest, std::span<const int> feature) {
        if (!nearest || (same() && std::ranges::find(feature, vertex) != feature.end())) return;
        if (is_none(own, {&vertex, 1}, other, feature, *nearest, v)) return;
        NearPoint point{body_a_, body_b_, kind, {}, {}, nearest->distance};
        const std::array<int, 3> one = narrowphase::source_vertices(own.mesh, {&vertex, 1});
        const std::array<int, 3> two = narrowphase::source_vertices(other.mesh, feature);
        point.a = kind == FeaturePair::vertex_facet ? one : two;
        point.b = kind == FeaturePair::vertex_facet ? two : one;
        found_.push_back(point);
      };
      add(plain_nearest_inside_facet(v, corner, reach_), corners);
      for (int k = 0; k < 3; ++k) {
        if (const int edge = own_edge(other, facet, k); edge >= 0) {
          const auto ends = other.features.edge(edge);
          add(plain_nearest_inside_edge(v, other.mesh.position(ends[0]), other.mesh.position(ends[1]),
                                        other.around(other.features.opposite(edge)), reach_),
              ends);
        }
        const int w = corners[k];
        if (other.features.first_facet_of_vertex(w) == facet)
          add(plain_nearest_in_vertex(v, corner[k], other.around(other.features.neighbors(w)), reach_), {&w, 1});
      }
    }
  }
  void between(int e, int f) {
    const auto ends_e = a_.features.edge(e), ends_f = b_.features.edge(f);
    if (same() && std::ranges::find_first_of(ends_e, ends_f) != ends_e.end()) return;
    const EdgeEnds at_e{a_.mesh.position(ends_e[0]), a_.mesh.position(ends_e[1])};
    const auto nearest = plain_nearest_between_edges(at_e, a_.around(a_.features.opposite(e)),
                                                     {b_.mesh.position(ends_f[0]), b_.mesh.position(ends_f[1])},
                                                     b_.around(b_.features.opposite(f)), reach_);
    if (!nearest) return;
    const Vec3 on_e = nearest->first[0] * at_e.p + nearest->first[1] * at_e.q;
    if (is_none(a_, ends_e, b_, ends_f, *nearest, on_e)) return;
    NearPoint point{body_a_,
                    body_b_,
                    FeaturePair::edge_edge,
                    narrowphase::source_vertices(a_.mesh, ends_e),
                    narrowphase::source_vertices(b_.mesh, ends_f),
                    nearest->distance};
    if (same() && point.b < point.a) std::swap(point.a, point.b);
    found_.push_back(point);
  }

  const NearBody &a_, &b_;
  int body_a_, body_b_;
  double reach_;
  narrowphase::SurfaceWays ways_;
  std::vector<NearPoint>& found_;
};

// What both have in common: bodies, pairs of them, the list.
class NearBase : public NearRival {
 public:
  NearBase(const Workload& workload, const std::vector<double>& margins) : workload_(workload) {
    for (std::size_t k = 0; k < workload.bodies.size(); ++k) {
      const WorkloadBody& body = workload.bodies[k];
      bodies_.push_back(std::make_unique<NearBody>(body, margins[k]));
      all_.push_back(static_cast<std::uint32_t>(k));
      filters_.push_back({.layer = 1, .mask = body.mask, .fixed = body.fixed(), .group = 0});
    }
    boxes_.resize(bodies_.size());
  }

  void step(int frame) override {
    found_.clear();
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      if (!workload_.bodies[k].fixed()) {
        bodies_[k]->set(workload_.bodies[k], frame);
        moved(k);
      }
      boxes_[k] = bodies_[k]->all;
    }
    for (const auto& [a, b] : sweep_.update(boxes_, filters_, all_, 1)) {
      FacetPoints points(*bodies_[a], *bodies_[b], static_cast<int>(a), static_cast<int>(b), found_);
      propose(a, b, points);
    }
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      if (!workload_.bodies[k].self_contact) continue;
      FacetPoints points(*bodies_[k], *bodies_[k], static_cast<int>(k), static_cast<int>(k), found_);
      propose(k, k, points);
    }
  }

  std::vector<NearPoint> points() const override {
    std::vector<NearPoint> all = found_;
    std::ranges::sort(all, {}, &NearPoint::key);
    return all;
  }

 protected:
  virtual void moved(std::size_t body) = 0;
  virtual void propose(std::size_t a, std::size_t b, FacetPoints& points) = 0;

  const Workload& workload_;
  std::vector<std::unique_ptr<NearBody>> bodies_;

 private:
  broadphase::SweepAndPrune sweep_;
  std::vector<std::uint32_t> all_;
  std::vector<broadphase::Filter> filters_;
  std::vector<Box> boxes_;
  std::vector<NearPoint> found_;
};

}  // namespace tact::bench
