#include <tact/joined_minima.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "broadphase/index_pair.h"
#include "engine/base/floating_point_mode.h"
#include "engine/base/text.h"
#include "engine/base/vec3.h"
#include "engine/eigen_vectors.h"
#include "engine/mesh_copies.h"
#include "engine/with_memory.h"
#include "narrowphase/distance/vertex_facet.h"

namespace tact {

namespace {

using base::Vec3;

// Of the size of coordinates: a place is a sum of three products, and vertices of joined facets may have been turned
// and rounded each on its own, which takes some 8 roundings of 2^-53.
constexpr double kRounding = 0x1p-46;
// Slopes that are level, as in local_minimum.cpp.
constexpr double kLevel = 0x1p-30;
// A facet is across a unit vector if their normals differ by less, in radians: normals of slender facets are off so
// far.
constexpr double kAcross = 1e-6;

double size_of(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// 1 if the normal of a facet is `towards`, a unit vector; -1 if it is the opposite.
int looks_along(const std::array<Vec3, 3>& corners, Vec3 towards) {
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double along = dot(normal, towards), area = norm(normal);
  if (!(area > 0.0 && norm(normal - along * towards) <= kAcross * area)) return 0;
  return along > 0.0 ? 1 : -1;
}

// One of the two places of a point that is a minimum so far.
struct Side {
  std::size_t point = 0;  // its number in the report
  BodyId own, other;
  Vec3 place, other_place;
  Vec3 towards;       // unit, to the other body
  double near = 0.0;  // what is no farther is at the place
  // Whether what is nearer to the other place is a better one; else what leads farther: of a vertex that has crossed.
  bool nearer_is_better = true;
};

class JoinedMinima {
 public:
  JoinedMinima(const World& world, const JoinedSurfaces& joined) : world_(world), joined_(joined), meshes_(world) {}

  std::vector<std::uint8_t> of(const Report& report) {
    for (const Contact& contact : report.contacts()) {
      for (const ContactPoint& point : contact.points()) {
        check_there(contact.a, point.a_vertices);
        check_there(contact.b, point.b_vertices);
        if (point.minimum) add_sides(contact, point);
        minima_.push_back(point.minimum ? 1 : 0);
      }
    }
    std::vector<BoxQuery> boxes;
    for (const Side& side : sides_) {
      const Vec3 reach{side.near, side.near, side.near};
      boxes.push_back({to_eigen(side.place - reach), to_eigen(side.place + reach)});
    }
    std::vector<std::vector<FacetOfBody>> found(boxes.size());
    world_.overlap_boxes(boxes, found);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      if (!is_minimum(sides_[i], found[i])) minima_[sides_[i].point] = 0;
    }
    return std::move(minima_);
  }

 private:
  // Refuses bodies that were removed, and vertices that are there no more.
  void check_there(BodyId body, const std::array<int, 3>& vertices) {
    const MeshCopy& mesh = meshes_.positions(body);
    for (std::size_t k = 0; k < 3 && vertices[k] >= 0; ++k) mesh.vertex(vertices[k]);
  }

  void add_sides(const Contact& contact, const ContactPoint& point) {
    const Vec3 n = from_eigen(point.normal);
    const bool on_plane_a = point.kind == FeaturePair::plane_vertex,
               on_plane_b = point.kind == FeaturePair::vertex_plane;
    // Of a plane, where its place would be.
    Vec3 on_a = on_plane_a ? Vec3{} : meshes_.positions(contact.a).place(point.a_vertices, point.a_weights),
         on_b = on_plane_b ? Vec3{} : meshes_.positions(contact.b).place(point.b_vertices, point.b_weights);
    if (on_plane_a) on_a = on_b - point.gap * n;
    if (on_plane_b) on_b = on_a + point.gap * n;
    const bool of_vertex_b = point.kind == FeaturePair::facet_vertex || point.kind == FeaturePair::edge_vertex,
               of_vertex_a = point.kind == FeaturePair::vertex_facet || point.kind == FeaturePair::vertex_edge;
    const bool apart = point.gap >= 0.0;
    const Side a{minima_.size(),      contact.a, contact.b, on_a, on_b, n, near(contact.a, point.a_vertices),
                 apart || of_vertex_b},
        b{minima_.size(),      contact.b, contact.a, on_b, on_a, -n, near(contact.b, point.b_vertices),
          apart || of_vertex_a};
    // Where a body touches itself, nothing tells which of the facets there are of which side.
    if (contact.a == contact.b && std::abs(point.gap) <= 2.0 * std::max(a.near, b.near)) return;
    if (!on_plane_a) sides_.push_back(a);
    if (!on_plane_b) sides_.push_back(b);
  }

  double near(BodyId body, const std::array<int, 3>& vertices) {
    double size = 0.0;
    for (std::size_t k = 0; k < 3 && vertices[k] >= 0; ++k)
      size = std::max(size, largest_coordinate(meshes_.positions(body).vertex(vertices[k])));
    return joined_.within + kRounding * size;
  }

  broadphase::Filter filter(BodyId body) const {
    return {world_.layer(body), world_.mask(body), world_.motion(body) == Motion::fixed, world_.group(body)};
  }

  bool are_joined(BodyId a, BodyId b) const {
    if (a == b) return true;
    if ((world_.layer(a) & joined_.layers) != 0 && (world_.layer(b) & joined_.layers) != 0) return true;
    return !broadphase::tested(filter(a), filter(b)) || world_.excluded(a, b);
  }

  // The corners of what is found at a side's place, if it is a facet of the same surface.
  std::optional<std::array<Vec3, 3>> joined_facet(const Side& side, const FacetOfBody& one) {
    if (one.body != side.own &&
        (one.body == side.other || !are_joined(side.own, one.body) || are_joined(side.other, one.body)))
      return {};
    const MeshCopy& mesh = meshes_.mesh(one.body);
    if (one.facet >= mesh.facet_count()) return {};  // planes, ropes and grains
    return mesh.facet(one.facet);
  }

  // Whether a facet at the place has a better one, beyond what counts as the same place.
  static bool is_better(const Side& side, const std::array<Vec3, 3>& corners) {
    if (!side.nearer_is_better)
      return std::ranges::any_of(corners, [&](Vec3 corner) {
        const Vec3 way = corner - side.place;
        return dot(way, side.towards) > kLevel * size_of(way) + side.near;
      });
    const Vec3 nearest = narrowphase::place_of(corners, narrowphase::weights_about(side.other_place, corners));
    const double same =
        2.0 * (side.near + kRounding * std::max({largest_coordinate(corners[0]), largest_coordinate(corners[1]),
                                                 largest_coordinate(corners[2])}));
    return norm(nearest - side.place) > same && norm(nearest - side.other_place) < norm(side.place - side.other_place);
  }

  bool is_minimum(const Side& side, std::span<const FacetOfBody> there) {
    bool is_beaten = false, is_across = false, is_hidden = false;
    for (const FacetOfBody& one : there) {
      const std::optional<std::array<Vec3, 3>> corners = joined_facet(side, one);
      if (!corners) continue;
      const int looks = looks_along(*corners, side.towards);
      // Another body begins where the facet of this one ends.
      is_hidden = is_hidden || (one.body != side.own && looks < 0 && world_.surface(one.body) == Surface::closed);
      is_across = is_across || (one.body == side.own && looks != 0);
      is_beaten = is_beaten || is_better(side, *corners);
    }
    return is_across ? !is_hidden : !is_beaten;
  }

  const World& world_;
  const JoinedSurfaces& joined_;
  MeshCopies meshes_;
  std::vector<Side> sides_;
  std::vector<std::uint8_t> minima_;
};

}  // namespace

std::vector<std::uint8_t> joined_minima(const World& world, const Report& report, const JoinedSurfaces& joined) {
  const base::FloatingPointMode mode;
  return with_memory("finding joined minima ran out of memory", [&] {
    if (!(joined.within >= 0.0 && std::isfinite(joined.within)))
      throw Error(ErrorCode::invalid_argument, "within is " + base::text_of(joined.within) + ", not 0 or more metres");
    return JoinedMinima(world, joined).of(report);
  });
}

}  // namespace tact
