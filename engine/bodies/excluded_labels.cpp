#include "engine/bodies/excluded_labels.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace tact {

namespace {

using broadphase::IndexPair, narrowphase::TwoLabels;
using OfBodies = ExcludedLabels::OfBodies;

IndexPair bodies_of(const LabelPair& labels) { return {labels.a.index, labels.b.index}; }

TwoLabels labels_of(const LabelPair& labels) { return {labels.label_a, labels.label_b}; }

LabelPair swapped(const LabelPair& labels) { return {labels.b, labels.label_b, labels.a, labels.label_a, labels.kind}; }

bool is_ascending(const ExcludedLabels::Labels& labels) {
  return std::ranges::adjacent_find(labels, std::not_fn(std::less())) == labels.end();
}

bool has_both_orders(const ExcludedLabels& excluded, const ExcludedLabels::All::value_type& one, LabelKind kind) {
  const auto& [bodies, labels] = one;
  const OfBodies* const other = excluded.find(bodies.b, bodies.a);
  return other != nullptr && other->of(kind).size() == labels.of(kind).size() &&
         std::ranges::all_of(labels.of(kind), [&](const TwoLabels& two) {
           return two[0] != 0 && two[1] != 0 && std::ranges::binary_search(other->of(kind), TwoLabels{two[1], two[0]});
         });
}

}  // namespace

const OfBodies* ExcludedLabels::find(std::uint32_t a, std::uint32_t b) const {
  const auto found = all_.find({a, b});
  return found == all_.end() ? nullptr : &found->second;
}

bool ExcludedLabels::contains(const LabelPair& labels) const {
  const OfBodies* const found = find(labels.a.index, labels.b.index);
  return found != nullptr && std::ranges::binary_search(found->of(labels.kind), labels_of(labels));
}

bool ExcludedLabels::has_any_of(std::uint32_t slot) const {
  const auto at = all_.lower_bound({slot, 0});
  return at != all_.end() && at->first.a == slot;
}

void ExcludedLabels::set(const LabelPair& labels, bool excluded) {
  if (contains(labels) == excluded) return;
  const auto remove_both = [&] { remove(labels), remove(swapped(labels)); };
  if (!excluded) return remove_both();
  try {
    add(labels), add(swapped(labels));
  } catch (...) {
    remove_both();
    throw;
  }
}

// One order of a pair.
void ExcludedLabels::add(const LabelPair& labels) {
  Labels& list = all_[bodies_of(labels)].of(labels.kind);
  const auto place = std::ranges::lower_bound(list, labels_of(labels));
  if (place == list.end() || *place != labels_of(labels)) list.insert(place, labels_of(labels));
}

void ExcludedLabels::remove(const LabelPair& labels) {
  const auto found = all_.find(bodies_of(labels));
  if (found == all_.end()) return;
  std::erase(found->second.of(labels.kind), labels_of(labels));
  if (found->second.empty()) all_.erase(found);
}

void ExcludedLabels::remove_all_of(std::uint32_t slot) {
  for (auto at = all_.lower_bound({slot, 0}); at != all_.end() && at->first.a == slot; at = all_.erase(at)) {
    if (at->first.b != slot) all_.erase({at->first.b, slot});
  }
}

bool ExcludedLabels::put(All&& all) {
  all_ = std::move(all);
  return std::ranges::all_of(all_, [&](const All::value_type& one) {
    const OfBodies& labels = one.second;
    return !labels.empty() && is_ascending(labels.of_facets) && is_ascending(labels.of_vertices) &&
           has_both_orders(*this, one, LabelKind::facet) && has_both_orders(*this, one, LabelKind::vertex);
  });
}

}  // namespace tact
