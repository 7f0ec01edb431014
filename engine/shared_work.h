// The scheduler of a stage. Its items are pairs of bodies, or bodies with themselves. A thread prepares an item: it
// finds the pairs of clusters that are near each other. Of a small item it does the rest as well. A large one it puts
// aside, cut into ranges of cluster pairs, and all threads search these. What a range finds goes to a slot of its own,
// and is gathered in the order of the ranges: no answer depends on the number of threads.
//
// Work is counted in microseconds, roughly: each stage says what a pair of clusters takes it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <deque>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/tuning.h"
#include "narrowphase/pairs/cluster_pair.h"

namespace tact {

/// A stage with so few items may leave a thread without one.
bool is_few(std::size_t items, int threads, const base::Tuning& tuning);
/// An item that is shared out among threads, one of `items` items.
bool is_large(std::size_t work, std::size_t items, int threads, const base::Tuning& tuning);
/// Into how many ranges it is cut: equally many for each thread that has enough to do.
std::size_t count_of_ranges(std::size_t work, int threads, const base::Tuning& tuning);
/// Where the i-th of `count` ranges begins: between two clusters of A.
std::size_t range_begin(std::span<const narrowphase::ClusterPair> pairs, std::size_t i, std::size_t count);

/// How many neighbouring items a thread takes at a time. Few items of large bodies are taken one by one: facets_of(i)
/// is how many facets the smaller body has.
template <class FacetsOf>
std::size_t items_at_a_time(std::size_t items, int threads, const base::Tuning& tuning, const FacetsOf& facets_of) {
  if (threads > 1 && items > 1 && is_few(items, threads, tuning)) {
    std::size_t facets = 0;
    for (std::size_t i = 0; i < items; ++i) facets += static_cast<std::size_t>(facets_of(i));
    if (facets >= tuning.worth_threads) return 1;
  }
  return base::grain_of(items, threads, tuning.fewest_at_a_time, tuning.most_at_a_time);
}

/// Calls work(i, thread, threads) for each item: for one that is larger than a thread's part of all, with all threads,
/// one after the other; for the others side by side, with one thread each. Items are few: each is taken by itself.
template <class SizeOf, class Work>
void for_each_item(std::size_t items, int threads, const SizeOf& size_of, const Work& work) {
  std::size_t all = 0;
  for (std::size_t i = 0; i < items; ++i) all += size_of(i);
  const auto is_alone = [&](std::size_t i) { return static_cast<std::size_t>(threads) * size_of(i) > all; };
  base::FirstException failed;
  const auto call = [&](std::size_t i, int thread, int threads_of_item) {
    if (failed.ends_loop()) return;
    try {
      work(i, thread, threads_of_item);
    } catch (...) {
      failed.keep(i);
    }
  };
  if (threads > 1) {
    const base::FloatingPointMode mode;
    for (std::size_t i = 0; i < items; ++i) {
      if (is_alone(i)) call(i, 0, threads);
    }
  }
  base::parallel_for(items, 1, threads, [&](std::size_t i, int thread) {
    if (threads == 1 || !is_alone(i)) call(i, thread, 1);
  });
  failed.rethrow();
}

/// Items of a stage that are shared out. `Item` is what is prepared of one, `Found` the slot of a range; the memory of
/// both is reused.
template <class Item, class Found>
class SharedWork {
 public:
  /// Some cluster pairs of an item, and what was found in them.
  struct Range {
    std::size_t begin = 0, end = 0;
    Found found = {};  ///< of an earlier range, until this one is searched
  };
  struct Shared {
    Item item = {};
    std::size_t pairs = 0;                      ///< of clusters
    std::size_t first = 0, count = 0;           ///< its ranges
    std::size_t next_range = 0, end_range = 0;  ///< no thread has taken those between
  };

  /// From then on nothing is shared out.
  void begin() { items_in_use_ = ranges_in_use_ = 0; }

  /// Calls prepare(i, thread) for `count` items, of which it may put some aside. A thread that is left without items
  /// helps with what others put aside: see search().
  template <class Prepare, class Search>
  void prepare(std::size_t count, std::size_t grain, int threads, bool few, const Prepare& prepare,
               const Search& search) {
    std::atomic<std::size_t> left = few ? count : 0, gone = 0;  // many items are not counted one by one
    const auto prepare_next = [&](std::size_t i, int thread) {
      prepare(i, thread);
      if (few) --left;
    };
    // A thread that finds no range goes; when no items are left, the other ranges are for all threads.
    const auto help = [&](int thread) {
      while ((left > 0 || gone == 0) && search_next(thread, search)) {
      }
      ++gone;
    };
    base::parallel_for(count, grain, threads, prepare_next, help);
  }

