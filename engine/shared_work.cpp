#include "engine/shared_work.h"

#include <algorithm>

namespace tact {

bool is_few(std::size_t items, int threads, const base::Tuning& tuning) {
  return items < tuning.few_pairs_per_thread * static_cast<std::size_t>(threads);
}

bool is_large(std::size_t work, std::size_t items, int threads, const base::Tuning& tuning) {
  return threads > 1 && work > (is_few(items, threads, tuning) ? tuning.large_of_few : tuning.large_pair);
}

std::size_t count_of_ranges(std::size_t work, int threads, const base::Tuning& tuning) {
  const std::size_t fewest = tuning.fewest_in_range;
  const std::size_t at_once = std::clamp<std::size_t>(work / fewest, 1, static_cast<std::size_t>(threads));
  return at_once * std::clamp<std::size_t>(work / (2 * fewest * at_once), 1, tuning.ranges_per_thread);
}

std::size_t range_begin(std::span<const narrowphase::ClusterPair> pairs, std::size_t i, std::size_t count) {
  std::size_t begin = pairs.size() * i / count;
  while (begin > 0 && begin < pairs.size() && pairs[begin].a == pairs[begin - 1].a) ++begin;
  return begin;
}

}  // namespace tact
