#include "engine/bodies/excluded_labels.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace tact {

namespace {

using broadphase::IndexPair, narrowphase::TwoLabels;
using OfBodies = ExcludedLabels::OfBodies;

// Adds or removes one order of a pair.
void change(std::vector<OfBodies>& all, IndexPair bodies, LabelKind kind, TwoLabels labels, bool excluded) {
  auto at = std::ranges::lower_bound(all, bodies, {}, &OfBodies::bodies);
  if (at == all.end() || at->bodies != bodies) {
    if (!excluded) return;
    at = all.insert(at, {.bodies = bodies, .of_facets = {}, .of_vertices = {}});
  }
  ExcludedLabels::Labels& list = at->of(kind);
  const auto place = std::ranges::lower_bound(list, labels);
  const bool is_there = place != list.end() && *place == labels;
  if (excluded && !is_there) list.insert(place, labels);
  if (!excluded && is_there) list.erase(place);
  if (at->of_facets.empty() && at->of_vertices.empty()) all.erase(at);
}

bool is_ascending(const ExcludedLabels::Labels& labels) {
  return std::ranges::adjacent_find(labels, [](const auto& x, const auto& y) { return !(x < y); }) == labels.end();
}

bool has_both_orders(const ExcludedLabels& excluded, const OfBodies& one, LabelKind kind) {
  const OfBodies* const other = excluded.find(one.bodies.b, one.bodies.a);
  return other != nullptr && other->of(kind).size() == one.of(kind).size() &&
         std::ranges::all_of(one.of(kind), [&](const TwoLabels& labels) {
           return labels[0] != 0 && labels[1] != 0 &&
                  std::ranges::binary_search(other->of(kind), TwoLabels{labels[1], labels[0]});
         });
}

}  // namespace

const OfBodies* ExcludedLabels::find(std::uint32_t a, std::uint32_t b) const {
  const auto at = std::ranges::lower_bound(all_, IndexPair{a, b}, {}, &OfBodies::bodies);
  return at == all_.end() || at->bodies != IndexPair{a, b} ? nullptr : &*at;
}

bool ExcludedLabels::contains(const LabelPair& labels) const {
  const OfBodies* const found = find(labels.a.index, labels.b.index);
  return found != nullptr &&
         std::ranges::binary_search(found->of(labels.kind), TwoLabels{labels.label_a, labels.label_b});
}

bool ExcludedLabels::has_any_of(std::uint32_t slot) const {
  const auto at = std::ranges::lower_bound(all_, IndexPair{slot, 0}, {}, &OfBodies::bodies);
  return at != all_.end() && at->bodies.a == slot;
}

void ExcludedLabels::set(const LabelPair& labels, bool excluded) {
  std::vector<OfBodies> now = all_;
  const std::uint32_t a = labels.a.index, b = labels.b.index;
  change(now, {a, b}, labels.kind, {labels.label_a, labels.label_b}, excluded);
  change(now, {b, a}, labels.kind, {labels.label_b, labels.label_a}, excluded);
  all_ = std::move(now);
}

void ExcludedLabels::remove_all_of(std::uint32_t slot) {
  std::erase_if(all_, [&](const OfBodies& one) { return one.bodies.a == slot || one.bodies.b == slot; });
}

bool ExcludedLabels::put(std::vector<OfBodies>&& all) {
  all_ = std::move(all);
  const auto ascend = [](const OfBodies& x, const OfBodies& y) { return x.bodies < y.bodies; };
  return std::ranges::adjacent_find(all_, std::not_fn(ascend)) == all_.end() &&
         std::ranges::all_of(all_, [&](const OfBodies& one) {
           return !(one.of_facets.empty() && one.of_vertices.empty()) && is_ascending(one.of_facets) &&
                  is_ascending(one.of_vertices) && has_both_orders(*this, one, LabelKind::facet) &&
                  has_both_orders(*this, one, LabelKind::vertex);
         });
}

}  // namespace tact
