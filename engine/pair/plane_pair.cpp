#include "engine/pair/plane_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "narrowphase/hull/support.h"

namespace tact {

namespace {

using base::Box;
using base::Vec3;
using narrowphase::ClusteredMesh;
using narrowphase::HalfSpace;

// Heights over the plane of a mesh, exact where that is needed.
class Heights {
 public:
  Heights(const ClusteredMesh& mesh, const HalfSpace& plane)
      : mesh_(mesh), plane_(plane), error_(narrowphase::height_error(plane, mesh.box())) {}

  const ClusteredMesh& mesh() const { return mesh_; }
  double error() const { return error_; }
  double exact(int vertex) const { return narrowphase::height_over(plane_, mesh_.position(vertex)); }
  int side(int vertex) const {
    const double rough = narrowphase::rough_height_over(plane_, mesh_.position(vertex));
    if (rough > error_) return 1;
    if (rough < -error_) return -1;
    const double height = exact(vertex);
    return (height > 0.0) - (height < 0.0);
  }
  // The vertices that may be as low as `height`, or, of the other sign of `up`, as high.
  void select(double height, bool up, std::vector<std::int32_t>& found) const {
    const double along = plane_.offset + height;
    narrowphase::select_vertices(mesh_, up ? plane_.normal : -plane_.normal, {},
                                 (up ? along : -along) - 2.0 * error_ - 0x1p-50 * std::abs(along), found);
  }
  narrowphase::Support lowest(int near) const { return narrowphase::support(mesh_, -plane_.normal, {}, near); }
  // Whether a box of vertices is all on one side.
  bool is_on_one_side(const Box& box) const {
    const double lowest = narrowphase::rough_height_over(plane_, narrowphase::lowest_corner(plane_, box));
    const HalfSpace below{-plane_.normal, -plane_.offset};
    const double highest = -narrowphase::rough_height_over(below, narrowphase::lowest_corner(below, box));
    return lowest > error_ || highest < -error_;
  }

 private:
  const ClusteredMesh& mesh_;
  const HalfSpace& plane_;
  double error_;
};

// A lowest vertex; of several the first of the caller's.
struct Lowest {
  int vertex = -1;
  double height = std::numeric_limits<double>::infinity();
};

Lowest lowest_of(const Heights& heights, std::span<const std::int32_t> chosen) {
  Lowest lowest;
  for (const int vertex : chosen) {
    const double height = heights.exact(vertex);
    const bool precedes =
        lowest.vertex < 0 || heights.mesh().source_vertex(vertex) < heights.mesh().source_vertex(lowest.vertex);
    if (height < lowest.height || (height == lowest.height && precedes)) lowest = {vertex, height};
  }
  return lowest;
}

// Facets with corners on both sides, or on the plane.
void find_facets(const Heights& heights, bool plane_is_a, PairRecord& record, PairCounts& counts) {
  const ClusteredMesh& mesh = heights.mesh();
  counts.facets += mesh.facet_count();
  counts.clusters += mesh.cluster_count();
  for (int g = 0; g < mesh.group_count(); ++g) {
    if (mesh.group_count() > 1 && heights.is_on_one_side(mesh.group_boxes()[g])) continue;
    for (int c = mesh.cluster_begin(g); c < mesh.cluster_end(g); ++c) {
      if (heights.is_on_one_side(mesh.cluster_boxes()[c])) continue;
      ++counts.cluster_pairs;
      for (int f = mesh.facet_begin(c); f < mesh.facet_end(c); ++f) {
        const narrowphase::Corners corners = mesh.corners(f);
        const std::array<int, 3> sides{heights.side(corners[0]), heights.side(corners[1]), heights.side(corners[2])};
        const auto [least, most] = std::ranges::minmax(sides);
        if (least > 0 || most < 0) continue;
        const int facet = mesh.source_facet(f);
        const FacetPair pair = plane_is_a ? FacetPair{0, facet} : FacetPair{facet, 0};
        (mesh.is_of_surface(facet) ? record.facet_pairs : record.bare_pairs).push_back(pair);
      }
    }
  }
  std::ranges::sort(record.facet_pairs);
  std::ranges::sort(record.bare_pairs);
}

void fill_contact(const BodyAndPlane& pair, double lowest, PairRecord& record) {
  Contact& contact = record.contact;
  contact = Contact{};
  contact.a = record.a;
  contact.b = record.b;
  const Vec3 direction = pair.direction();
  contact.direction = {direction.x, direction.y, direction.z};
  contact.depth = 0.0 - lowest;
  contact.source = DirectionSource::smallest;
  const double of_plane = pair.plane->offset, of_body = pair.plane->offset + lowest;
  contact.plane_a = pair.plane_is_a ? of_plane : -of_body;
  contact.plane_b = pair.plane_is_a ? of_body : -of_plane;
}

}  // namespace

BodyAndPlane find_body_and_plane(const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  if (const HalfSpace* const plane = bodies.plane(a)) return {&bodies.in_slot(b), plane, true};
  if (const HalfSpace* const plane = bodies.plane(b)) return {&bodies.in_slot(a), plane, false};
  return {};
}

void find_near_vertices(const BodyAndPlane& pair, double reach, std::vector<std::int32_t>& found) {
  Heights(pair.body->mesh, *pair.plane).select(reach, false, found);
}

// The vertex that was lowest in the last step shortens the search, and changes nothing else.
void look_at_plane(const BodyAndPlane& pair, double reach, const Settings& settings, PairRecord& record,
                   std::vector<std::int32_t>& chosen, PairCounts& counts) {
  const Heights heights(pair.body->mesh, *pair.plane);
  narrowphase::GjkSimplex& last = record.history.hulls;
  int& last_vertex = pair.plane_is_a ? last.b[0] : last.a[0];
  const narrowphase::Support rough = heights.lowest(last.count == 1 ? last_vertex : -1);
  last = {};
  last.count = 1;
  last_vertex = rough.vertex;
  record.hulls_overlap = record.near = false;
  record.face.count = 0;  // of an earlier pair, if its record is used again
  ++counts.gjk_iterations;
  const double rough_lowest = -rough.height - pair.plane->offset;
  if (rough_lowest > reach + 2.0 * heights.error() + 0x1p-50 * reach) {
    ++counts.separated;
    return;
  }
  heights.select(rough_lowest + heights.error(), false, chosen);
  const Lowest lowest = lowest_of(heights, chosen);
  last_vertex = lowest.vertex;
  record.hulls_overlap = lowest.height <= 0.0;
  record.near = !record.hulls_overlap && lowest.height < reach;
  if (!in_contact(record)) {
    ++counts.separated;
    return;
  }
  fill_contact(pair, lowest.height, record);
  if (!record.hulls_overlap) {
    ++counts.separated;
    return;
  }
  ++counts.smallest_directions;
  if (settings.accuracy == Accuracy::hulls) return;
  find_facets(heights, pair.plane_is_a, record, counts);
  if (any_meet(record)) return;
  heights.select(0.0, true, chosen);
  const bool all_below = std::ranges::all_of(chosen, [&](int vertex) { return heights.side(vertex) < 0; });
  if (all_below) record.contact.containment = pair.plane_is_a ? Containment::b_in_a : Containment::a_in_b;
}

}  // namespace tact
