// A body: a mesh of facets, edges and points with an identity, or a plane.
#pragma once

#include <tact/columns.h>

#include <Eigen/Core>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace tact {

/// Names a body of one world. No id is given out twice: that of a removed body stays stale, unless World::restore()
/// brings the body back.
struct BodyId {
  std::uint32_t index = 0;       ///< the place of the body in its world; that of a removed body is used again
  std::uint32_t generation = 0;  ///< 0 in the id of no body
  std::uint32_t world = 0;       ///< the world that gave the id out
  friend constexpr auto operator<=>(const BodyId&, const BodyId&) = default;
};

/// What the facets of a body are.
enum class Surface {
  closed,  ///< a solid's surface, facets counter-clockwise seen from outside; taken as a sheet if it has a border
  sheet,   ///< cloth: no inside, both sides count
};

/// How a body moves.
enum class Motion {
  deformable,  ///< World::set_positions() moves its vertices
  fixed,       ///< nothing moves it; two fixed bodies are never tested against each other
  rigid,       ///< World::set_pose() turns and moves it, and its shape stays
};

/// The largest magnitude of a coordinate, 2^300 metres. All smaller numbers, subnormal ones included, are decided
/// exactly.
inline constexpr double kLargestCoordinate = 0x1p300;

/// What World::add_body() adds: vertices, and the facets, edges and points that they make. Positions have no default.
struct BodyDefinition {
  Positions positions;  ///< 3 x V, metres; the rest shape of a rigid body
  /// 3 x F, indices of vertices. Any triangle soup is accepted, also one of no facet. A vertex that no facet, edge or
  /// point uses touches nothing.
  Facets facets = Facets::none();
  /// 2 x E, indices of vertices: ropes and hair. With a margin they are capsules.
  Edges edges = Edges::none();
  /// Vertices that stand alone: grains. With a margin they are balls.
  std::span<const int> points = {};
  /// Of the facets alone: edges and points have no inside. A body of edges or points alone is a sheet.
  Surface surface = Surface::closed;
  Motion motion = Motion::deformable;
  std::string name = {};             ///< for messages; by default "body <index>"
  std::uint32_t layer = 1;           ///< the layers that the body is on, a bit each
  std::uint32_t mask = 0xffffffffu;  ///< the layers that the body is tested against; a pair needs both masks
  /// Bodies of one group are not tested against each other. 0 is no group.
  std::uint32_t group = 0;
  std::uint64_t external_id = 0;  ///< the program's own number; no answer depends on it
  /// The order of bodies in all answers, and what ids of points and patches are made of; by default the index. Each
  /// body of a world has another.
  std::optional<std::uint64_t> key = {};
  /// How far ahead of the surface contact points are seen, metres, 0 to kLargestCoordinate. Those of two bodies add up.
  double margin = 0.0;
  bool self_contact = false;  ///< whether the body is tested against itself, too
  /// What the body adds to the distance that surfaces keep, metres, 0 to the margin; by default the margin, whatever
  /// that becomes. Those of two bodies add up.
  std::optional<double> rest_offset = {};
};

/// Settings of single vertices and facets of a body. An empty array sets nothing.
struct FeatureSettings {
  /// What each vertex adds to the distance that surfaces keep, metres, 0 to the margin. An edge or a facet adds the
  /// largest of its vertices.
  std::span<const double> rest_offsets = {};
  std::span<const std::uint32_t> vertex_labels = {};  ///< the program's own numbers, one a vertex
  std::span<const std::uint32_t> facet_labels = {};   ///< the program's own numbers, one a facet
  /// The layers that each vertex is on, a bit each; by default those of the body.
  std::span<const std::uint32_t> vertex_layers = {};
  /// The layers that each vertex is tested against; by default those of the body. Two features are tested if each
  /// vertex of the one is tested against each vertex of the other.
  std::span<const std::uint32_t> vertex_masks = {};
  /// The layers that each facet is on, a bit each; by default those of the body.
  std::span<const std::uint32_t> facet_layers = {};
  /// The layers that each facet is tested against; by default those of the body. Vertices and edges are tested where
  /// any facet that has the one is tested against any that has the other.
  std::span<const std::uint32_t> facet_masks = {};
  /// How far ahead of each vertex contact points are seen, metres, 0 to the margin of the body. An edge or a facet has
  /// the largest of its vertices.
  std::span<const double> margins = {};
};

/// Which features of a body that is tested against itself are too near to each other to be tested.
struct SelfContactFilter {
  /// Features with vertices at most so many edges apart are left out, 0 to 16; 0 leaves out
  /// those with a common vertex alone.
  int rings = 0;
  /// Features with vertices at most so far apart at rest are left out, metres, 0 to kLargestCoordinate; 0 leaves out
  /// none.
  double rest_distance = 0.0;
  /// Where vertices are at rest, metres; by default where they are when the filter is set. It is 3 x V.
  Positions rest_positions = Positions::none();
};

/// What has a label.
enum class LabelKind {
  facet,   ///< facets, and edges and vertices that only such facets have
  vertex,  ///< vertices, and the edges and facets that have any of them
};

/// A label of one body and a label of another, or of the same.
struct LabelPair {
  BodyId a;                           ///< a body
  std::uint32_t label_a = 0;          ///< a label of it, not 0
  BodyId b;                           ///< another body, or the same
  std::uint32_t label_b = 0;          ///< a label of that, not 0
  LabelKind kind = LabelKind::facet;  ///< what has the labels
};

/// The labels of a vertex, an edge or a facet; 0 where there is none.
struct FeatureLabels {
  std::array<std::uint32_t, 3> vertices{};  ///< those of its vertices, in their order
  std::uint32_t facet = 0;  ///< that of the facet, or of the first facet that has the vertex or the edge
  friend bool operator==(const FeatureLabels&, const FeatureLabels&) = default;
};

/// What World::add_plane() adds: a floor or a wall of any size. All x with normal * x <= offset is solid.
struct PlaneDefinition {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< out of what is solid, of length 1 to 1e-9; taken as it is
  double offset = 0.0;                                ///< how far the plane is from the origin along `normal`, metres
  std::string name = {};                              ///< for messages; by default "body <index>"
  std::uint32_t layer = 1;                            ///< the layers that the plane is on, a bit each
  std::uint32_t mask = 0xffffffffu;                   ///< the layers that it is tested against; a pair needs both masks
  std::uint32_t group = 0;                            ///< see BodyDefinition::group
  std::uint64_t external_id = 0;                      ///< the program's own number; no answer depends on it
  std::optional<std::uint64_t> key = {};              ///< see BodyDefinition::key
  double margin = 0.0;                                ///< see BodyDefinition::margin
  std::optional<double> rest_offset = {};             ///< see BodyDefinition::rest_offset
};

/// A half-space: all x with normal * x <= offset.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< out of what is solid
  double offset = 0.0;                                ///< metres
};

}  // namespace tact

/// For unordered containers.
template <>
struct std::hash<tact::BodyId> {
  std::size_t operator()(const tact::BodyId& id) const noexcept {
    const std::uint64_t slot = std::uint64_t{id.generation} << 32 | id.index;
    return std::hash<std::uint64_t>()(slot ^ std::uint64_t{id.world} << 17);
  }
};
