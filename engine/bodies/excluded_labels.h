// Pairs of labels whose features a caller does not want tested against each other.
#pragma once

#include <tact/body.h>

#include <cstdint>
#include <map>
#include <vector>

#include "broadphase/index_pair.h"
#include "narrowphase/motion/feature_filter.h"

namespace tact {

/// Bodies are named by their slots. Each pair of bodies is kept in both orders.
class ExcludedLabels {
 public:
  using Labels = std::vector<narrowphase::TwoLabels>;  // sorted
  struct OfBodies {
    Labels of_facets, of_vertices;
    const Labels& of(LabelKind kind) const { return kind == LabelKind::facet ? of_facets : of_vertices; }
    Labels& of(LabelKind kind) { return kind == LabelKind::facet ? of_facets : of_vertices; }
    bool empty() const { return of_facets.empty() && of_vertices.empty(); }
  };
  using All = std::map<broadphase::IndexPair, OfBodies>;  // none without labels

  bool empty() const { return all_.empty(); }
  /// Null where none are excluded.
  const OfBodies* find(std::uint32_t a, std::uint32_t b) const;
  bool contains(const LabelPair& labels) const;
  /// Whether any of its labels are excluded.
  bool has_any_of(std::uint32_t slot) const;
  /// If it fails nothing has changed.
  void set(const LabelPair& labels, bool excluded);
  /// All pairs of a body that goes.
  void remove_all_of(std::uint32_t slot);

  /// What a state holds, and whether that is what set() makes of it.
  const All& all() const { return all_; }
  bool put(All&& all);

 private:
  void add(const LabelPair& labels);
  void remove(const LabelPair& labels);

  All all_;
};

}  // namespace tact
