// Puts what was found between features in the order of its kind and features, in whichever order it was found.
#pragma once

#include <tact/reach_pair.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "engine/base/key_sort.h"
#include "engine/base/parallel.h"
#include "narrowphase/contact_points/feature_point.h"

namespace tact {

inline auto features_of(const narrowphase::FeaturePoint& point) { return point.features(); }
inline auto features_of(const ReachPair& pair) { return std::tie(pair.kind, pair.a_vertices, pair.b_vertices); }

/// Where one stands by its kind and first vertex, then by where it was found: what tells most apart, in one word.
class FeatureKeys {
 public:
  FeatureKeys(int vertices, std::size_t count)
      : vertex_bits_(std::bit_width(static_cast<unsigned>(vertices))), place_bits_(std::bit_width(count)) {}

  template <class Found>
  std::uint64_t key(const Found& one, std::size_t place) const {
    const auto& [kind, a, b] = features_of(one);
    const auto first = static_cast<std::uint64_t>(a[0] >= 0 ? a[0] : b[0]);  // a plane has none
    return ((static_cast<std::uint64_t>(kind) << vertex_bits_ | first) << place_bits_) | place;
  }
  std::size_t place(std::uint64_t key) const { return key & ((std::uint64_t{1} << place_bits_) - 1); }
  bool same_first(std::uint64_t one, std::uint64_t other) const { return one >> place_bits_ == other >> place_bits_; }
  int bits() const { return kKindBits + vertex_bits_ + place_bits_; }

 private:
  static constexpr int kKindBits = 3;
  int vertex_bits_, place_bits_;
};

/// Memory of the order, used again.
struct FeatureOrder {
  base::KeySorter sorter;
  std::vector<std::size_t> blocks;  // where they begin, and where the last one ends

  /// The keys of `found`, sorted: valid until the next call.
  template <class Found>
  std::span<std::uint64_t> sort(const std::vector<Found>& found, const FeatureKeys& keys, int threads) {
    constexpr std::size_t kFew = 256;  // up to so many a comparison sorts faster than digits do
    const std::span<std::uint64_t> order = sorter.keys(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) order[i] = keys.key(found[i], i);
    if (found.size() > kFew) return sorter.sort(keys.bits(), threads);
    std::ranges::sort(order);
    return order;
  }
  /// Into blocks of about `size`, between two that differ in kind or first vertex.
  void cut(std::span<const std::uint64_t> order, const FeatureKeys& keys, std::size_t size) {
    blocks.assign(1, 0);
    for (std::size_t at = 0; at < order.size(); blocks.push_back(at)) {
      at = std::min(at + size, order.size());
      while (at < order.size() && keys.same_first(order[at - 1], order[at])) ++at;
    }
  }
};

/// Sorts keys by features where the kind and the first vertex are the same.
template <class Found>
void sort_by_the_rest(std::span<std::uint64_t> order, const FeatureKeys& keys, const std::vector<Found>& found) {
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && keys.same_first(order[begin], order[end])) ++end;
    if (end - begin > 1) {
      const auto all_of = [&](std::uint64_t key) {
        return std::tuple_cat(features_of(found[keys.place(key)]), std::tuple(key));
      };
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.begin() + static_cast<std::ptrdiff_t>(end),
                [&](std::uint64_t one, std::uint64_t other) { return all_of(one) < all_of(other); });
    }
  }
}

/// Replaces `to` by make(one) of all that was found, in order; a thread makes `at_a_time` of them. `vertices` is how
/// many the first body has that is no plane.
template <class Found, class To, class Make>
void put_in_order(const std::vector<Found>& found, int vertices, std::size_t at_a_time, int threads,
                  FeatureOrder& memory, std::vector<To>& to, const Make& make) {
  const FeatureKeys keys(vertices, found.size());
  const std::span<std::uint64_t> order = memory.sort(found, keys, threads);
  if (to.capacity() < found.size()) to.reserve(found.size() + found.size() / 4);
  to.resize(found.size());
  memory.cut(order, keys, at_a_time);
  base::parallel_for(memory.blocks.size() - 1, 1, threads, [&](std::size_t block) {
    const std::size_t begin = memory.blocks[block], end = memory.blocks[block + 1];
    sort_by_the_rest(order.subspan(begin, end - begin), keys, found);
    for (std::size_t i = begin; i < end; ++i) to[i] = make(found[keys.place(order[i])]);
  });
}

}  // namespace tact
