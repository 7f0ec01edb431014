// Bodies over many ranks that come, go, are cut and change hands and settings, drawn from numbers that all ranks share.
#pragma once

#include <tact/mpi/world.h>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/mpi/blobs.h"
#include "tests/mpi/one_and_many.h"

namespace tact::tests {

// How many vertices a body has more than its blob; a body that is not there is not among them.
using There = std::map<int, int>;
using BeforeDetect = std::function<void(Both& both, int step, There& there)>;

inline Eigen::Matrix3Xd positions_of(const Mesh& blob, int more) {
  Eigen::Matrix3Xd positions(3, blob.positions.cols() + more);
  positions << blob.positions, blob.positions.leftCols(more);
  return positions;
}

// Some facets of a body go and others come again; half of those at a vertex get one of their own.
inline void cut(Both& both, int i, int step, int across, int& more) {
  const auto n = static_cast<std::uint64_t>(i), t = static_cast<std::uint64_t>(step);
  const Mesh blob = blob_at(i, step, across);
  const int vertices = static_cast<int>(blob.vertex_count()), next = drawn(29, n, t, 3), without = drawn(30, n, t, 11);
  std::vector<int> facets, vertex_map;
  for (int f = 0; f < static_cast<int>(blob.facet_count()); ++f) {
    if (f % 11 == without) continue;
    for (int k = 0; k < 3; ++k) {
      const int v = blob.facets(k, f);
      facets.push_back(v < next && f % 2 == 1 ? vertices + v : v);
    }
  }
  for (int v = 0; v < vertices + next; ++v) vertex_map.push_back(v < vertices + more ? v : v - vertices);
  vertex_map[7] = -1;
  const Eigen::Matrix3Xd positions = positions_of(blob, next);
  both.on_owner(key_of(i), [&](auto& world, auto body) {
    world.set_facets(body, {.positions = positions,
                            .facets = Facets::strided(facets.data(), facets.size() / 3),
                            .vertex_map = vertex_map});
  });
  more = next;
}

// Bodies come, go and change hands; margins, layers, groups and exclusions change.
class Churn {
 public:
  Churn(const std::string& name, int bodies, int steps)
      : bodies_(bodies), steps_(steps), across_(across_of(bodies)), both_(name, settings()) {
    for (int i = 0; i < bodies; i += 2) add(i, 0);
    both_.add_plane({.offset = 0.3, .key = 2, .margin = 0.05});
  }

  void run(const BeforeDetect& before) {
    for (int step = 0; step < steps_; ++step) {
      let_come_and_go(step);
      hand_over(step);
      for (const auto& [i, more] : there_) {
        both_.on_owner(key_of(i), [&, i = i, more = more](auto& world, auto body) {
          const Eigen::Matrix3Xd positions = positions_of(blob_at(i, step, across_), more);
          if (drawn_for(11, i, step, 4) != 0) world.set_positions(body, positions);
          change_settings(world, body, i, step);
          change_features(world, body, static_cast<std::size_t>(positions.cols()), i, step);
        });
        change_exclusions(i, step);
      }
      before(both_, step, there_);
      if (step % 4 == 1) both_.detect_motion(Impacts::all);
      both_.detect();
    }
  }

 private:
  static mpi::Settings settings() {
    mpi::Settings settings = all_outputs();
    settings.world.outputs.curves = settings.world.outputs.within_reach = true;
    return settings;
  }
  // One of `count` numbers, for a body in a step.
  static int drawn_for(std::uint64_t seed, int i, int step, int count) {
    return drawn(seed, static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(step), count);
  }

  void add(int i, int step) {
    both_.add(some_body(i, step, across_), drawn_for(3, i, step, count_of_ranks()));
    there_[i] = 0;
  }
  void let_come_and_go(int step) {
    for (std::uint64_t k = 0; k < 3; ++k) {
      const int old_one = drawn_for(10 + k, step, 0, bodies_), new_one = drawn_for(20 + k, step, 0, bodies_);
      if (there_.erase(old_one) > 0) both_.remove(key_of(old_one));
      if (!there_.contains(new_one)) add(new_one, step);
    }
    for (auto& [i, more] : there_) {
      const bool has_facets = i % 8 != 3 && i % 8 != 5;
      if (has_facets && drawn_for(28, i, step, 12) == 0) cut(both_, i, step, across_, more);
    }
  }
  void hand_over(int step) {
    const auto t = static_cast<std::uint64_t>(step);
    for (const Key key : both_.many.bodies()) {
      if (drawn(7, key, t, 5) == 0) both_.many.set_owner(key, drawn(8, key, t, count_of_ranks()));
    }
    if (step % 3 == 1) both_.many.move_bodies();
    if (step % 10 == 9) both_.many.rebalance();
  }

  static void change_settings(auto& world, auto body, int i, int step) {
    if (drawn_for(12, i, step, 9) == 0) {
      world.set_feature_settings(body, {});  // vertices that came by a cut have the margin that it had then
      world.set_margin(body, 0.02 * drawn_for(13, i, step, 4));
    }
    if (drawn_for(14, i, step, 20) == 0) world.set_group(body, static_cast<std::uint32_t>(drawn_for(15, i, step, 3)));
    if (drawn_for(16, i, step, 20) == 0) world.set_layers(body, 1u << drawn_for(17, i, step, 2), 3u);
    if (drawn_for(18, i, step, 20) == 0) world.set_self_contact(body, drawn_for(19, i, step, 2) == 0);
    if (drawn_for(24, i, step, 12) == 0)
      world.set_rest_offset(body, drawn_for(25, i, step, 2) == 0 ? std::optional(0.0) : std::nullopt);
  }
  static void change_features(auto& world, auto body, std::size_t vertices, int i, int step) {
    if (drawn_for(26, i, step, 20) == 0) {
      std::vector<std::uint32_t> masks(vertices, ~0u);
      for (std::size_t v = 0; v < masks.size(); v += 3)
        masks[v] = static_cast<std::uint32_t>(drawn_for(27, i, step, 4));
      // None, or 0 for each vertex, whatever the body's is.
      const std::vector<double> margins(drawn_for(29, i, step, 2) == 0 ? masks.size() : 0, 0.0);
      world.set_feature_settings(body, {.vertex_labels = masks, .vertex_masks = masks, .margins = margins});
      world.set_self_contact_filter(body, {.rings = drawn_for(30, i, step, 3)});
    }
    if (drawn_for(31, i, step, 8) == 0) {
      const std::vector<std::uint32_t> labels(vertices, static_cast<std::uint32_t>(drawn_for(32, i, step, 3)));
      world.set_feature_settings(body, {.vertex_labels = labels});
    }
  }
  void change_exclusions(int i, int step) {
    const int other = drawn_for(21, i, step, bodies_);
    if (drawn_for(22, i, step, 6) == 0 && other != i && there_.contains(other))
      both_.exclude(key_of(i), key_of(other), drawn_for(23, i, step, 3) != 0);
    if (drawn_for(33, i, step, 3) == 0 && there_.contains(other)) {
      const auto label = [&](std::uint64_t seed) {
        return 1u + static_cast<std::uint32_t>(drawn_for(seed, i, step, 2));
      };
      const mpi::LabelPair labels{.key_a = key_of(i),
                                  .label_a = label(34),
                                  .key_b = key_of(other),
                                  .label_b = label(35),
                                  .kind = LabelKind::vertex};
      both_.exclude(labels, drawn_for(36, i, step, 4) != 0, drawn_for(37, i, step, 2) != 0);
    }
  }

  int bodies_;
  int steps_;
  int across_;
  Both both_;
  There there_;
};

}  // namespace tact::tests
