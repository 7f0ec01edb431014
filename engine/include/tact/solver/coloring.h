// Stencils in groups within which no two move the same vertex, for solvers that run in parallel.
#pragma once

#include <tact/solver/stencil.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace tact::solver {

/// Stencils by colour: those of one colour may be solved at once. It depends on the stencils alone.
struct Coloring {
  std::vector<int> order;  ///< numbers of stencils, colour after colour, ascending within a colour
  std::vector<int> begin;  ///< where each colour begins in `order`, and the end

  /// Returns the number of colours.
  int count() const { return static_cast<int>(begin.size()) - 1; }
  /// Returns the stencils of a colour.
  std::span<const int> of(int color) const {
    const auto first = static_cast<std::size_t>(begin[static_cast<std::size_t>(color)]);
    return std::span(order).subspan(first,
                                    static_cast<std::size_t>(begin[static_cast<std::size_t>(color) + 1]) - first);
  }
};

/// Gives each stencil, in order, the first colour that no earlier one with a common vertex has. Vertices from `moving`
/// on are common to any number of a colour.
inline Coloring color(std::span<const Stencil> stencils, int moving) {
  std::vector<int> color_of(stencils.size(), -1), left(stencils.size());
  std::iota(left.begin(), left.end(), 0);
  int count = 0, last = -1;
  for (const Stencil& stencil : stencils) last = std::max(last, *std::ranges::max_element(stencil.vertices));
  moving = std::min(moving, last + 1);
  // 64 colours a round: a stencil that finds none of them free waits for the next.
  for (int base = 0; !left.empty(); base += 64) {
    std::vector<std::uint64_t> taken(static_cast<std::size_t>(moving), 0);
    std::vector<int> waiting;
    for (const int s : left) {
      const Stencil& stencil = stencils[static_cast<std::size_t>(s)];
      const auto vertices = std::span(stencil.vertices).first(static_cast<std::size_t>(stencil.size()));
      std::uint64_t used = 0;
      for (const int v : vertices) used |= v < moving ? taken[static_cast<std::size_t>(v)] : 0;
      const int free = std::countr_one(used);
      if (free == 64) {
        waiting.push_back(s);
        continue;
      }
      for (const int v : vertices)
        if (v < moving) taken[static_cast<std::size_t>(v)] |= std::uint64_t{1} << free;
      color_of[static_cast<std::size_t>(s)] = base + free;
      count = std::max(count, base + free + 1);
    }
    left = std::move(waiting);
  }
  Coloring result{.order = std::vector<int>(stencils.size()),
                  .begin = std::vector<int>(static_cast<std::size_t>(count) + 1, 0)};
  for (const int c : color_of) ++result.begin[static_cast<std::size_t>(c) + 1];
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  std::vector<int> next = result.begin;
  for (std::size_t s = 0; s < stencils.size(); ++s)
    result.order[static_cast<std::size_t>(next[static_cast<std::size_t>(color_of[s])]++)] = static_cast<int>(s);
  return result;
}

}  // namespace tact::solver
