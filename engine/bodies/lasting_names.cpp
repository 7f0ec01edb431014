#include "engine/bodies/lasting_names.h"

#include <algorithm>
#include <iterator>

namespace tact {

namespace {

LastingNames::Feature sorted(LastingNames::Feature names) {
  std::ranges::sort(names);
  return names;
}

}  // namespace

LastingNames::LastingNames(const LastingNames* last, std::span<const int> was, std::span<const int> keeps)
    : next_(last == nullptr ? kFirstNew : last->next_) {
  of_vertex_.reserve(was.size());
  for (std::size_t v = 0; v < was.size(); ++v) {
    const bool keeps_name = was[v] >= 0 && keeps[was[v]] == static_cast<int>(v);
    of_vertex_.push_back(keeps_name ? name_in(last, was[v]) : next_++);
  }
  if (last == nullptr || last->orders_.empty()) return;
  // A name that has gone never comes again.
  std::vector<std::uint64_t> there = of_vertex_;
  std::ranges::sort(there);
  const auto is_there = [&](std::uint64_t name) { return std::ranges::binary_search(there, name); };
  std::ranges::copy_if(last->orders_, std::back_inserter(orders_),
                       [&](const Feature& names) { return std::ranges::all_of(names, is_there); });
}

// Orders that were kept before are older.
void LastingNames::keep_orders(std::vector<Feature> orders) {
  orders_.insert(orders_.end(), orders.begin(), orders.end());
  std::ranges::stable_sort(orders_, {}, sorted);
  const auto same = [](const Feature& x, const Feature& y) { return sorted(x) == sorted(y); };
  orders_.erase(std::unique(orders_.begin(), orders_.end(), same), orders_.end());
}

LastingNames::Feature LastingNames::of(const std::array<int, 3>& vertices) const {
  Feature names;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    names[k] = vertices[k] < 0 ? kNoVertex : name_in(this, vertices[k]);
    count += vertices[k] < 0 ? 0 : 1;
  }
  if (count == 2 && names[1] < names[0]) std::swap(names[0], names[1]);
  if (count < 3 || orders_.empty()) return names;
  const Feature key = sorted(names);
  const auto found = std::ranges::lower_bound(orders_, key, {}, sorted);
  return found != orders_.end() && sorted(*found) == key ? *found : names;
}

}  // namespace tact
