// A body: a triangle mesh with an identity.
#pragma once

#include <tact/columns.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
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

/// What World::add_body() adds. Positions and facets have no default.
struct BodyDefinition {
  Positions positions;  ///< 3 x V, metres; the rest shape of a rigid body
  /// 3 x F, indices of vertices. Any triangle soup is accepted, also one of no facet. A vertex that no facet uses
  /// touches nothing.
  Facets facets;
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
