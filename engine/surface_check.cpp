#include "engine/surface_check.h"

#include <tact/world.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "engine/eigen_vectors.h"
#include "engine/first_at_position.h"

namespace tact {

namespace {

using base::Vec3;
using Facet = std::array<int, 3>;

// A facet's side: the smaller vertex first, and whether the facet runs from it to the larger.
struct Side {
  std::array<int, 2> edge;
  int facet;
  bool forward;
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sides_of(std::span<const Facet> facets) {
  std::vector<Side> sides;
  sides.reserve(3 * facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = facets[f][k], to = facets[f][(k + 1) % 3];
      if (from != to) sides.push_back({{std::min(from, to), std::max(from, to)}, static_cast<int>(f), from < to});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

// Calls see(sides of one edge) for each edge, in order.
template <class See>
void for_each_edge(std::span<const Side> sides, const See& see) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].edge == sides[begin].edge) ++end;
    see(sides.subspan(begin, end - begin));
  }
}

// Facets that are joined, and how each is turned against the one that stands for all (Tarjan, 1975).
class JoinedFacets {
 public:
  explicit JoinedFacets(std::size_t count) : parent_(count), turned_(count, false) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  // The facet that stands for all that are joined to `facet`: the least.
  int first(int facet) {
    bool turned = false;
    int root = facet;
    for (; parent_[at(root)] != root; root = parent_[at(root)]) turned ^= turned_[at(root)];
    while (parent_[at(facet)] != root) {
      const int next = parent_[at(facet)];
      const bool rest = turned ^ turned_[at(facet)];
      parent_[at(facet)] = root;
      turned_[at(facet)] = turned;
      turned = rest;
      facet = next;
    }
    return root;
  }
  bool is_turned(int facet) {
    first(facet);
    return turned_[at(facet)];
  }
  void join(int a, int b, bool turned) {
    int first_a = first(a), first_b = first(b);
    if (first_a == first_b) return;
    const bool between = turned ^ turned_[at(a)] ^ turned_[at(b)];
    if (first_b < first_a) std::swap(first_a, first_b);
    parent_[at(first_b)] = first_a;
    turned_[at(first_b)] = between;
  }

 private:
  static std::size_t at(int facet) { return static_cast<std::size_t>(facet); }
  std::vector<int> parent_;
  std::vector<bool> turned_;  // against the parent; of a facet that stands for others false
};

// Components, borders, branching edges and turned facets.
void find_components(std::span<const Facet> facets, SurfaceCheck& check) {
  const std::vector<Side> sides = sides_of(facets);
  JoinedFacets alike(facets.size()), joined(facets.size());  // by edges of two facets, and by any
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() == 1) check.border_edges.push_back(edge[0].edge);
    if (edge.size() > 2) check.branching_edges.push_back(edge[0].edge);
    if (edge.size() == 2) alike.join(edge[0].facet, edge[1].facet, edge[0].forward == edge[1].forward);
    for (const Side& side : edge) joined.join(edge[0].facet, side.facet, false);
  });
  const int count = static_cast<int>(facets.size());
  std::vector<int> surplus(facets.size(), 0);  // of those turned as the first one over the others
  for (int f = 0; f < count; ++f) surplus[static_cast<std::size_t>(alike.first(f))] += alike.is_turned(f) ? -1 : 1;
  for (int f = 0; f < count; ++f) {
    if (alike.is_turned(f) == (surplus[static_cast<std::size_t>(alike.first(f))] >= 0))
      check.turned_facets.push_back(f);
  }
  std::map<int, SurfaceComponent> components;
  for (int f = 0; f < count; ++f) {
    SurfaceComponent& one = components.try_emplace(joined.first(f), SurfaceComponent{f, 0, true, false}).first->second;
    ++one.facet_count;
  }
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() == 2 && edge[0].forward != edge[1].forward) return;
    components.at(joined.first(edge[0].facet)).closed = false;
  });
  for (const auto& [first, component] : components) check.components.push_back(component);
}

void find_repeated(std::span<const Vec3> positions, std::span<const Facet> facets, SurfaceCheck& check) {
  const double* const coordinates = positions.empty() ? nullptr : &positions.front().x;
  const std::vector<int> first = first_at_position({coordinates, 3 * positions.size()});
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] != static_cast<int>(v)) check.repeated_vertices.push_back({static_cast<int>(v), first[v]});
  }
  std::map<Facet, int> seen;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    Facet corners = facets[f];
    for (int& corner : corners) corner = first[static_cast<std::size_t>(corner)];
    std::ranges::sort(corners);
    const auto [at, is_new] = seen.try_emplace(corners, static_cast<int>(f));
    if (!is_new) check.repeated_facets.push_back({static_cast<int>(f), at->second});
  }
}

