#include "engine/patches.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact {

namespace {

using base::Box;
using base::Vec3;
using narrowphase::Triangle;

// Sets of facet pairs, joined by shared facets. The root of a set is its lowest member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void join(int i, int j) {
    i = root(i), j = root(j);
    parent(std::max(i, j)) = std::min(i, j);
  }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<int> parent_;
};

Vec3 from_eigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d to_eigen(Vec3 v) { return {v.x, v.y, v.z}; }

Triangle triangle_of(const Body& body, int source_facet) {
  return body.mesh.triangle(body.mesh.facet_of_source(source_facet));
}

Box box_of(const Triangle& t) { return extended(extended(Box{t[0], t[0]}, t[1]), t[2]); }

double longest(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

// `scale` is a unit of length in which the area neither vanishes nor overflows.
Vec3 area_normal(const Body& body, int facet, Vec3 side, double scale) {
  const Triangle t = triangle_of(body, facet);
  const Vec3 n = cross(scale * (t[1] - t[0]), scale * (t[2] - t[0]));
  return body.surface == Surface::sheet && dot(n, side) < 0.0 ? -n : n;
}

// Above the origin, along n.
double highest(const Triangle& t, Vec3 n, Vec3 origin) {
  return std::max({dot(n, t[0] - origin), dot(n, t[1] - origin), dot(n, t[2] - origin)});
}

std::vector<std::vector<int>> connected(const std::vector<FacetPair>& pairs) {
  Sets sets(pairs.size());
  std::vector<int> by_b(pairs.size());
  std::iota(by_b.begin(), by_b.end(), 0);
  const auto b_of = [&](int i) { return pairs[static_cast<std::size_t>(i)].b; };
  std::sort(by_b.begin(), by_b.end(), [&](int i, int j) { return b_of(i) != b_of(j) ? b_of(i) < b_of(j) : i < j; });
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    if (pairs[i - 1].a == pairs[i].a) sets.join(static_cast<int>(i) - 1, static_cast<int>(i));
    if (b_of(by_b[i - 1]) == b_of(by_b[i])) sets.join(by_b[i - 1], by_b[i]);
  }
  std::vector<std::vector<int>> groups;
  std::vector<int> group_of(pairs.size(), -1);
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
    int& group = group_of[static_cast<std::size_t>(sets.root(i))];
    if (group < 0) {
      group = static_cast<int>(groups.size());
      groups.emplace_back();
    }
    groups[static_cast<std::size_t>(group)].push_back(i);
  }
  return groups;
}

Patch make_patch(const Body& a, const Body& b, const PairRecord& record, std::vector<int> members) {
  const Vec3 contact_direction = from_eigen(record.contact.direction);
  Vec3 normal, center;
  const auto pair = [&](int i) { return record.facet_pairs[static_cast<std::size_t>(i)]; };
  double largest = 0.0;
  for (const int i : members)
    largest =
        std::max({largest, longest(box_of(triangle_of(a, pair(i).a))), longest(box_of(triangle_of(b, pair(i).b)))});
  const double scale = narrowphase::unit_scale(largest);
  for (const int i : members) {
    normal = normal + (area_normal(a, pair(i).a, contact_direction, scale) -
                       area_normal(b, pair(i).b, -contact_direction, scale));
    const Box common = intersection(box_of(triangle_of(a, pair(i).a)), box_of(triangle_of(b, pair(i).b)));
    center = center + (0.5 * common.lower + 0.5 * common.upper);
  }
  const Vec3 point = (1.0 / static_cast<double>(members.size())) * center;
  const Vec3 n = normal != Vec3{} ? narrowphase::unit_vector(normal) : contact_direction;
  double depth = -std::numeric_limits<double>::infinity();
  for (const int i : members) {
    const double reach = highest(triangle_of(a, pair(i).a), n, point) + highest(triangle_of(b, pair(i).b), -n, point);
    depth = std::max(depth, reach);
  }
  Patch patch;
  patch.point = to_eigen(point);
  patch.direction = to_eigen(n);
  patch.depth = std::max(0.0, depth);
  patch.facet_pairs = std::move(members);
  return patch;
}

}  // namespace

std::vector<Patch> find_patches(const Body& a, const Body& b, const PairRecord& record) {
  std::vector<Patch> patches;
  for (std::vector<int>& members : connected(record.facet_pairs)) {
    patches.push_back(make_patch(a, b, record, std::move(members)));
  }
  return patches;
}

}  // namespace tact
