#include <tact/recording.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/floating_point_mode.h"
#include "engine/base/parallel.h"
#include "engine/bodies/columns.h"
#include "engine/failed_step.h"
#include "engine/recording/byte_reader.h"
#include "engine/recording/format.h"
#include "engine/with_memory.h"

namespace tact {

using recording::ByteReader, recording::EndOfBytes, recording::RecordKind;

namespace {

constexpr const char* kNoMemory = "playing a recording ran out of memory";

}  // namespace

struct RecordingPlayer::Implementation {
  Implementation(std::string_view bytes, const PlayOptions& given) : reader(bytes), options(given) {
    const base::FloatingPointMode mode;
    if (options.threads && (*options.threads < 0 || *options.threads > base::kMostThreads))
      throw Error(ErrorCode::invalid_argument, "threads is " + std::to_string(*options.threads) + ", not 0 to " +
                                                   std::to_string(base::kMostThreads));
    try {
      read_head(bytes);
      if (read_kind() != RecordKind::settings) fail("the first record is not one of settings");
      const Settings settings = read_settings();
      make([&] { world.emplace(settings); });
    } catch (const EndOfBytes&) {
      fail("the recording ends in its head");
    }
  }

  void read_head(std::string_view bytes) {
    if (!bytes.starts_with(recording::kMagic)) fail("not a recording: it does not begin with tactrec");
    reader.read_bytes(recording::kMagic.size());
    record = reader.position();
    version = reader.read<std::uint32_t>();
    if (version < 1 || version > recording::kVersion) {
      fail("a recording of version " + std::to_string(version) + "; versions 1 to " +
           std::to_string(recording::kVersion) + " can be read");
    }
    recorded_by = read_text();
  }

  std::optional<PlayedStep> next() {
    try {
      while (reader.bytes_left() > 0 && !cut_at) {
        const RecordKind kind = read_kind();
        if (kind == RecordKind::detect) return detect();
        play(kind);
      }
    } catch (const EndOfBytes&) {
      cut_at = record;
    } catch (...) {
      reader.go_back_to(record);
      throw;
    }
    return std::nullopt;
  }

  RecordKind read_kind() {
    record = reader.position();
    const auto kind = reader.read<std::uint8_t>();
    if (kind < 1 || kind > static_cast<std::uint8_t>(recording::kLastRecordKind))
      fail("no record is of kind " + std::to_string(kind));
    return static_cast<RecordKind>(kind);
  }

  // Makes the call of a record that is neither detect nor hash.
  void play(RecordKind kind) {
    switch (kind) {
      case RecordKind::settings: return set_settings();
      case RecordKind::add: return add_body();
      case RecordKind::bare: return read_bare();
      case RecordKind::plane: return add_plane();
      case RecordKind::remove: return remove_body();
      case RecordKind::positions: return set_positions();
      case RecordKind::facets: return set_facets();
      case RecordKind::poses: return set_poses();
      case RecordKind::layers: return set_layers();
      case RecordKind::group: return set_group();
      case RecordKind::excluded: return set_excluded();
      case RecordKind::motion: return set_motion();
      case RecordKind::margin: return set_margin();
      case RecordKind::rest_offset: return set_rest_offset();
      case RecordKind::features: return set_feature_settings();
      case RecordKind::neighbors: return set_self_contact_filter();
      case RecordKind::excluded_labels: return set_excluded_labels();
      case RecordKind::self_contact: return set_self_contact();
      case RecordKind::points: return add_output(&Outputs::points);
      case RecordKind::curves: return add_output(&Outputs::curves);
      case RecordKind::within_reach: return add_output(&Outputs::within_reach);
      case RecordKind::restore: return restore();
      case RecordKind::facet_map: next_facet_map = read_all<std::int32_t>(reader.read<std::uint64_t>()); return;
      case RecordKind::key: next_key = reader.read<std::uint64_t>(); return;
      case RecordKind::detect:
      case RecordKind::hash:
      case RecordKind::failed: break;
    }
    fail(kind == RecordKind::hash ? "a hash that follows no step" : "a failure that follows no step");
  }

  void set_settings() {
    const Settings settings = read_settings();
    make([&] { world->set_settings(settings); });
  }

  void add_output(bool Outputs::*output) {
    Settings settings = world->settings();
    settings.outputs.*output = true;
    make([&] { world->set_settings(settings); });
  }