void find_slivers(std::span<const Vec3> positions, std::span<const Facet> facets, double sliver, SurfaceCheck& check) {
  for (std::size_t f = 0; f < facets.size(); ++f) {
    std::array<Vec3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = positions[static_cast<std::size_t>(facets[f][k])];
    const Vec3 sides[] = {corner[1] - corner[0], corner[2] - corner[1], corner[0] - corner[2]};
    double size = 0.0, longest = 0.0;
    for (const Vec3& side : sides) size = std::max({size, std::abs(side.x), std::abs(side.y), std::abs(side.z)});
    if (size == 0.0) {
      check.slivers.push_back(static_cast<int>(f));
      continue;
    }
    const Vec3 a = {sides[0].x / size, sides[0].y / size, sides[0].z / size},
               b = {sides[1].x / size, sides[1].y / size, sides[1].z / size}, c = a + b;
    longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
    if (norm(cross(a, b)) <= sliver * longest) check.slivers.push_back(static_cast<int>(f));
  }
}

// Whether closed components are inside out. In front of a facet and behind it, a little off its middle, exactly one is
// inside a solid; of a component inside out, that in front.
void find_inside_out(const World& world, std::span<const Vec3> positions, std::span<const Facet> facets,
                     SurfaceCheck& check) {
  std::vector<PointQuery> queries;
  double size = 0.0;
  for (const Vec3& p : positions) size = std::max(size, largest_coordinate(p));
  for (const SurfaceComponent& component : check.components) {
    const Facet& corners = facets[static_cast<std::size_t>(component.facet)];
    const auto corner = [&](std::size_t k) { return to_eigen(positions[static_cast<std::size_t>(corners[k])]); };
    const Eigen::Vector3d p = corner(0), a = corner(1) - p, b = corner(2) - p;
    const Eigen::Vector3d middle = p + (a + b) / 3.0, normal = a.stableNormalized().cross(b.stableNormalized());
    const double off = std::max(0x1p-20 * std::min(a.stableNorm(), b.stableNorm()), 0x1p-50 * size);
    for (const double side : {off, -off}) queries.push_back({.point = middle + side * normal.stableNormalized()});
  }
  std::vector<std::vector<BodyId>> answers(queries.size());
  world.bodies_containing_each(queries, answers);
  for (std::size_t i = 0; i < check.components.size(); ++i)
    check.components[i].inside_out =
        check.components[i].closed && !answers[2 * i].empty() && answers[2 * i + 1].empty();
}

}  // namespace

SurfaceCheck check_surface(std::span<const Vec3> positions, std::span<const Facet> facets, double sliver, int threads) {
  SurfaceCheck check;
  std::vector<int> number(positions.size(), -1), vertices;  // among those that are used
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (std::isnan(positions[v].x)) {
      check.unused_vertices.push_back(static_cast<int>(v));
      continue;
    }
    number[v] = static_cast<int>(vertices.size());
    vertices.push_back(static_cast<int>(v));
  }
  std::vector<Vec3> used;
  used.reserve(vertices.size());
  for (const int v : vertices) used.push_back(positions[static_cast<std::size_t>(v)]);
  std::vector<Facet> renumbered(facets.begin(), facets.end());
  for (Facet& facet : renumbered) {
    for (int& vertex : facet) vertex = number[static_cast<std::size_t>(vertex)];
  }
  find_components(renumbered, check);
  find_repeated(used, renumbered, check);
  find_slivers(used, renumbered, sliver, check);
  World world({.threads = threads});
  world.add_body(
      {.positions = Positions::strided(used.empty() ? nullptr : &used.front().x, used.size()),
       .facets = Facets::strided(renumbered.empty() ? nullptr : renumbered.front().data(), renumbered.size()),
       .self_contact = true});
  for (const Contact& contact : world.detect().contacts())
    check.crossings.assign(contact.facet_pairs().begin(), contact.facet_pairs().end());
  find_inside_out(world, used, renumbered, check);
  for (auto* const edges : {&check.border_edges, &check.branching_edges, &check.repeated_vertices}) {
    for (std::array<int, 2>& edge : *edges) {
      for (int& vertex : edge) vertex = vertices[static_cast<std::size_t>(vertex)];
    }
  }
  return check;
}

bool SurfaceCheck::is_solid() const {
  return !components.empty() &&
         std::ranges::all_of(components, [](const SurfaceComponent& one) { return one.closed && !one.inside_out; });
}

bool SurfaceCheck::is_clean() const {
  return branching_edges.empty() && turned_facets.empty() && crossings.empty() && repeated_facets.empty() &&
         repeated_vertices.empty() && slivers.empty() &&
         std::ranges::none_of(components, &SurfaceComponent::inside_out);
}

}  // namespace tact
