// A body: a triangle mesh with an identity.
#pragma once

#include <tact/columns.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace tact {

/// Names a body of one world. An id is never given out twice: the id of a removed body stays stale for ever.
struct BodyId {
  std::uint32_t index = 0;       ///< bodies of a report are ordered by it
  std::uint32_t generation = 0;  ///< 0: no body
  std::uint32_t world = 0;       ///< the world that gave it out
  friend constexpr auto operator<=>(const BodyId&, const BodyId&) = default;
};

/// What the facets of a body are.
enum class Surface {
  closed,  ///< a solid's surface, facets counter-clockwise seen from outside
  sheet,   ///< cloth: no inside, both sides count
};

/// Does a body move?
enum class Motion {
  deformable,  ///< its positions can be set
  fixed,   ///< its positions cannot be set; two fixed bodies are never tested against each other
  rigid,   ///< it keeps its shape: World::set_pose() turns and moves it, positions cannot be set
};

/// The largest size of a coordinate, 2^300 metres. Anything smaller, subnormal numbers included, is decided exactly.
inline constexpr double kLargestCoordinate = 0x1p300;

/// How to add a body. Only positions and facets are needed.
struct BodyDefinition {
  Positions positions;  ///< 3 x V, metres; of a rigid body its rest shape, where it stands at first
  /// 3 x F, indices of vertices. Any triangle soup is accepted: repeated vertices, facets without area, no facet at
  /// all. A vertex that no facet uses touches nothing; it must be finite and in range as all are.
  Facets facets;
  Surface surface = Surface::closed;
  Motion motion = Motion::deformable;
  std::string name = {};             ///< for messages; empty: "body <index>"
  std::uint32_t layer = 1;           ///< the layers this body is on, a bit each
  std::uint32_t mask = 0xffffffffu;  ///< the layers it is tested against; a pair needs both masks to agree
  /// Bodies of one group are not tested against each other: the parts of a machine, say. 0: in no group.
  std::uint32_t group = 0;
  std::uint64_t external_id = 0;  ///< the program's own, see World::external_id(); nothing depends on it
  /// Half a thickness, metres, 0 to kLargestCoordinate: surfaces closer than the sum of two margins are in contact.
  /// It is how far ahead contact points are seen, too: what moves farther than that sum from one detect() to the next
  /// may cross before it has a point. A solver may take a larger margin than its thickness and keep surfaces at the
  /// smaller distance, by ContactPoint::gap; World::detect_motion() finds what crosses at any speed.
  double margin = 0.0;
  bool self_contact = false;  ///< is the body held against itself, too? See Contact
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