  // Further outputs of PlayOptions are no part of the bytes: with them the next step looks at every pair.
  void restore() {
    const auto size = reader.read<std::uint64_t>();
    reader.require(size);
    const std::string_view bytes = reader.read_bytes(static_cast<std::size_t>(size));
    make([&] {
      world->restore(std::as_bytes(std::span(bytes)));
      for (const BodyId body : world->bodies()) world_number = body.world;
      Settings settings = world->settings();
      if (add_outputs(settings.outputs)) world->set_settings(settings);
    });
  }

  // Adds those of the options; returns whether any was not there.
  bool add_outputs(Outputs& outputs) const {
    bool added = false;
    for (bool Outputs::*const output : {&Outputs::zones, &Outputs::patches, &Outputs::points, &Outputs::curves,
                                        &Outputs::trace, &Outputs::within_reach}) {
      added |= options.outputs.*output && !(outputs.*output);
      outputs.*output |= options.outputs.*output;
    }
    return added;
  }

  // A step without a hash behind it had no answer.
  PlayedStep detect() {
    ByteReader ahead = reader;
    const auto behind = ahead.bytes_left() > 0 ? std::optional(ahead.read<std::uint8_t>()) : std::nullopt;
    const bool failed = behind == static_cast<std::uint8_t>(RecordKind::failed);
    report = &nothing;  // if the step fails
    report = failed ? &FailedStep::play(*world) : &world->detect();
    PlayedStep step{.number = steps, .byte = reader.position(), .recorded = {}, .now = report->hash()};
    ++steps;
    if (failed) {
      reader = ahead;
    } else if (behind == static_cast<std::uint8_t>(RecordKind::hash)) {
      if (ahead.bytes_left() < sizeof(std::uint64_t)) {
        cut_at = reader.position();
        return step;
      }
      step.byte = ahead.position();
      step.recorded = ahead.read<std::uint64_t>();
      reader = ahead;
    }
    return step;
  }

  void add_body() {
    const auto surface = read_enumeration(Surface::sheet);
    const auto motion = read_enumeration(Motion::rigid);
    const auto layer = reader.read<std::uint32_t>();
    const auto mask = reader.read<std::uint32_t>();
    const auto external_id = version < 4 ? std::uint64_t{0} : reader.read<std::uint64_t>();
    std::string name = read_text();
    const auto vertices = reader.read<std::uint64_t>();
    const auto facets = reader.read<std::uint64_t>();
    const std::vector<double> positions = read_columns<double>(vertices);
    const std::vector<int> corners = read_columns<std::int32_t>(facets);
    make([&] {
      world_number = world
                         ->add_body({.positions = columns_of<Positions>(positions),
                                     .facets = columns_of<Facets>(corners),
                                     .edges = columns_of<Edges>(next_edges),
                                     .points = next_points,
                                     .surface = surface,
                                     .motion = motion,
                                     .name = std::move(name),
                                     .layer = layer,
                                     .mask = mask,
                                     .external_id = external_id,
                                     .key = next_key})
                         .world;
    });
    next_key.reset();
    next_edges.clear();
    next_points.clear();
  }

  void read_bare() {
    const auto edges = reader.read<std::uint64_t>(), points = reader.read<std::uint64_t>();
    next_edges = read_columns<std::int32_t, 2>(edges);
    next_points = read_all<std::int32_t>(points);
  }

  void add_plane() {
    PlaneDefinition plane;
    for (double& coordinate : plane.normal) coordinate = reader.read<double>();
    plane.offset = reader.read<double>();
    plane.layer = reader.read<std::uint32_t>();
    plane.mask = reader.read<std::uint32_t>();
    plane.external_id = reader.read<std::uint64_t>();
    plane.name = read_text();
    plane.key = next_key;
    make([&] { world_number = world->add_plane(plane).world; });
    next_key.reset();
  }

  void remove_body() {
    const BodyId body = read_body();
    make([&] { world->remove_body(body); });
  }

  void set_positions() {
    constexpr std::size_t kSmallest = 16;  // bytes of a body without vertices
    const auto count = reader.read<std::uint64_t>();
    reader.require(count, kSmallest);
    std::vector<BodyId> bodies;
    std::vector<std::vector<double>> positions;
    for (std::uint64_t i = 0; i < count; ++i) {
      bodies.push_back(read_body());
      positions.push_back(read_columns<double>(reader.read<std::uint64_t>()));
    }
    std::vector<PositionsUpdate> updates;
    for (std::size_t i = 0; i < bodies.size(); ++i) updates.push_back({bodies[i], columns_of<Positions>(positions[i])});
    make([&] { world->set_positions(updates); });
  }

