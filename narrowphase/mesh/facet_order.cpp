#include "narrowphase/mesh/facet_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/base/box.h"

namespace tact::narrowphase {

namespace {

using base::Box;
using base::Vec3;

constexpr std::size_t kLaneGroup = 8;       // facets inside a cluster are ordered in groups of so many neighbours
constexpr std::size_t kFewFacets = 16;      // a mesh of so few keeps their order: pairs of them are found sorted
constexpr std::size_t kMostRefined = 4096;  // facets whose cut is improved: the last cuts share nearly all vertices
constexpr double kLongEnough = 0.5;         // of the longest axis: another that is cut across

// Facets order[begin] to order[end - 1], the first half of which ends at `middle`.
struct Cut {
  std::size_t begin, middle, end;
};

class FacetOrder {
 public:
  FacetOrder(std::span<const double> positions, std::span<const int> facets, int vertex_count)
      : facets_(facets),
        centers_(facets.size() / 3),
        order_(centers_.size()),
        uses_(centers_.size() > kClusterSize ? static_cast<std::size_t>(vertex_count) : 0) {
    for (std::size_t f = 0; f < centers_.size(); ++f) {
      Box box;
      for (const int v : corners(static_cast<int>(f))) {
        const double* p = positions.data() + 3 * static_cast<std::size_t>(v);
        const Vec3 corner{p[0], p[1], p[2]};
        centers_[f] = centers_[f] + corner;
        box = extended(box, corner);
      }
      facet_lengths_ = facet_lengths_ + (box.upper - box.lower);
    }
    if (facet_lengths_ == Vec3{}) facet_lengths_ = {1.0, 1.0, 1.0};  // points: lengths count as they are
    std::iota(order_.begin(), order_.end(), 0);
  }

  std::vector<int> take() {
    sort(0, order_.size());
    return std::move(order_);
  }

 private:
  void sort(std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    if (count <= kLaneGroup || centers_.size() <= kFewFacets) return std::sort(place(begin), place(end));
    const std::size_t unit = count > kClusterSize ? kClusterSize : kLaneGroup;
    const std::size_t units = (count + unit - 1) / unit;
    const Cut cut{begin, begin + (units + 1) / 2 * unit, end};
    if (count > kClusterSize && count <= kMostRefined) {
      halve_sharing_few(cut);
    } else {
      halve(cut, axes_of(cut).axis[0]);
    }
    sort(begin, cut.middle);
    sort(cut.middle, end);
  }

  std::span<const int, 3> corners(int facet) const {
    return facets_.subspan(3 * static_cast<std::size_t>(facet)).first<3>();
  }
  int* place(std::size_t i) { return order_.data() + i; }

  // Axes by the length of the box, in facets, longest first, and how many of them are long enough to be cut across.
  struct Axes {
    std::array<int, 3> axis{0, 1, 2};
    std::size_t long_ones = 1;
  };
  Axes axes_of(const Cut& cut) const {
    Box box;
    for (std::size_t i = cut.begin; i < cut.end; ++i) box = extended(box, centers_[order_[i]]);
    const auto length = [&](int axis) {
      const double size = box.upper[axis] - box.lower[axis];
      return size > 0.0 && facet_lengths_[axis] > 0.0 ? size / facet_lengths_[axis] : 0.0;
    };
    Axes axes;
    std::ranges::sort(axes.axis, [&](int a, int b) { return std::pair(-length(a), a) < std::pair(-length(b), b); });
    while (axes.long_ones < 3 && length(axes.axis[axes.long_ones]) >= kLongEnough * length(axes.axis[0]))
      ++axes.long_ones;
    return axes;
  }

  // Ties break by facet number.
  void halve(const Cut& cut, int axis) {
    std::nth_element(place(cut.begin), place(cut.middle), place(cut.end), [&](int a, int b) {
      const double x = centers_[a][axis], y = centers_[b][axis];
      return x < y || (x == y && a < b);
    });
  }

