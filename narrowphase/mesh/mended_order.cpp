#include "narrowphase/mesh/mended_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <utility>

#include "engine/base/hash.h"

namespace tact::narrowphase {

namespace {

constexpr int kNone = -1;
// Where less than this part of the facets has a place, most clusters are new ones: two halvings of facet_order().
constexpr std::size_t kLeastKept = 2;  // one of so many

Corners sorted(Corners corners) {
  std::ranges::sort(corners);
  return corners;
}

Corners corners_of(std::span<const int> facets, int facet) {
  const int* const first = &facets[3 * static_cast<std::size_t>(facet)];
  return {first[0], first[1], first[2]};
}

// Facets by their vertices, whatever the order of these.
class FacetTable {
 public:
  // Of the new facets those that are not known yet.
  FacetTable(std::span<const int> facets, std::span<const char> known)
      : facets_(facets), next_(known.size(), kNone), heads_(std::bit_ceil(known.size() + 1), kNone) {
    for (auto f = static_cast<int>(known.size()); f-- > 0;) {
      if (known[f] != 0) continue;
      int& head = heads_[slot_of(sorted(corners_of(facets, f)))];
      next_[f] = std::exchange(head, f);
    }
  }

  // The first facet with these vertices, which is taken out; kNone if there is none.
  int take(const Corners& vertices) {
    const Corners wanted = sorted(vertices);
    for (int* at = &heads_[slot_of(wanted)]; *at != kNone; at = &next_[*at]) {
      const int facet = *at;
      if (sorted(corners_of(facets_, facet)) != wanted) continue;
      *at = next_[facet];
      return facet;
    }
    return kNone;
  }

 private:
  std::size_t slot_of(const Corners& vertices) const {
    const auto word = [&](std::size_t k) {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(vertices[k]));
    };
    return base::mixed(base::mixed(word(0) << 32 | word(1)) + word(2)) & (heads_.size() - 1);
  }

  std::span<const int> facets_;
  std::vector<int> next_, heads_;
};

// Where facets go that have no place yet: into the cluster that owns one of their vertices, as long as a facet of it is
// gone.
class Places {
 public:
  Places(const ClusteredMesh& mesh, const ChangedMesh& now, std::vector<int> order)
      : mesh_(mesh), now_(now), order_(std::move(order)), vertex_of_source_(mesh.source_vertex_count(), kNone) {
    for (int v = 0; v < mesh.vertex_count(); ++v) vertex_of_source_[mesh.source_vertex(v)] = v;
    for (int c = 0; c < mesh.cluster_count(); ++c) vertex_ends_.push_back(mesh.vertex_end(c));
  }

  void add(int facet) {
    int home = mesh_.cluster_count() - 1;
    for (const int v : corners_of(now_.facets, facet)) {
      const int was = now_.vertex_was[v], vertex = was == kNone ? kNone : vertex_of_source_[was];
      if (vertex == kNone) continue;
      home = static_cast<int>(std::ranges::upper_bound(vertex_ends_, vertex) - vertex_ends_.begin());
      for (int f = mesh_.facet_begin(home); f < mesh_.facet_end(home); ++f) {
        if (order_[f] == kNone) return void(order_[f] = facet);
      }
    }
    last_.emplace_back(home, facet);
  }

  // Facets without a place take those of facets that are gone from the nearest clusters: to close up would move the
  // borders of all clusters behind. Of 100,000 facets cut in a sheet 26 had none, and closing up made boxes three times
  // as large.
  std::vector<int> take() {
    std::ranges::sort(last_);
    std::set<int> free;
    for (int f = 0; f < static_cast<int>(order_.size()); ++f) {
      if (order_[f] == kNone) free.insert(free.end(), f);
    }
    for (const auto& [home, facet] : last_) {
      if (free.empty()) {
        order_.push_back(facet);
        continue;
      }
      const int begin = mesh_.facet_begin(home);
      auto nearest = free.lower_bound(begin);
      if (nearest == free.end() || (nearest != free.begin() && begin - *std::prev(nearest) < *nearest - begin))
        --nearest;
      order_[*nearest] = facet;
      free.erase(nearest);
    }
    std::erase(order_, kNone);
    return std::move(order_);
  }
  std::size_t without_place() const { return last_.size(); }

