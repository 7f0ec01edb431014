#include "narrowphase/facet_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "engine/base/box.h"

namespace tact::narrowphase {

namespace {

using base::Box;
using base::Vec3;

constexpr std::size_t kLaneGroup = 8;       // facets inside a cluster are ordered in groups of so many neighbours
constexpr std::size_t kMostRefined = 4096;  // facets whose cut is improved: the last cuts share nearly all vertices

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
        uses_(static_cast<std::size_t>(vertex_count)) {
    for (std::size_t f = 0; f < centers_.size(); ++f) {
      for (const int v : corners(static_cast<int>(f))) {
        const double* p = positions.data() + 3 * static_cast<std::size_t>(v);
        centers_[f] = centers_[f] + Vec3{p[0], p[1], p[2]};
      }
    }
    std::iota(order_.begin(), order_.end(), 0);
  }

  std::vector<int> take() {
    sort(0, order_.size());
    return std::move(order_);
  }

 private:
  void sort(std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    if (count <= kLaneGroup) return;
    const std::size_t unit = count > kClusterSize ? kClusterSize : kLaneGroup;
    const std::size_t units = (count + unit - 1) / unit;
    const Cut cut{begin, begin + (units + 1) / 2 * unit, end};
    if (cut.middle >= end) return;
    if (count > kClusterSize && count <= kMostRefined) {
      halve_sharing_few(cut);
    } else {
      halve(cut, axes_by_length(cut)[0]);
    }
    sort(begin, cut.middle);
    sort(cut.middle, end);
  }

  std::span<const int, 3> corners(int facet) const {
    return facets_.subspan(3 * static_cast<std::size_t>(facet)).first<3>();
  }
  int* place(std::size_t i) { return order_.data() + i; }

  std::array<int, 3> axes_by_length(const Cut& cut) const {
    Box box;
    for (std::size_t i = cut.begin; i < cut.end; ++i)
      box = extended(box, centers_[static_cast<std::size_t>(order_[i])]);
    const Vec3 size = box.upper - box.lower;
    std::array<int, 3> axes{0, 1, 2};
    std::ranges::stable_sort(axes, [&](int a, int b) { return size[a] > size[b]; });
    return axes;
  }

  // Ties break by facet number.
  void halve(const Cut& cut, int axis) {
    std::nth_element(place(cut.begin), place(cut.middle), place(cut.end), [&](int a, int b) {
      const double x = centers_[static_cast<std::size_t>(a)][axis], y = centers_[static_cast<std::size_t>(b)][axis];
      return x < y || (x == y && a < b);
    });
  }

  void halve_sharing_few(const Cut& cut) {
    const std::array<int, 3> axes = axes_by_length(cut);
    int fewest = -1, best_axis = axes[0];
    for (const int axis : axes) {
      halve(cut, axis);
      const int shared = count_uses(cut);
      if (fewest >= 0 && shared >= fewest) continue;
      fewest = shared;
      best_axis = axis;
      best_.assign(place(cut.begin), place(cut.end));
    }
    std::ranges::copy(best_, place(cut.begin));
    if (best_axis != axes[2]) count_uses(cut);
    exchange(cut);
  }

  // Counts how many facets of each half use a vertex; returns how many vertices both use.
  int count_uses(const Cut& cut) {
    for (std::size_t i = cut.begin; i < cut.end; ++i) {
      for (const int v : corners(order_[i])) uses_[static_cast<std::size_t>(v)] = {0, 0};
    }
    int shared = 0;
    for (std::size_t i = cut.begin; i < cut.end; ++i) {
      const std::size_t half = i < cut.middle ? 0 : 1;
      for (const int v : corners(order_[i])) {
        auto& uses = uses_[static_cast<std::size_t>(v)];
        if (uses[half]++ == 0 && half == 1 && uses[0] > 0) ++shared;
      }
    }
    return shared;
  }

  // How many fewer vertices are shared if a facet leaves its half.
  int gain(int facet, std::size_t half) const {
    int gained = 0;
    for (const int v : corners(facet)) {
      const auto& uses = uses_[static_cast<std::size_t>(v)];
      gained += (uses[1 - half] > 0 ? 1 : 0) - (uses[half] > 1 ? 1 : 0);
    }
    return gained;
  }
  void leave(int facet, std::size_t half) {
    for (const int v : corners(facet)) {
      auto& uses = uses_[static_cast<std::size_t>(v)];
      --uses[half];
      ++uses[1 - half];
    }
  }
  struct Leaving {
    std::size_t place;
    int gain;
  };
  Leaving most_gaining(std::size_t begin, std::size_t end, std::size_t half) const {
    Leaving best{begin, gain(order_[begin], half)};
    for (std::size_t i = begin + 1; i < end; ++i) {
      const int gained = gain(order_[i], half);
      if (gained > best.gain) best = {i, gained};
    }
    return best;
  }

  // As many exchanges as facets lie along a straight cut are enough.
  void exchange(const Cut& cut) {
    const auto most = static_cast<int>(std::sqrt(static_cast<double>(cut.end - cut.begin)));
    for (int i = 0; i < most; ++i) {
      const Leaving a = most_gaining(cut.begin, cut.middle, 0);
      leave(order_[a.place], 0);
      const Leaving b = most_gaining(cut.middle, cut.end, 1);
      if (a.gain + b.gain <= 0) return;
      leave(order_[b.place], 1);
      std::swap(order_[a.place], order_[b.place]);
    }
  }

  std::span<const int> facets_;
  std::vector<Vec3> centers_;  // times three
  std::vector<int> order_;
  std::vector<int> best_;  // of the facets that are being halved: the order tried that shares fewest
  std::vector<std::array<std::int32_t, 2>> uses_;  // of each vertex: facets of either half
};

}  // namespace

std::vector<int> facet_order(std::span<const double> positions, std::span<const int> facets, int vertex_count) {
  return FacetOrder(positions, facets, vertex_count).take();
}

}  // namespace tact::narrowphase
