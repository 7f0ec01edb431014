#include <tact/recording.h>
#include <tact/version.h>

#include <array>
#include <bit>
#include <optional>
#include <ostream>
#include <type_traits>

#include "engine/base/floating_point_mode.h"
#include "engine/base/timer.h"
#include "engine/recording/format.h"

namespace tact {
namespace {

using recording::RecordKind;

static_assert(std::endian::native == std::endian::little, "recordings are little-endian");

template <class Number>
void put(std::ostream& out, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::ostream& out, RecordKind kind) { put(out, static_cast<std::uint8_t>(kind)); }

void put_text(std::ostream& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void put_body(std::ostream& out, BodyId body) {
  put(out, body.index);
  put(out, body.generation);
}

// Column by column: the caller's columns need not follow each other.
template <class Scalar, int kRows>
void put_columns(std::ostream& out, const Columns<Scalar, kRows>& columns) {
  for (std::ptrdiff_t i = 0; i < columns.cols(); ++i) {
    const std::array<Scalar, kRows> column = columns.column(i);
    out.write(reinterpret_cast<const char*>(column.data()), sizeof column);
  }
}

// A record of one value of a body.
template <class Number>
void put_value(std::ostream& out, RecordKind kind, BodyId body, Number value) {
  put(out, kind);
  put_body(out, body);
  put(out, value);
}

void put_key(std::ostream& out, const std::optional<std::uint64_t>& key) {
  if (!key) return;
  put(out, RecordKind::key);
  put(out, *key);
}

void put_bare(std::ostream& out, const Edges& edges, std::span<const int> points) {
  if (edges.cols() == 0 && points.empty()) return;
  put(out, RecordKind::bare);
  put(out, static_cast<std::uint64_t>(edges.cols()));
  put(out, static_cast<std::uint64_t>(points.size()));
  put_columns(out, edges);
  for (const int point : points) put(out, std::int32_t{point});
}

void put_plane(std::ostream& out, BodyId body, const PlaneDefinition& definition) {
  put_key(out, definition.key);
  put(out, RecordKind::plane);
  for (const double coordinate : definition.normal) put(out, coordinate);
  put(out, definition.offset);
  put(out, definition.layer);
  put(out, definition.mask);
  put(out, definition.external_id);
  put_text(out, definition.name);
  if (definition.group != 0) put_value(out, RecordKind::group, body, definition.group);
  if (definition.margin != 0.0) put_value(out, RecordKind::margin, body, definition.margin);
  if (definition.rest_offset) put_value(out, RecordKind::rest_offset, body, *definition.rest_offset);
}

void put_addition(std::ostream& out, BodyId body, const BodyDefinition& definition) {
  put_key(out, definition.key);
  put_bare(out, definition.edges, definition.points);
  put(out, RecordKind::add);
  put(out, static_cast<std::uint8_t>(definition.surface));
  put(out, static_cast<std::uint8_t>(definition.motion));
  put(out, definition.layer);
  put(out, definition.mask);
  put(out, definition.external_id);
  put_text(out, definition.name);
  put(out, static_cast<std::uint64_t>(definition.positions.cols()));
  put(out, static_cast<std::uint64_t>(definition.facets.cols()));
  put_columns(out, definition.positions);
  put_columns(out, definition.facets);
  if (definition.group != 0) put_value(out, RecordKind::group, body, definition.group);
  if (definition.margin != 0.0) put_value(out, RecordKind::margin, body, definition.margin);
  if (definition.rest_offset) put_value(out, RecordKind::rest_offset, body, *definition.rest_offset);
  if (definition.self_contact) put_value(out, RecordKind::self_contact, body, std::uint8_t{1});
}

}  // namespace

template <class Write>
void Recorder::write(const Write& write) noexcept {
  const base::FloatingPointMode mode;
  base::Timer timer;
  try {
    write(out_);
  } catch (...) {  // a stream that throws; its owner finds it bad
  }
  writing_ms_ += timer.lap();
}

Recorder::Recorder(std::ostream& out) : out_(out) {
  write([](std::ostream& to) {
    to.write(recording::kMagic.data(), static_cast<std::streamsize>(recording::kMagic.size()));
    put(to, recording::kVersion);
    put_text(to, TACT_VERSION);
  });
}

void Recorder::settings_changed(const Settings& settings) noexcept {
  write([&](std::ostream& out) {
    put(out, RecordKind::settings);
    put(out, std::int32_t{settings.threads});
    put(out, static_cast<std::uint8_t>(settings.accuracy));
    put(out, static_cast<std::uint8_t>(settings.direction));
    put(out, settings.gjk_tolerance);
    put(out, std::int32_t{settings.iteration_limit});
    put(out, std::uint8_t{settings.outputs.zones});
    put(out, std::uint8_t{settings.outputs.patches});
    if (settings.outputs.points) put(out, RecordKind::points);
    if (settings.outputs.curves) put(out, RecordKind::curves);
    if (settings.outputs.within_reach) put(out, RecordKind::within_reach);
  });
}

void Recorder::body_added(BodyId body, const BodyDefinition& definition) noexcept {
  write([&](std::ostream& out) { put_addition(out, body, definition); });
}

void Recorder::plane_added(BodyId body, const PlaneDefinition& definition) noexcept {
  write([&](std::ostream& out) { put_plane(out, body, definition); });
}

void Recorder::body_removed(BodyId body) noexcept {
  write([&](std::ostream& out) {
    put(out, RecordKind::remove);
    put_body(out, body);
  });
}

void Recorder::positions_set(std::span<const PositionsUpdate> updates) noexcept {
  write([&](std::ostream& out) {
    put(out, RecordKind::positions);
    put(out, std::uint64_t{updates.size()});
    for (const PositionsUpdate& update : updates) {
      put_body(out, update.body);
      put(out, static_cast<std::uint64_t>(update.positions.cols()));
      put_columns(out, update.positions);
    }
  });
}

void Recorder::facets_set(BodyId body, const MeshUpdate& update) noexcept {
  write([&](std::ostream& out) {
    put_bare(out, update.edges, update.points);
    if (!update.facet_map.empty()) {
      put(out, RecordKind::facet_map);
      put(out, static_cast<std::uint64_t>(update.facet_map.size()));
      for (const int was : update.facet_map) put(out, std::int32_t{was});
    }
    put(out, RecordKind::facets);
    put_body(out, body);
    put(out, static_cast<std::uint64_t>(update.positions.cols()));
    put(out, static_cast<std::uint64_t>(update.facets.cols()));
    put_columns(out, update.positions);
    put_columns(out, update.facets);
    for (const int was : update.vertex_map) put(out, std::int32_t{was});
  });
}

void Recorder::poses_set(std::span<const PoseUpdate> updates) noexcept {
  write([&](std::ostream& out) {
    put(out, RecordKind::poses);
    put(out, std::uint64_t{updates.size()});
    for (const PoseUpdate& update : updates) {
      put_body(out, update.body);
      for (const double entry : update.rotation.reshaped<Eigen::RowMajor>()) put(out, entry);
      for (const double entry : update.translation) put(out, entry);
    }
  });
}

void Recorder::layers_set(BodyId body, std::uint32_t layer, std::uint32_t mask) noexcept {
  write([&](std::ostream& out) {
    put_value(out, RecordKind::layers, body, layer);
    put(out, mask);
  });
}

void Recorder::group_set(BodyId body, std::uint32_t group) noexcept {
  write([&](std::ostream& out) { put_value(out, RecordKind::group, body, group); });
}

void Recorder::excluded_set(BodyId a, BodyId b, bool excluded) noexcept {
  write([&](std::ostream& out) {
    put(out, RecordKind::excluded);
    put_body(out, a);
    put_body(out, b);
    put(out, std::uint8_t{excluded});
  });
}

void Recorder::motion_set(BodyId body, Motion motion) noexcept {
  write([&](std::ostream& out) { put_value(out, RecordKind::motion, body, static_cast<std::uint8_t>(motion)); });
}

void Recorder::margin_set(BodyId body, double margin) noexcept {
  write([&](std::ostream& out) { put_value(out, RecordKind::margin, body, margin); });
}

void Recorder::rest_offset_set(BodyId body, std::optional<double> rest_offset) noexcept {
  write([&](std::ostream& out) {
    put_value(out, RecordKind::rest_offset, body, rest_offset.value_or(recording::kAsMargin));
  });
}

void Recorder::feature_settings_set(BodyId body, const FeatureSettings& settings) noexcept {
  write([&](std::ostream& out) {
    const std::array others{settings.vertex_labels, settings.facet_labels, settings.vertex_layers,
                            settings.vertex_masks,  settings.facet_layers, settings.facet_masks};
    put_value(out, RecordKind::features, body, static_cast<std::uint64_t>(settings.rest_offsets.size()));
    for (const auto& numbers : others) put(out, static_cast<std::uint64_t>(numbers.size()));
    put(out, static_cast<std::uint64_t>(settings.margins.size()));
    for (const double offset : settings.rest_offsets) put(out, offset);
    for (const auto& numbers : others) {
      for (const std::uint32_t number : numbers) put(out, number);
    }
    for (const double margin : settings.margins) put(out, margin);
  });
}

void Recorder::self_contact_filter_set(BodyId body, const SelfContactFilter& filter) noexcept {
  write([&](std::ostream& out) {
    put_value(out, RecordKind::neighbors, body, std::int32_t{filter.rings});
    put(out, filter.rest_distance);
    put(out, static_cast<std::uint64_t>(filter.rest_positions.cols()));
    put_columns(out, filter.rest_positions);
  });
}

void Recorder::excluded_labels_set(const LabelPair& labels, bool excluded) noexcept {
  write([&](std::ostream& out) {
    put_value(out, RecordKind::excluded_labels, labels.a, labels.label_a);
    put_body(out, labels.b);
    put(out, labels.label_b);
    put(out, static_cast<std::uint8_t>(labels.kind));
    put(out, std::uint8_t{excluded});
  });
}

void Recorder::self_contact_set(BodyId body, bool wanted) noexcept {
  write([&](std::ostream& out) { put_value(out, RecordKind::self_contact, body, std::uint8_t{wanted}); });
}

void Recorder::state_restored(std::span<const std::byte> bytes) noexcept {
  write([&](std::ostream& out) {
    put(out, RecordKind::restore);
    put(out, std::uint64_t{bytes.size()});
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  });
}

void Recorder::step_begins() noexcept {
  write([](std::ostream& out) {
    put(out, RecordKind::detect);
    out.flush();
  });
}

void Recorder::step_ended(const Report& report) noexcept {
  write([&](std::ostream& out) {
    put(out, RecordKind::hash);
    put(out, report.hash());
    out.flush();
  });
}

void Recorder::step_failed() noexcept {
  write([](std::ostream& out) { put(out, RecordKind::failed); });
}

}  // namespace tact
