// Shorter ways to an answer that can be left out, or taken whatever the size.
#pragma once

#include <cstdlib>
#include <string_view>

namespace tact::base {

// The order of the broad phase, clusters in support queries, what the last step knew of a pair but its direction,
// diagonals and planes that part hulls, planes of facets, arithmetic on many facets at once, trees, ranges of large
// pairs, small meshes next to each other, facets grouped anew. None changes which facets meet. (Others are always
// taken: the criteria themselves, and that pairs at rest keep their results, which is promised to the last bit.)
enum class FastPaths {
  automatic,  // where they pay
  off,        // none of these
  always      // also those that have a border, whatever the size
};

// What the environment variable TACT_FAST_PATHS says when it is first asked for, off or always; for tests.
inline FastPaths fast_paths() {
  static const FastPaths wanted = [] {
    const char* value = std::getenv("TACT_FAST_PATHS");
    const std::string_view name = value == nullptr ? "" : value;
    return name == "off" ? FastPaths::off : name == "always" ? FastPaths::always : FastPaths::automatic;
  }();
  return wanted;
}

}  // namespace tact::base
