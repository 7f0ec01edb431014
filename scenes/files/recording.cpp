#include "scenes/files/recording.h"

#include <array>
#include <bit>
#include <type_traits>

#include "engine/base/timer.h"

namespace tact::scenes {
namespace {

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
template <class Scalar>
void put_columns(std::ostream& out, const Columns<Scalar>& columns) {
  for (std::ptrdiff_t i = 0; i < columns.cols(); ++i) {
    const std::array<Scalar, 3> column = columns.column(i);
    out.write(reinterpret_cast<const char*>(column.data()), sizeof column);
  }
}

void put_settings(std::ostream& out, const Settings& settings) {
  put(out, RecordKind::settings);
  put(out, std::int32_t{settings.threads});
  put(out, static_cast<std::uint8_t>(settings.accuracy));
  put(out, static_cast<std::uint8_t>(settings.direction));
  put(out, settings.gjk_tolerance);
  put(out, std::int32_t{settings.iteration_limit});
  put(out, std::uint8_t{settings.outputs.zones});
  put(out, std::uint8_t{settings.outputs.patches});
  if (settings.outputs.points) put(out, RecordKind::points);
}

void put_addition(std::ostream& out, const BodyDefinition& body) {
  put(out, RecordKind::add);
  put(out, static_cast<std::uint8_t>(body.surface));
  put(out, static_cast<std::uint8_t>(body.motion));
  put(out, body.layer);
  put(out, body.mask);
  put_text(out, body.name);
  put(out, static_cast<std::uint64_t>(body.positions.cols()));
  put(out, static_cast<std::uint64_t>(body.facets.cols()));
  put_columns(out, body.positions);
  put_columns(out, body.facets);
}

void put_margin(std::ostream& out, BodyId body, double margin) {
  put(out, RecordKind::margin);
  put_body(out, body);
  put(out, margin);
}

void put_self_contact(std::ostream& out, BodyId body, bool wanted) {
  put(out, RecordKind::self_contact);
  put_body(out, body);
  put(out, std::uint8_t{wanted});
}

void put_positions(std::ostream& out, std::span<const PositionsUpdate> updates) {
  put(out, RecordKind::positions);
  put(out, std::uint64_t{updates.size()});
  for (const PositionsUpdate& update : updates) {
    put_body(out, update.body);
    put(out, static_cast<std::uint64_t>(update.positions.cols()));
    put_columns(out, update.positions);
  }
}

}  // namespace

template <class Write>
void RecordedWorld::record(const Write& write) {
  if (recording_ == nullptr) return;
  base::Timer timer;
  write(*recording_);
  writing_ms_ += timer.lap();
}

RecordedWorld::RecordedWorld(const Settings& settings, std::ostream* recording)
    : world_(settings), recording_(recording) {
  record([&](std::ostream& out) {
    out.write(kRecordingMagic.data(), static_cast<std::streamsize>(kRecordingMagic.size()));
    put(out, kRecordingVersion);
    put_text(out, TACT_VERSION);
    put_settings(out, settings);
  });
}

void RecordedWorld::set_settings(const Settings& settings) {
  world_.set_settings(settings);
  record([&](std::ostream& out) { put_settings(out, settings); });
}

BodyId RecordedWorld::add_body(const BodyDefinition& definition) {
  const BodyId body = world_.add_body(definition);
  record([&](std::ostream& out) {
    put_addition(out, definition);
    if (definition.margin != 0.0) put_margin(out, body, definition.margin);
    if (definition.self_contact) put_self_contact(out, body, true);
  });
  return body;
}

void RecordedWorld::remove_body(BodyId body) {
  world_.remove_body(body);
  record([&](std::ostream& out) {
    put(out, RecordKind::remove);
    put_body(out, body);
  });
}

void RecordedWorld::set_positions(BodyId body, const Positions& positions) {
  world_.set_positions(body, positions);
  record([&](std::ostream& out) { put_positions(out, std::array{PositionsUpdate{body, positions}}); });
}

void RecordedWorld::set_positions(std::span<const PositionsUpdate> updates) {
  world_.set_positions(updates);
  record([&](std::ostream& out) { put_positions(out, updates); });
}

void RecordedWorld::set_layers(BodyId body, std::uint32_t layer, std::uint32_t mask) {
  world_.set_layers(body, layer, mask);
  record([&](std::ostream& out) {
    put(out, RecordKind::layers);
    put_body(out, body);
    put(out, layer);
    put(out, mask);
  });
}

void RecordedWorld::set_motion(BodyId body, Motion motion) {
  world_.set_motion(body, motion);
  record([&](std::ostream& out) {
    put(out, RecordKind::motion);
    put_body(out, body);
    put(out, static_cast<std::uint8_t>(motion));
  });
}

void RecordedWorld::set_margin(BodyId body, double margin) {
  world_.set_margin(body, margin);
  record([&](std::ostream& out) { put_margin(out, body, margin); });
}

void RecordedWorld::set_self_contact(BodyId body, bool wanted) {
  world_.set_self_contact(body, wanted);
  record([&](std::ostream& out) { put_self_contact(out, body, wanted); });
}

const Report& RecordedWorld::detect() {
  record([](std::ostream& out) {
    put(out, RecordKind::detect);
    out.flush();
  });
  const Report& report = world_.detect();
  record([&](std::ostream& out) {
    put(out, RecordKind::hash);
    put(out, report.hash());
    out.flush();
  });
  return report;
}

}  // namespace tact::scenes