  /// Takes an item with these cluster pairs, and gives memory of an earlier one for it. Several threads may call this.
  const Shared& put_aside(Item& item, std::span<const narrowphase::ClusterPair> pairs, std::size_t ranges) {
    const std::lock_guard lock(mutex_);
    Shared& shared = add(pairs, ranges);
    std::swap(item, shared.item);
    return shared;
  }

  /// Calls search(shared, range, thread) for all ranges that are left, on all threads.
  template <class Search>
  void search(int threads, const Search& search) {
    list_left();
    search_left(threads, search);
  }
  /// The same; ranges of lower key_of(range) are begun first.
  template <class Search, class KeyOf>
  void search_by(const KeyOf& key_of, int threads, const Search& search) {
    list_left();
    std::ranges::sort(left_, {}, [&](const Left& one) { return std::pair(key_of(*one.range), one.place); });
    search_left(threads, search);
  }

  /// Calls gather(shared, thread, threads) for each item that was put aside: see for_each_item().
  template <class Gather>
  void gather(int threads, const Gather& gather) {
    for_each_item(
        items_in_use_, threads, [&](std::size_t i) { return items_[i].pairs; },
        [&](std::size_t i, int thread, int threads_of_item) { gather(items_[i], thread, threads_of_item); });
  }

  /// Replaces `found`, a container, by what was found in all ranges of an item, in their order.
  void collect(const Shared& shared, Found& found) const {
    found.clear();
    for (const Range& range : ranges(shared)) found.insert(found.end(), range.found.begin(), range.found.end());
  }

  /// What is shared out.
  auto items() const { return part(items_, 0, items_in_use_); }
  std::size_t range_count() const { return ranges_in_use_; }
  auto ranges(const Shared& shared) const { return part(ranges_, shared.first, shared.count); }
  auto ranges(const Shared& shared) { return part(ranges_, shared.first, shared.count); }

 private:
  struct Left {
    Shared* shared;
    Range* range;
    std::size_t place;
  };

  // Clang 14 does not take libstdc++'s views over a deque.
  template <class Iterator>
  struct Part {
    Iterator first, last;
    Iterator begin() const { return first; }
    Iterator end() const { return last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
    bool empty() const { return first == last; }
    auto& front() const { return *first; }
  };
  static auto part(auto& all, std::size_t first, std::size_t count) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return Part<decltype(all.begin())>{begin, begin + static_cast<std::ptrdiff_t>(count)};
  }

  Shared& add(std::span<const narrowphase::ClusterPair> pairs, std::size_t ranges) {
    if (items_.size() == items_in_use_) items_.emplace_back();
    while (ranges_.size() < ranges_in_use_ + ranges) ranges_.emplace_back();
    Shared& shared = items_[items_in_use_];
    shared.pairs = pairs.size();
    shared.first = ranges_in_use_;
    shared.count = ranges;
    shared.next_range = ranges_in_use_;
    shared.end_range = ranges_in_use_ + ranges;
    for (std::size_t i = 0; i < ranges; ++i) {
      ranges_[shared.first + i].begin = range_begin(pairs, i, ranges);
      ranges_[shared.first + i].end = range_begin(pairs, i + 1, ranges);
    }
    ++items_in_use_;
    ranges_in_use_ += ranges;
    return shared;
  }

  // Returns whether there was a range that no thread had taken. Threads begin at either end: what a thread refitted is
  // in its cache.
  template <class Search>
  bool search_next(int thread, const Search& search) {
    Left next{};
    {
      const std::lock_guard lock(mutex_);
      const auto in_use = items_.begin() + static_cast<std::ptrdiff_t>(items_in_use_);
      const auto found =
          std::find_if(items_.begin(), in_use, [](const Shared& s) { return s.next_range < s.end_range; });
      if (found == in_use) return false;
      const std::size_t place = thread % 2 == 0 ? found->next_range++ : --found->end_range;
      next = {&*found, &ranges_[place], place};
    }
    search(*next.shared, *next.range, thread);
    return true;
  }

  void list_left() {
    left_.clear();
    left_.reserve(ranges_in_use_);  // how many are left is not the same in every step
    for (std::size_t i = 0; i < items_in_use_; ++i) {
      Shared& shared = items_[i];
      for (; shared.next_range < shared.end_range; ++shared.next_range)
        left_.push_back({&shared, &ranges_[shared.next_range], shared.next_range});
    }
  }

  template <class Search>
  void search_left(int threads, const Search& search) const {
    base::parallel_for(left_.size(), 1, threads,
                       [&](std::size_t i, int thread) { search(*left_[i].shared, *left_[i].range, thread); });
  }

  std::deque<Shared> items_;  // items_in_use_ of them are of this step; none moves when others are added
  std::deque<Range> ranges_;
  std::size_t items_in_use_ = 0, ranges_in_use_ = 0;
  std::vector<Left> left_;  // scratch
  std::mutex mutex_;
};

}  // namespace tact