  void set_facets() {
    const BodyId body = read_body();
    const auto vertices = reader.read<std::uint64_t>(), facets = reader.read<std::uint64_t>();
    const std::vector<double> positions = read_columns<double>(vertices);
    const std::vector<int> corners = read_columns<std::int32_t>(facets);
    const std::vector<int> vertex_map = read_all<std::int32_t>(vertices);
    make([&] {
      world->set_facets(body, {.positions = columns_of<Positions>(positions),
                               .facets = columns_of<Facets>(corners),
                               .edges = columns_of<Edges>(next_edges),
                               .points = next_points,
                               .vertex_map = vertex_map,
                               .facet_map = next_facet_map});
    });
    next_edges.clear();
    next_points.clear();
    next_facet_map.clear();
  }

  void set_layers() {
    const BodyId body = read_body();
    const auto layer = reader.read<std::uint32_t>(), mask = reader.read<std::uint32_t>();
    make([&] { world->set_layers(body, layer, mask); });
  }

  void set_group() {
    const BodyId body = read_body();
    const auto group = reader.read<std::uint32_t>();
    make([&] { world->set_group(body, group); });
  }

  void set_excluded() {
    const BodyId a = read_body(), b = read_body();
    const bool excluded = read_flag();
    make([&] { world->set_excluded(a, b, excluded); });
  }

  void set_motion() {
    const BodyId body = read_body();
    const auto motion = read_enumeration(Motion::rigid);
    make([&] { world->set_motion(body, motion); });
  }

  void set_margin() {
    const BodyId body = read_body();
    const auto margin = reader.read<double>();
    make([&] { world->set_margin(body, margin); });
  }

  void set_rest_offset() {
    const BodyId body = read_body();
    const auto offset = reader.read<double>();
    const bool is_given = offset != recording::kAsMargin;
    make([&] { world->set_rest_offset(body, is_given ? std::optional(offset) : std::nullopt); });
  }

  void set_self_contact() {
    const BodyId body = read_body();
    const bool wanted = read_flag();
    make([&] { world->set_self_contact(body, wanted); });
  }

  void set_feature_settings() {
    const BodyId body = read_body();
    const std::size_t count = version < 8 ? 5 : 8;
    std::array<std::uint64_t, 8> counts{};
    for (std::size_t i = 0; i < count; ++i) counts[i] = reader.read<std::uint64_t>();
    const std::vector<double> rest_offsets = read_all<double>(counts[0]);
    std::array<std::vector<std::uint32_t>, 6> others;
    for (std::size_t i = 0; i < others.size(); ++i) others[i] = read_all<std::uint32_t>(counts[i + 1]);
    const std::vector<double> margins = read_all<double>(counts[7]);
    make([&] {
      world->set_feature_settings(body, {.rest_offsets = rest_offsets,
                                         .vertex_labels = others[0],
                                         .facet_labels = others[1],
                                         .vertex_layers = others[2],
                                         .vertex_masks = others[3],
                                         .facet_layers = others[4],
                                         .facet_masks = others[5],
                                         .margins = margins});
    });
  }

  void set_self_contact_filter() {
    const BodyId body = read_body();
    const auto rings = reader.read<std::int32_t>();
    const auto rest_distance = reader.read<double>();
    const std::vector<double> rest = read_columns<double>(reader.read<std::uint64_t>());
    make([&] {
      world->set_self_contact_filter(
          body, {.rings = rings, .rest_distance = rest_distance, .rest_positions = columns_of<Positions>(rest)});
    });
  }

  void set_excluded_labels() {
    LabelPair labels;
    labels.a = read_body();
    labels.label_a = reader.read<std::uint32_t>();
    labels.b = read_body();
    labels.label_b = reader.read<std::uint32_t>();
    labels.kind = read_enumeration(LabelKind::vertex);
    const bool excluded = read_flag();
    make([&] { world->set_excluded_labels(labels, excluded); });
  }

  void set_poses() {
    constexpr std::size_t kSize = 8 + 12 * sizeof(double);  // bytes of a pose
    const auto count = reader.read<std::uint64_t>();
    reader.require(count, kSize);
    std::vector<PoseUpdate> updates(static_cast<std::size_t>(count));
    for (PoseUpdate& update : updates) {
      update.body = read_body();
      for (double& entry : update.rotation.reshaped<Eigen::RowMajor>()) entry = reader.read<double>();
      for (double& entry : update.translation) entry = reader.read<double>();
    }
    make([&] { world->set_poses(updates); });
  }

