// Something that finds the boxes that overlap, step by step: tact's broad phase, or a library it is held against.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "broadphase/index_pair.h"
#include "engine/base/box.h"

namespace tact::bench {

// What has changed since the step before. Boxes that are missing for now are empty.
struct BoxFrame {
  std::span<const base::Box> boxes;
  std::span<const std::uint32_t> changed;
};

class BoxRival {
 public:
  virtual ~BoxRival() = default;
  BoxRival() = default;
  BoxRival(const BoxRival&) = delete;
  BoxRival& operator=(const BoxRival&) = delete;

  // All that is timed: from the boxes, doubles in the caller's memory, to the complete list of pairs.
  virtual void step(const BoxFrame& frame) = 0;
  // The list that the last step made, sorted, a < b.
  virtual std::vector<broadphase::IndexPair> pairs() const = 0;
};

// Each for `count` boxes and at most `threads` threads.
std::unique_ptr<BoxRival> make_box_tact(std::size_t count, int threads);
// The same, forgetting everything after each step.
std::unique_ptr<BoxRival> make_box_tact_from_scratch(std::size_t count, int threads);
std::unique_ptr<BoxRival> make_box_embree_refit(std::size_t count, int threads);
std::unique_ptr<BoxRival> make_box_embree_rebuild(std::size_t count, int threads);
std::unique_ptr<BoxRival> make_box_cgal(std::size_t count, int threads);

struct BoxRivalKind {
  const char* name;
  std::unique_ptr<BoxRival> (*make)(std::size_t count, int threads);
  bool takes_empty_boxes = true;  // at first, and gives them a place later
};

// tact first.
std::span<const BoxRivalKind> box_rivals();

}  // namespace tact::bench
