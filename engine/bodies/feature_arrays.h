// Settings of single vertices and facets of a body, by the caller's numbers.
#pragma once

#include <tact/body.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tact {

/// Each array is empty or has an entry for each vertex, or facet.
struct FeatureArrays {
  std::vector<double> rest_offsets, margins;
  std::vector<std::uint32_t> vertex_labels, facet_labels, vertex_layers, vertex_masks, facet_layers, facet_masks;
  double largest_rest_offset = 0.0, largest_margin = 0.0;
  double least_margin = std::numeric_limits<double>::infinity();

  /// Whether less is found than by the settings of the body.
  bool filters() const {
    return !vertex_layers.empty() || !vertex_masks.empty() || !facet_layers.empty() || !facet_masks.empty() ||
           !margins.empty();
  }
  bool empty() const { return rest_offsets.empty() && vertex_labels.empty() && facet_labels.empty() && !filters(); }
  FeatureSettings view() const {
    return {rest_offsets, vertex_labels, facet_labels, vertex_layers, vertex_masks, facet_layers, facet_masks, margins};
  }
};

/// What a body has where single vertices and facets have nothing else.
struct FeatureDefaults {
  double margin, rest_offset;
  std::uint32_t layer, mask;
};

/// The distances of a body, metres; `rest_offset` if it is given.
struct BodyDistances {
  double margin;
  std::optional<double> rest_offset;
};

/// Throws where an array has another length, a margin is not 0 to that of the body, or a rest offset not 0 to the
/// margin: wrong_size, invalid_argument.
void check_feature_settings(const FeatureSettings& settings, std::size_t vertices, std::size_t facets,
                            const BodyDistances& body, const std::string& name);

/// Whether both lead to the same answers, of which labels are a part where any are excluded.
bool answer_alike(const FeatureSettings& x, const FeatureSettings& y, bool by_labels);

/// Copies settings; null where they set nothing.
std::unique_ptr<FeatureArrays> copy_of(const FeatureSettings& settings);

/// What new vertices and facets have of those that they were; -1: they are new. An empty facet map: all facets are new.
/// The labels of these are 0, all else is that of the body.
std::unique_ptr<FeatureArrays> carried(const FeatureArrays* last, std::span<const int> vertex_map,
                                       std::span<const int> facet_map, const FeatureDefaults& of_new);

}  // namespace tact
