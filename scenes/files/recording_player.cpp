#include "scenes/files/recording_player.h"

#include <fmt/format.h>

#include <bit>
#include <utility>

namespace tact::scenes {

RecordingPlayer::RecordingPlayer(std::string_view bytes, std::string file, std::optional<int> threads)
    : size_(bytes.size()), file_(file), reader_(bytes, std::move(file), 0, std::endian::little), threads_(threads) {
  read_head(bytes);
  if (read_kind() != RecordKind::settings) fail_record("the first record is not one of settings");
  const Settings settings = read_settings();
  make([&] { world_.emplace(settings); });
}

void RecordingPlayer::read_head(std::string_view bytes) {
  if (!bytes.starts_with(kRecordingMagic)) fail_record("not a recording: it does not begin with tactrec");
  reader_.skip(kRecordingMagic.size());
  const auto version = reader_.read<std::uint32_t>();
  if (version < 1 || version > kRecordingVersion) {
    reader_.fail(fmt::format("a recording of version {}; versions 1 to {} can be read", version, kRecordingVersion));
  }
  recorded_by_ = read_text();
}

std::optional<PlayedStep> RecordingPlayer::next() {
  while (reader_.bytes_left() > 0) {
    reader_.set_item("step", steps_);
    const RecordKind kind = read_kind();
    if (kind == RecordKind::detect) return detect();
    play(kind);
  }
  return std::nullopt;
}

RecordKind RecordingPlayer::read_kind() {
  record_ = position();
  const auto kind = reader_.read<std::uint8_t>();
  if (kind < static_cast<std::uint8_t>(RecordKind::settings) || kind > static_cast<std::uint8_t>(RecordKind::points)) {
    reader_.fail(fmt::format("no record is of kind {}", kind));
  }
  return static_cast<RecordKind>(kind);
}

void RecordingPlayer::play(RecordKind kind) {
  switch (kind) {
    case RecordKind::settings: {
      const Settings settings = read_settings();
      return make([&] { world_->set_settings(settings); });
    }
    case RecordKind::add: return add_body();
    case RecordKind::remove: {
      const BodyId body = read_body();
      return make([&] { world_->remove_body(body); });
    }
    case RecordKind::positions: return set_positions();
    case RecordKind::layers: {
      const BodyId body = read_body();
      const auto layer = reader_.read<std::uint32_t>(), mask = reader_.read<std::uint32_t>();
      return make([&] { world_->set_layers(body, layer, mask); });
    }
    case RecordKind::motion: {
      const BodyId body = read_body();
      const auto motion = read_enumeration(Motion::fixed);
      return make([&] { world_->set_motion(body, motion); });
    }
    case RecordKind::margin: {
      const BodyId body = read_body();
      const auto margin = reader_.read<double>();
      return make([&] { world_->set_margin(body, margin); });
    }
    case RecordKind::self_contact: {
      const BodyId body = read_body();
      const bool wanted = read_flag();
      return make([&] { world_->set_self_contact(body, wanted); });
    }
    case RecordKind::points: {
      Settings settings = world_->settings();
      settings.outputs.points = true;
      return make([&] { world_->set_settings(settings); });
    }
    case RecordKind::detect:
    case RecordKind::hash: break;
  }
  fail_record("a hash that follows no step");
}

PlayedStep RecordingPlayer::detect() {
  const std::uint64_t now = world_->detect().hash();
  if (reader_.bytes_left() == 0 || read_kind() != RecordKind::hash) {
    fail_record("the step has no hash: what recorded it ended in it");
  }
  const std::size_t byte = position();
  return {.number = steps_++, .byte = byte, .recorded = reader_.read<std::uint64_t>(), .now = now};
}

void RecordingPlayer::add_body() {
  const auto surface = read_enumeration(Surface::sheet);
  const auto motion = read_enumeration(Motion::fixed);
  const auto layer = reader_.read<std::uint32_t>();
  const auto mask = reader_.read<std::uint32_t>();
  std::string name = read_text();
  const std::size_t vertices = read_count("vertices", 3 * sizeof(double));
  const std::size_t facets = read_count("facets", 3 * sizeof(std::int32_t));
  const Eigen::Matrix3Xd positions = read_columns<double>(vertices);
  const Eigen::Matrix3Xi corners = read_columns<std::int32_t>(facets);
  make([&] {
    world_number_ = world_
                        ->add_body({.positions = positions,
                                    .facets = corners,
                                    .surface = surface,
                                    .motion = motion,
                                    .name = std::move(name),
                                    .layer = layer,
                                    .mask = mask})
                        .world;
  });
}

void RecordingPlayer::set_positions() {
  constexpr std::size_t kSmallest = 16;  // bytes of a body without vertices
  const std::size_t count = read_count("bodies", kSmallest);
  std::vector<BodyId> bodies;
  std::vector<Eigen::Matrix3Xd> positions;
  for (std::size_t i = 0; i < count; ++i) {
    bodies.push_back(read_body());
    positions.push_back(read_columns<double>(read_count("vertices", 3 * sizeof(double))));
  }
  std::vector<PositionsUpdate> updates;
  for (std::size_t i = 0; i < count; ++i) updates.push_back({bodies[i], positions[i]});
  make([&] { world_->set_positions(updates); });
}

Settings RecordingPlayer::read_settings() {
  Settings settings;
  settings.threads = reader_.read<std::int32_t>();
  if (threads_) settings.threads = *threads_;
  settings.accuracy = read_enumeration(Accuracy::exact);
  settings.direction = read_enumeration(DirectionPolicy::smallest);
  settings.gjk_tolerance = reader_.read<double>();
  settings.iteration_limit = reader_.read<std::int32_t>();
  settings.outputs.zones = read_flag();
  settings.outputs.patches = read_flag();
  return settings;
}

std::string RecordingPlayer::read_text() {
  const auto size = reader_.read<std::uint32_t>();
  if (size > reader_.bytes_left()) {
    reader_.fail(fmt::format("promises a text of {} bytes, but the file has {} more", size, reader_.bytes_left()));
  }
  std::string text(size, '\0');
  for (char& c : text) c = reader_.read<char>();
  return text;
}

BodyId RecordingPlayer::read_body() {
  const auto index = reader_.read<std::uint32_t>();
  const auto generation = reader_.read<std::uint32_t>();
  return {.index = index, .generation = generation, .world = world_number_};
}

bool RecordingPlayer::read_flag() {
  const auto value = reader_.read<std::uint8_t>();
  if (value > 1) reader_.fail(fmt::format("{} is neither 0 nor 1", value));
  return value == 1;
}

template <class Enumeration>
Enumeration RecordingPlayer::read_enumeration(Enumeration last) {
  const auto value = reader_.read<std::uint8_t>();
  if (value > static_cast<std::uint8_t>(last)) {
    reader_.fail(fmt::format("{} is not 0 to {}", value, static_cast<int>(last)));
  }
  return static_cast<Enumeration>(value);
}

std::size_t RecordingPlayer::read_count(const char* things, std::size_t size) {
  const auto count = reader_.read<std::uint64_t>();
  if (count > reader_.bytes_left() / size) {
    reader_.fail(fmt::format("promises {} {}, which take at least {} bytes each, but the file has {} more", count,
                             things, size, reader_.bytes_left()));
  }
  return static_cast<std::size_t>(count);
}

template <class Number>
Eigen::Matrix<Number, 3, Eigen::Dynamic> RecordingPlayer::read_columns(std::size_t count) {
  Eigen::Matrix<Number, 3, Eigen::Dynamic> columns(3, static_cast<Eigen::Index>(count));
  for (Number& value : columns.reshaped()) value = reader_.read<Number>();
  return columns;
}

template <class Call>
void RecordingPlayer::make(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::out_of_memory || error.code() == ErrorCode::backend_failure) throw;
    constexpr std::size_t kLongest = 300;
    fail_record(printable(error.what(), kLongest));  // it may hold the name of a body
  }
}

void RecordingPlayer::fail_record(const std::string& message) const {
  const std::string step = world_ ? fmt::format("step {}: ", steps_) : std::string();
  throw FileError(fmt::format("{}: byte {}: {}{}", file_, record_, step, message));
}

}  // namespace tact::scenes
