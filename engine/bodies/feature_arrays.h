// Settings of single vertices and facets of a body, by the caller's numbers.
#pragma once

#include <tact/body.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tact {

/// Each array is empty or has an entry for each vertex, or facet.
struct FeatureArrays {
  std::vector<double> rest_offsets;
  std::vector<std::uint32_t> vertex_labels, facet_labels, vertex_layers, vertex_masks;
  double largest_rest_offset = 0.0;

  bool filters() const { return !vertex_layers.empty() || !vertex_masks.empty(); }
  bool empty() const { return rest_offsets.empty() && vertex_labels.empty() && facet_labels.empty() && !filters(); }
  FeatureSettings view() const { return {rest_offsets, vertex_labels, facet_labels, vertex_layers, vertex_masks}; }
};

/// What a body has where single vertices have nothing else.
struct FeatureDefaults {
  double rest_offset;
  std::uint32_t layer, mask;
};

/// Throws where an array has another length, or a rest offset is not 0 to the margin: wrong_size, invalid_argument.
void check_feature_settings(const FeatureSettings& settings, std::size_t vertices, std::size_t facets, double margin,
                            const std::string& name);

/// Copies settings; null where they set nothing.
std::unique_ptr<FeatureArrays> copy_of(const FeatureSettings& settings);

/// What new vertices and facets have of those that they were; -1: they are new. An empty facet map: all facets are new.
/// The labels of these are 0.
std::unique_ptr<FeatureArrays> carried(const FeatureArrays* last, std::span<const int> vertex_map,
                                       std::span<const int> facet_map, const FeatureDefaults& of_new);

}  // namespace tact
