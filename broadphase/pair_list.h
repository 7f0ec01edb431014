// A list of pairs that grows, and keeps its memory when it is emptied.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "broadphase/index_pair.h"

namespace tact::broadphase {

class PairList {
 public:
  std::span<const IndexPair> pairs() const { return {storage_.data(), count_}; }
  void clear() { count_ = 0; }

  // The end of the list, with room for `count` more pairs. What is written there joins the list by extend().
  IndexPair* room(std::size_t count) {
    if (storage_.size() < count_ + count) storage_.resize(2 * (count_ + count));
    return storage_.data() + count_;
  }
  void extend(std::size_t count) { count_ += count; }

 private:
  std::vector<IndexPair> storage_;
  std::size_t count_ = 0;
};

}  // namespace tact::broadphase
