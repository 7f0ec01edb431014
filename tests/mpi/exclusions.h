// Bodies and labels that are excluded by name, while owners, labels and keys change.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/hash.h"
#include "tests/mpi/blobs.h"
#include "tests/mpi/one_and_many.h"

namespace tact::tests {

// Two bodies of two owners: no box moves, only labels, what is excluded of them, and who owns whom.
inline void excluded_labels() {
  Both both("excluded labels", all_outputs());
  const Mesh cube = box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  const int last = count_of_ranks() - 1;
  both.add(definition_of(cube, 1, 0.01), 0);
  both.add(definition_of(translated(cube, {2.0, 0.1, 0.2}), 2, 0.01), last);
  both.detect();
  both.on_owner(2, [&](auto& world, auto body) {
    world.set_positions(body, translated(cube, {0.5, 0.1, 0.2}).positions);
  });
  both.detect_motion(Impacts::all);
  const auto label = [&](Key key, std::uint32_t number) {
    const std::vector<std::uint32_t> labels(static_cast<std::size_t>(cube.facets.cols()), number);
    both.on_owner(key, [&](auto& world, auto body) { world.set_feature_settings(body, {.facet_labels = labels}); });
    both.detect();
  };
  label(1, 7), label(2, 5);
  for (int k = 0; k < 4; ++k) {
    const Key other = k % 2 == 0 ? 1 : 2;
    both.exclude({.key_a = 1, .label_a = 7, .key_b = 2, .label_b = 5}, true, k % 2 == 0);
    both.detect();
    label(other, 9);
    both.save();
    label(other, other == 1 ? 7 : 5);
    both.restore(Both::Shares::in_turn, k);
    both.detect();
    label(other, other == 1 ? 7 : 5);
    for (const Key key : both.many.bodies()) both.many.set_owner(key, (rank_of_all() + 1) % count_of_ranks());
    both.many.move_bodies();
    both.detect();
    both.exclude({.key_a = 2, .label_a = 5, .key_b = 1, .label_b = 7}, false, k % 2 == 0);
    both.detect();
  }
}

// What is excluded when keys are used again, owners change or a call fails before the other owner has learnt it.
inline void exclusions() {
  Both both("exclusions", all_outputs());
  const auto cube_of = [](Key key, double way) {
    return translated(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {0.3 * static_cast<double>(key) + way, 0.1 * way, 0.2});
  };
  const auto add = [&](Key key, int owner) { both.add(definition_of(cube_of(key, 0.0), key, 0.01), owner); };
  const int last = count_of_ranks() - 1;
  add(1, 0), add(2, last);
  both.detect();
  // The other one hosts, so that its owner looks at the pair; see HostOrder.
  const Key gone = base::mixed(Key{1}) < base::mixed(Key{2}) ? 1 : 2;
  both.exclude(gone, 3 - gone, true);
  both.remove(gone);
  add(gone, gone == 1 ? 0 : last);
  both.detect();
  // From the first rank to the last, and from the last to the first.
  for (const Key first : {Key{1}, Key{1}, Key{2}, Key{2}}) {
    both.exclude(first, 3 - first, true);
    for (const Key key : both.many.bodies()) both.many.set_owner(key, (rank_of_all() + 1) % count_of_ranks());
    both.many.move_bodies();
    both.exclude(first, 3 - first, false);
    both.detect();
  }
  both.exclude(2, 1, true);
  if (both.many.owns(1)) both.many.set_excluded(1, 3, true);
  expect_on_all(caught([&] { both.many.detect(); }),
                "stale_body: nobody owns a body of key 3, which was to be excluded");
  both.detect();
  add(3, last);
  both.detect();
  both.on_owner(3, [&](auto& world, auto body) { world.set_positions(body, cube_of(3, -2.5).positions); });
  both.detect_motion(Impacts::all);
  both.detect();
}

}  // namespace tact::tests
