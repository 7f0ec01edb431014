// Which bodies a query looks at: by layers, by their boxes in a tree (bodies/body_tree.h) or in a scan, and planes.
#pragma once

#include <tact/queries.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "broadphase/block_search.h"
#include "engine/bodies/bodies.h"
#include "narrowphase/mesh/cluster_search.h"

namespace tact {

// Which bodies a query looks at: those of keys before `end`, if there is one, and by their boxes, as BlockSearch has
// it.
struct Search {
  static constexpr bool kScansByRank = false;  // a scan takes boxes in the order of their slots
  std::optional<std::uint64_t> end = {};
};

// The rank of a box in which nothing is looked for.
inline constexpr double kOutside = std::numeric_limits<double>::infinity();

// Those that overlap a box.
struct BoxSearch : Search {
  explicit BoxSearch(const base::Box& wanted) : box(wanted) {}

  base::Box around() const { return box; }
  double rank(const base::Box& other) const { return overlaps(other, box) ? 0.0 : kOutside; }
  bool wants(double) const { return true; }

  base::Box box;
};

// Less than the distance of any surfaces in two boxes, as it is found: that is off by some roundings of the distance of
// their farthest places. Squares of lengths below 2^-500 may vanish.
struct BoxDistance {
  double least, along_axis;  // along that axis on which they are farthest apart
};
inline BoxDistance distance_below(const base::Box& a, const base::Box& b) {
  double square = 0.0, farthest = 0.0, along_axis = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = a.lower[axis] - b.upper[axis], above = b.lower[axis] - a.upper[axis];
    const double away = std::max(std::max(below, above), 0.0);
    square += away * away;
    along_axis = std::max(along_axis, away);
    farthest = std::max(farthest, std::max(std::abs(below), std::abs(above)));
  }
  return {std::sqrt(square) - (0x1p-44 * farthest + 0x1p-500), along_axis};
}

// Calls visit(slot) for each body that a query considers and whose box a search wants, in no particular order: answers
// are not to depend on it. visit() may narrow the search.
template <class OfBoxes, class Visit>
class BodySearch {
 public:
  BodySearch(const Bodies& bodies, const QueryFilter& filter, OfBoxes& search, const Visit& visit)
      : bodies_(bodies), filter_{filter.layer, filter.mask, false}, search_(search), visit_(visit) {}

  void run() {
    const BodyTree& tree = bodies_.tree();
    if (tree.is_current()) {
      for (const std::uint32_t slot : tree.loose()) look_at(slot);
      broadphase::BlockSearch(tree.blocks(), *this).run();
    } else if constexpr (OfBoxes::kScansByRank) {
      scan_by_rank();
    } else {
      const bool in_order = bodies_.keys().are_slots();
      for (std::uint32_t slot = 0; slot < slot_count() && (!in_order || is_before_end(slot)); ++slot) look_at(slot);
    }
  }

  base::Box around() const { return search_.around(); }
  double rank(const base::Box& box) const { return search_.rank(box); }
  double rank_of(std::uint32_t slot) const {
    return is_before_end(slot) && !bodies_.tree().is_loose(slot) && considers(slot) ? rank(bodies_.boxes()[slot])
                                                                                    : kOutside;
  }
  bool wants(double rank) const { return search_.wants(rank); }
  void visit(std::uint32_t slot) const { visit_(slot); }

 private:
  static constexpr std::uint32_t kAtATime = 64;  // boxes whose ranks are found before any body is looked at

  void scan_by_rank() const {
    std::array<double, kAtATime> ranks;
    std::array<std::uint32_t, kAtATime> slots;
    const auto wanted = [&](double rank) { return wants(rank); };
    for (std::uint32_t begin = 0; begin < slot_count(); begin += kAtATime) {
      int count = 0;
      for (std::uint32_t slot = begin; slot < std::min(begin + kAtATime, slot_count()); ++slot) {
        if (bodies_.boxes()[slot].empty()) continue;
        const double of_box = rank(bodies_.boxes()[slot]);
        if (!(of_box < kOutside && wants(of_box) && considers(slot))) continue;
        ranks[static_cast<std::size_t>(count)] = of_box;
        slots[static_cast<std::size_t>(count++)] = slot;
      }
      narrowphase::take_by_rank(ranks.data(), slots.data(), count, wanted, visit_);
    }
  }
  std::uint32_t slot_count() const { return static_cast<std::uint32_t>(bodies_.boxes().size()); }
  bool is_before_end(std::uint32_t slot) const { return !search_.end || bodies_.keys().of(slot) < *search_.end; }
  bool considers(std::uint32_t slot) const { return broadphase::tested(bodies_.filters()[slot], filter_); }
  void look_at(std::uint32_t slot) const {
    const base::Box& box = bodies_.boxes()[slot];
    if (box.empty() || !is_before_end(slot)) return;
    const double of_box = rank(box);
    if (of_box < kOutside && wants(of_box) && considers(slot)) visit(slot);
  }

  const Bodies& bodies_;
  const broadphase::Filter filter_;
  OfBoxes& search_;
  const Visit& visit_;
};

template <class OfBoxes, class Visit>
void for_each_body(const Bodies& bodies, const QueryFilter& filter, OfBoxes& search, const Visit& visit) {
  BodySearch(bodies, filter, search, visit).run();
}

// Calls visit(slot, plane) for each plane that a query considers. They stand in no tree.
template <class Visit>
void for_each_plane(const Bodies& bodies, const QueryFilter& filter, const Visit& visit) {
  const broadphase::Filter of_query{filter.layer, filter.mask, false};
  for (const std::uint32_t slot : bodies.planes()) {
    if (broadphase::tested(bodies.filters()[slot], of_query)) visit(slot, *bodies.plane(slot));
  }
}

}  // namespace tact
