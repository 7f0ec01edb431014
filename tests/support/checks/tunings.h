// Thresholds that force every way to an answer: what is right by default must be right, and the same, by each.
#pragma once

#include <array>
#include <ostream>

#include "engine/base/tuning.h"

namespace tact::tests {

struct NamedTuning {
  const char* name;
  base::Tuning tuning;
};

inline void PrintTo(const NamedTuning& named, std::ostream* out) { *out << named.name; }

/// No shorter way: the step does what defines the answer.
inline constexpr base::Tuning kPlain{.fewest_packed = base::Tuning::kNever,
                                     .fewest_regrouped = base::Tuning::kNever,
                                     .few_boxes = 0,
                                     .largest_loop = base::Tuning::kNever,
                                     .worth_planes = base::Tuning::kNever,
                                     .large_item = base::Tuning::kNever,
                                     .large_of_few = base::Tuning::kNever,
                                     .worth_as_surfaces = base::Tuning::kNever,
                                     .few_in_blocks = base::Tuning::kNever,
                                     .worth_floats = base::Tuning::kNever,
                                     .worth_a_plane = 1,
                                     .carries_order = false,
                                     .separates_by_kdop = false,
                                     .carries_hulls = false,
                                     .support_by_clusters = false,
                                     .carries_surfaces = false,
                                     .asks_near_facets = false,
                                     .decides_many = false};

/// Every way that has a border, whatever the size: small worlds are packed and grouped anew in each step, trees find
/// all cluster pairs, every pair is cut into ranges.
inline constexpr base::Tuning kForced{.fewest_packed = 1,
                                      .fewest_regrouped = 1,
                                      .moves_to_look = 1,
                                      .decayed = 0.5,
                                      .worth_regrouping = 4.0,
                                      .few_boxes = 0,
                                      .largest_loop = 0,
                                      .worth_planes = 0,
                                      .large_item = 0,
                                      .large_of_few = 0,
                                      .fewest_in_range = 1,
                                      .few_in_blocks = 0,
                                      .worth_floats = 0,
                                      .worth_a_plane = 1};

inline constexpr std::array kTunings{NamedTuning{"plain", kPlain}, NamedTuning{"forced", kForced}};

}  // namespace tact::tests