 private:
  const ClusteredMesh& mesh_;
  const ChangedMesh& now_;
  std::vector<int> order_;
  std::vector<int> vertex_of_source_, vertex_ends_;
  std::vector<std::pair<int, int>> last_;  // a cluster and a facet
};

// Whether the new facet with the number that a facet had has a vertex of it.
bool is_beside(const ClusteredMesh& mesh, int facet, const ChangedMesh& now) {
  const Corners corners = mesh.corners(facet);
  return std::ranges::any_of(corners_of(now.facets, mesh.source_facet(facet)), [&](int v) {
    return std::ranges::any_of(corners, [&](int c) { return mesh.source_vertex(c) == now.vertex_was[v]; });
  });
}

}  // namespace

FacetsNow facets_now(const ClusteredMesh& mesh, const ChangedMesh& now) {
  const auto count = static_cast<int>(now.facets.size() / 3);
  FacetsNow result{.number = std::vector<int>(static_cast<std::size_t>(mesh.facet_count()), kNone),
                   .turned = {},
                   .known = std::vector<char>(static_cast<std::size_t>(count), 0)};
  std::vector<std::pair<int, Corners>> moved;  // facets whose vertices are there, but not under the same number
  std::array<int, 3 * kClusterSize> vertices{};
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    const ClusterFacets cluster = mesh.facets_of(c);
    for (int i = 0; i < cluster.owned_count + cluster.borrowed_count; ++i) {
      const int vertex = i < cluster.owned_count ? cluster.owned_begin + i : cluster.borrowed[i - cluster.owned_count];
      vertices[i] = now.vertex_now[mesh.source_vertex(vertex)];
    }
    for (int i = 0; i < cluster.facet_count; ++i) {
      const int f = cluster.facet_begin + i, source = mesh.source_facet(f);
      Corners corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = vertices[cluster.corner[k][i]];
      if (std::ranges::min(corners) == kNone) continue;
      if (source < count && corners_of(now.facets, source) == corners) {
        result.number[f] = source;
        result.known[source] = 1;
      } else {
        moved.emplace_back(f, corners);
      }
    }
  }
  if (moved.empty()) return result;
  FacetTable table(now.facets, result.known);
  for (const auto& [f, corners] : moved) {
    const int facet = table.take(corners);
    if (facet == kNone) continue;
    result.number[f] = facet;
    result.known[facet] = 1;
    if (corners_of(now.facets, facet) != corners) result.turned.push_back(f);
  }
  return result;
}

std::vector<int> mended_order(const ClusteredMesh& mesh, const ChangedMesh& now, const FacetsNow& facets) {
  const std::size_t count = facets.known.size();
  if (mesh.facet_count() == 0) return {};
  std::vector<int> order = facets.number;
  std::vector<char> placed = facets.known;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const auto source = static_cast<std::size_t>(mesh.source_facet(f));
    if (order[f] != kNone || source >= count || placed[source] != 0 || !is_beside(mesh, f, now)) continue;
    placed[source] = 1;
    order[f] = static_cast<int>(source);
  }
  Places places(mesh, now, std::move(order));
  for (std::size_t facet = 0; facet < count; ++facet) {
    if (placed[facet] == 0) places.add(static_cast<int>(facet));
  }
  const auto known = static_cast<std::size_t>(std::ranges::count(facets.known, 1));
  if (kLeastKept * known < count || kLeastKept * places.without_place() > count) return {};
  return places.take();
}

}  // namespace tact::narrowphase
