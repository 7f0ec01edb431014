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
  for (const double margin : arrays.margins) {
    arrays.largest_margin = std::max(arrays.largest_margin, margin);
    arrays.least_margin = std::min(arrays.least_margin, margin);
  }
  return std::make_unique<FeatureArrays>(std::move(arrays));
}

void check_lengths(const FeatureSettings& settings, std::size_t vertices, std::size_t facets, const std::string& name) {
  check_length(settings.rest_offsets.size(), vertices, "rest offsets of vertices", name);
  check_length(settings.vertex_labels.size(), vertices, "labels of vertices", name);
  check_length(settings.facet_labels.size(), facets, "labels of facets", name);
  check_length(settings.vertex_layers.size(), vertices, "layers of vertices", name);
  check_length(settings.vertex_masks.size(), vertices, "masks of vertices", name);
  check_length(settings.facet_layers.size(), facets, "layers of facets", name);
  check_length(settings.facet_masks.size(), facets, "masks of facets", name);
  check_length(settings.margins.size(), vertices, "margins of vertices", name);
}

// Each from 0 to `most(vertex)`, which is what `above` names.
template <class Most>
void check_distances(std::span<const double> distances, const Most& most, const char* what, const char* above,
                     const std::string& name) {
  for (std::size_t v = 0; v < distances.size(); ++v) {
    if (distances[v] >= 0.0 && distances[v] <= most(v)) continue;
    throw Error(ErrorCode::invalid_argument, quoted(name) + ": the " + what + " of vertex " + std::to_string(v) +
                                                 " is " + base::text_of(distances[v]) + ", not 0 to " + above +
                                                 ", which is " + base::text_of(most(v)));
  }
}

}  // namespace

void check_feature_settings(const FeatureSettings& settings, std::size_t vertices, std::size_t facets,
                            const BodyDistances& body, const std::string& name) {
  check_lengths(settings, vertices, facets, name);
  check_distances(
      settings.margins, [&](std::size_t) { return body.margin; }, "margin", "that of the body", name);
  const auto margin_of = [&](std::size_t v) { return settings.margins.empty() ? body.margin : settings.margins[v]; };
  check_distances(settings.rest_offsets, margin_of, "rest offset", "the margin", name);
  if (!settings.rest_offsets.empty() || !body.rest_offset) return;
  for (std::size_t v = 0; v < settings.margins.size(); ++v) {
    if (settings.margins[v] >= *body.rest_offset) continue;
    throw Error(ErrorCode::invalid_argument, quoted(name) + ": the margin of vertex " + std::to_string(v) + " is " +
                                                 base::text_of(settings.margins[v]) +
                                                 ", less than the rest offset of the body, which is " +
                                                 base::text_of(*body.rest_offset));
  }
}

bool answer_alike(const FeatureSettings& x, const FeatureSettings& y, bool by_labels) {
  const auto same = [&](auto FeatureSettings::*list) { return std::ranges::equal(x.*list, y.*list); };
  return same(&FeatureSettings::rest_offsets) && same(&FeatureSettings::margins) &&
         same(&FeatureSettings::vertex_layers) && same(&FeatureSettings::vertex_masks) &&
         same(&FeatureSettings::facet_layers) && same(&FeatureSettings::facet_masks) &&
         (!by_labels || (same(&FeatureSettings::vertex_labels) && same(&FeatureSettings::facet_labels)));
}

std::unique_ptr<FeatureArrays> copy_of(const FeatureSettings& settings) {
  return if_any({.rest_offsets = copy_of(settings.rest_offsets),
                 .margins = copy_of(settings.margins),
                 .vertex_labels = copy_of(settings.vertex_labels),
                 .facet_labels = copy_of(settings.facet_labels),
                 .vertex_layers = copy_of(settings.vertex_layers),
                 .vertex_masks = copy_of(settings.vertex_masks),
                 .facet_layers = copy_of(settings.facet_layers),
                 .facet_masks = copy_of(settings.facet_masks)});
}

std::unique_ptr<FeatureArrays> carried(const FeatureArrays* last, std::span<const int> vertex_map,
                                       std::span<const int> facet_map, const FeatureDefaults& of_new) {
  if (last == nullptr) return nullptr;
  return if_any({.rest_offsets = carried(last->rest_offsets, vertex_map, of_new.rest_offset),
                 .margins = carried(last->margins, vertex_map, of_new.margin),
                 .vertex_labels = carried(last->vertex_labels, vertex_map, std::uint32_t{0}),
                 .facet_labels = carried(last->facet_labels, facet_map, std::uint32_t{0}),
                 .vertex_layers = carried(last->vertex_layers, vertex_map, of_new.layer),
                 .vertex_masks = carried(last->vertex_masks, vertex_map, of_new.mask),
                 .facet_layers = carried(last->facet_layers, facet_map, of_new.layer),
                 .facet_masks = carried(last->facet_masks, facet_map, of_new.mask)});
}

}  // namespace tact