  Settings read_settings() {
    Settings settings;
    settings.threads = reader.read<std::int32_t>();
    if (options.threads) settings.threads = *options.threads;
    settings.accuracy = read_enumeration(Accuracy::exact);
    settings.direction = read_enumeration(DirectionPolicy::smallest);
    settings.gjk_tolerance = reader.read<double>();
    settings.iteration_limit = reader.read<std::int32_t>();
    settings.outputs = options.outputs;
    settings.outputs.zones |= read_flag();
    settings.outputs.patches |= read_flag();
    return settings;
  }

  std::string read_text() { return std::string(reader.read_bytes(reader.read<std::uint32_t>())); }

  BodyId read_body() {
    const auto index = reader.read<std::uint32_t>();
    const auto generation = reader.read<std::uint32_t>();
    return {.index = index, .generation = generation, .world = world_number};
  }

  bool read_flag() {
    const auto value = reader.read<std::uint8_t>();
    if (value > 1) fail(std::to_string(value) + " is neither 0 nor 1");
    return value == 1;
  }

  template <class Enumeration>
  Enumeration read_enumeration(Enumeration last) {
    const auto value = reader.read<std::uint8_t>();
    if (value > static_cast<std::uint8_t>(last))
      fail(std::to_string(value) + " is not 0 to " + std::to_string(static_cast<int>(last)));
    return static_cast<Enumeration>(value);
  }

  template <class Number>
  std::vector<Number> read_all(std::uint64_t count) {
    reader.require(count, sizeof(Number));
    std::vector<Number> all(static_cast<std::size_t>(count));
    for (Number& one : all) one = reader.read<Number>();
    return all;
  }

  // `count` columns, one after the other: no matrices, whose memory Eigen aligns as the flags of each side say.
  template <class Number, std::size_t kRows = 3>
  std::vector<Number> read_columns(std::uint64_t count) {
    reader.require(count, kRows * sizeof(Number));
    return read_all<Number>(kRows * count);
  }

  // Calls call(); data that the world refuses are the recording's fault.
  template <class Call>
  void make(const Call& call) {
    try {
      call();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::out_of_memory || error.code() == ErrorCode::backend_failure) throw;
      fail(error.what());
    }
  }

  // Something is wrong with the record.
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::bad_recording, "byte " + std::to_string(record) + ": " +
                                              (world ? "step " + std::to_string(steps) + ": " : std::string()) +
                                              message);
  }

  std::unique_ptr<const std::string> kept = {};  // what is read, if it was given away
  ByteReader reader;
  PlayOptions options;
  std::uint32_t version = 0;
  std::size_t record = 0;  // the byte at which the record begins that is being read
  std::optional<std::size_t> cut_at = {};
  std::string recorded_by = {};
  std::optional<World> world = {};
  std::uint32_t world_number = 0;                                           // that ids carry; known from the first body
  std::optional<std::uint64_t> next_key = {};                               // of the body that is added next
  std::vector<int> next_edges = {}, next_points = {}, next_facet_map = {};  // likewise
  int steps = 0;
  const Report nothing = {};
  const Report* report = &nothing;
};

RecordingPlayer::RecordingPlayer(std::string_view bytes, const PlayOptions& options)
    : implementation_(with_memory(kNoMemory, [&] { return std::make_unique<Implementation>(bytes, options); })) {}
RecordingPlayer::RecordingPlayer(std::unique_ptr<const std::string> bytes, const PlayOptions& options)
    : RecordingPlayer(std::string_view(*bytes), options) {
  implementation_->kept = std::move(bytes);
}
RecordingPlayer::~RecordingPlayer() = default;
RecordingPlayer::RecordingPlayer(RecordingPlayer&&) noexcept = default;
RecordingPlayer& RecordingPlayer::operator=(RecordingPlayer&&) noexcept = default;

std::optional<PlayedStep> RecordingPlayer::next() {
  const base::FloatingPointMode mode;
  return with_memory(kNoMemory, [&] { return implementation_->next(); });
}
std::optional<std::size_t> RecordingPlayer::cut_at() const { return implementation_->cut_at; }
World& RecordingPlayer::world() { return *implementation_->world; }
const Report& RecordingPlayer::report() const { return *implementation_->report; }
const std::string& RecordingPlayer::recorded_by() const { return implementation_->recorded_by; }

}  // namespace tact
