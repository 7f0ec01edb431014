#include "engine/bodies/self_filter.h"

#include <tact/error.h>

#include <algorithm>
#include <utility>

#include "engine/base/text.h"
#include "engine/bodies/checks.h"
#include "engine/bodies/columns.h"

namespace tact {

namespace {

// Around a vertex of a regular mesh lie 3 n (n + 1) in n rings: 816 in 16, of four bytes each.
constexpr int kMostRings = 16;

std::vector<double> rest_of(const Positions& given, std::vector<double> now, const std::string& name) {
  check_array(given, name);
  if (given.cols() == 0) return now;
  const std::size_t vertices = now.size() / 3;
  if (given.cols() != static_cast<std::ptrdiff_t>(vertices))
    throw Error(ErrorCode::wrong_size, quoted(name) + ": there are " + std::to_string(given.cols()) +
                                           " positions at rest, but " + std::to_string(vertices) + " vertices");
  const std::span<const double> rest = packed(given, std::span(now));
  if (rest.data() != now.data()) std::ranges::copy(rest, now.begin());
  check_positions(now.data(), vertices, name);
  return now;
}

}  // namespace

SelfContactFilter SelfFilter::view() const {
  return {.rings = rings,
          .rest_distance = rest_distance,
          .rest_positions = Positions::strided(rest_positions.data(), rest_positions.size() / 3)};
}

void check_self_filter(int rings, double rest_distance, const std::string& name) {
  if (rings < 0 || rings > kMostRings)
    throw Error(ErrorCode::invalid_argument, quoted(name) + ": there are " + std::to_string(rings) +
                                                 " rings, not 0 to " + std::to_string(kMostRings));
  if (!(rest_distance >= 0.0 && rest_distance <= kLargestCoordinate))
    throw Error(ErrorCode::invalid_argument,
                quoted(name) + ": the distance at rest is " + base::text_of(rest_distance) + ", not 0 to 2^300");
}

std::unique_ptr<SelfFilter> made_of(const SelfContactFilter& given, std::vector<double> now, const std::string& name) {
  check_self_filter(given.rings, given.rest_distance, name);
  std::vector<double> rest = rest_of(given.rest_positions, std::move(now), name);
  if (given.rings == 0 && given.rest_distance == 0.0) return nullptr;
  auto made = std::make_unique<SelfFilter>();
  made->rings = given.rings;
  made->rest_distance = given.rest_distance;
  if (given.rest_distance > 0.0) made->rest_positions = std::move(rest);
  return made;
}

std::unique_ptr<SelfFilter> carried(const SelfFilter* last, std::span<const int> vertex_map,
                                    std::span<const double> positions) {
  if (last == nullptr) return nullptr;
  auto made = std::make_unique<SelfFilter>();
  made->rings = last->rings;
  made->rest_distance = last->rest_distance;
  if (last->rest_distance == 0.0) return made;
  made->rest_positions.assign(positions.begin(), positions.end());
  for (std::size_t v = 0; v < vertex_map.size(); ++v) {
    if (vertex_map[v] < 0) continue;
    std::copy_n(&last->rest_positions[3 * static_cast<std::size_t>(vertex_map[v])], 3, &made->rest_positions[3 * v]);
  }
  return made;
}

bool are_same(const SelfFilter* x, const SelfFilter* y) {
  if (x == nullptr || y == nullptr) return x == y;
  return x->rings == y->rings && x->rest_distance == y->rest_distance && x->rest_positions == y->rest_positions;
}

void find_neighbors(SelfFilter& filter, const narrowphase::FeaturedMesh& mesh) {
  filter.neighbors = std::make_unique<const narrowphase::ExcludedNeighbors>(mesh, filter.rings, filter.rest_distance,
                                                                            filter.rest_positions);
}

}  // namespace tact
