#include "engine/bodies/feature_arrays.h"

#include <tact/error.h>

#include <algorithm>
#include <utility>

#include "engine/base/text.h"
#include "engine/bodies/checks.h"

namespace tact {

namespace {

void check_length(std::size_t given, std::size_t wanted, const char* what, const std::string& name) {
  if (given == 0 || given == wanted) return;
  throw Error(ErrorCode::wrong_size,
              quoted(name) + ": there are " + std::to_string(given) + " " + what + ", not " + std::to_string(wanted));
}

template <class Value>
std::vector<Value> carried(const std::vector<Value>& last, std::span<const int> map, Value of_new) {
  std::vector<Value> now;
  if (last.empty()) return now;
  now.reserve(map.size());
  for (const int was : map) now.push_back(was < 0 ? of_new : last[static_cast<std::size_t>(was)]);
  return now;
}

template <class Value>
std::vector<Value> copy_of(std::span<const Value> values) {
  return {values.begin(), values.end()};
}

std::unique_ptr<FeatureArrays> if_any(FeatureArrays arrays) {
  if (arrays.empty()) return nullptr;
  for (const double offset : arrays.rest_offsets)
    arrays.largest_rest_offset = std::max(arrays.largest_rest_offset, offset);
  return std::make_unique<FeatureArrays>(std::move(arrays));
}

}  // namespace

void check_feature_settings(const FeatureSettings& settings, std::size_t vertices, std::size_t facets, double margin,
                            const std::string& name) {
  check_length(settings.rest_offsets.size(), vertices, "rest offsets of vertices", name);
  check_length(settings.vertex_labels.size(), vertices, "labels of vertices", name);
  check_length(settings.facet_labels.size(), facets, "labels of facets", name);
  check_length(settings.vertex_layers.size(), vertices, "layers of vertices", name);
  check_length(settings.vertex_masks.size(), vertices, "masks of vertices", name);
  for (std::size_t v = 0; v < settings.rest_offsets.size(); ++v) {
    const double offset = settings.rest_offsets[v];
    if (offset >= 0.0 && offset <= margin) continue;
    throw Error(ErrorCode::invalid_argument, quoted(name) + ": the rest offset of vertex " + std::to_string(v) +
                                                 " is " + base::text_of(offset) + ", not 0 to the margin, which is " +
                                                 base::text_of(margin));
  }
}

std::unique_ptr<FeatureArrays> copy_of(const FeatureSettings& settings) {
  return if_any({.rest_offsets = copy_of(settings.rest_offsets),
                 .vertex_labels = copy_of(settings.vertex_labels),
                 .facet_labels = copy_of(settings.facet_labels),
                 .vertex_layers = copy_of(settings.vertex_layers),
                 .vertex_masks = copy_of(settings.vertex_masks)});
}

std::unique_ptr<FeatureArrays> carried(const FeatureArrays* last, std::span<const int> vertex_map,
                                       std::span<const int> facet_map, const FeatureDefaults& of_new) {
  if (last == nullptr) return nullptr;
  return if_any({.rest_offsets = carried(last->rest_offsets, vertex_map, of_new.rest_offset),
                 .vertex_labels = carried(last->vertex_labels, vertex_map, std::uint32_t{0}),
                 .facet_labels = carried(last->facet_labels, facet_map, std::uint32_t{0}),
                 .vertex_layers = carried(last->vertex_layers, vertex_map, of_new.layer),
                 .vertex_masks = carried(last->vertex_masks, vertex_map, of_new.mask)});
}

}  // namespace tact