  void halve_sharing_few(const Cut& cut) {
    const Axes axes = axes_of(cut);
    int fewest = -1, best_axis = -1, last_axis = -1;
    for (std::size_t k = 0; k < axes.long_ones; ++k) {
      last_axis = axes.axis[k];
      halve(cut, last_axis);
      const int shared = count_uses(cut);
      if (fewest >= 0 && shared >= fewest) continue;
      fewest = shared;
      best_axis = last_axis;
      best_.assign(place(cut.begin), place(cut.end));
    }
    if (best_axis != last_axis) {
      std::ranges::copy(best_, place(cut.begin));
      count_uses(cut);
    }
    exchange(cut);
  }

  // Counts how many facets of each half use a vertex; returns how many vertices both use.
  int count_uses(const Cut& cut) {
    for (std::size_t i = cut.begin; i < cut.end; ++i) {
      for (const int v : corners(order_[i])) uses_[v] = {0, 0};
    }
    int shared = 0;
    for (std::size_t i = cut.begin; i < cut.end; ++i) {
      const std::size_t half = i < cut.middle ? 0 : 1;
      for (const int v : corners(order_[i])) {
        auto& uses = uses_[v];
        if (uses[half]++ == 0 && half == 1 && uses[0] > 0) ++shared;
      }
    }
    return shared;
  }

  // How many fewer vertices are shared if a facet leaves its half; nothing for one that has no neighbour in the other.
  std::optional<int> gain(int facet, std::size_t half) const {
    int shared = 0, lone = 0;
    for (const int v : corners(facet)) {
      const auto& uses = uses_[v];
      shared += uses[1 - half] > 0 ? 1 : 0;
      lone += uses[half] > 1 ? 0 : 1;
    }
    if (shared == 0) return std::nullopt;
    return shared - 3 + lone;
  }
  void leave(int facet, std::size_t half) {
    for (const int v : corners(facet)) {
      auto& uses = uses_[v];
      --uses[half];
      ++uses[1 - half];
    }
  }
  // The facet that gains most by leaving its half, of several that with the lowest number.
  struct Leaving {
    std::size_t place;
    int gain;
  };
  std::optional<Leaving> most_gaining(std::size_t begin, std::size_t end, std::size_t half) const {
    std::optional<Leaving> best;
    for (std::size_t i = begin; i < end; ++i) {
      const std::optional<int> gained = gain(order_[i], half);
      if (!gained || (best && *gained < best->gain)) continue;
      if (best && *gained == best->gain && order_[i] > order_[best->place]) continue;
      best = {i, *gained};
    }
    return best;
  }

  // As many exchanges as facets lie along a straight cut are enough.
  void exchange(const Cut& cut) {
    const auto most = static_cast<int>(std::sqrt(static_cast<double>(cut.end - cut.begin)));
    for (int i = 0; i < most; ++i) {
      const std::optional<Leaving> a = most_gaining(cut.begin, cut.middle, 0);
      if (!a) return;
      leave(order_[a->place], 0);
      const std::optional<Leaving> b = most_gaining(cut.middle, cut.end, 1);
      if (!b || a->gain + b->gain <= 0) return;
      leave(order_[b->place], 1);
      std::swap(order_[a->place], order_[b->place]);
    }
  }

  std::span<const int> facets_;
  std::vector<Vec3> centers_;  // times three
  Vec3 facet_lengths_;         // the sums of the lengths of all facets along each axis
  std::vector<int> order_;
  std::vector<int> best_;  // of the facets that are being halved: the order tried that shares fewest
  std::vector<std::array<std::int32_t, 2>> uses_;  // of each vertex: facets of either half
};

}  // namespace

std::vector<int> facet_order(std::span<const double> positions, std::span<const int> facets, int vertex_count) {
  return FacetOrder(positions, facets, vertex_count).take();
}

}  // namespace tact::narrowphase
