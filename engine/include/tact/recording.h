/// Recordings: all that entered a world and the hash of its answers, to run it again.
///
///     std::ofstream file("engine.tactrec", std::ios::binary);
///     tact::Recorder recorder(file);
///     tact::World world;              // goes before the recorder does
///     world.set_observer(&recorder);  // before the first body is added
#pragma once

#include <tact/world.h>
#include <tact/world_observer.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tact {

/// Writes a recording while a world is used. The input of a step is flushed before the step. The answers do not depend
/// on it.
class TACT_API Recorder final : public WorldObserver {
 public:
  /// Writes the head. `out` outlives the recorder; its owner checks whether it took all.
  explicit Recorder(std::ostream& out);

  /// Returns the time of all writing, milliseconds.
  double writing_ms() const { return writing_ms_; }

  void settings_changed(const Settings& settings) noexcept override;
  void body_added(BodyId body, const BodyDefinition& definition) noexcept override;
  void plane_added(BodyId body, const PlaneDefinition& definition) noexcept override;
  void body_removed(BodyId body) noexcept override;
  void positions_set(std::span<const PositionsUpdate> updates) noexcept override;
  void facets_set(BodyId body, const MeshUpdate& update) noexcept override;
  void poses_set(std::span<const PoseUpdate> updates) noexcept override;
  void layers_set(BodyId body, std::uint32_t layer, std::uint32_t mask) noexcept override;
  void group_set(BodyId body, std::uint32_t group) noexcept override;
  void excluded_set(BodyId a, BodyId b, bool excluded) noexcept override;
  void motion_set(BodyId body, Motion motion) noexcept override;
  void margin_set(BodyId body, double margin) noexcept override;
  void rest_offset_set(BodyId body, std::optional<double> rest_offset) noexcept override;
  void feature_settings_set(BodyId body, const FeatureSettings& settings) noexcept override;
  void self_contact_set(BodyId body, bool wanted) noexcept override;
  void self_contact_filter_set(BodyId body, const SelfContactFilter& filter) noexcept override;
  void excluded_labels_set(const LabelPair& labels, bool excluded) noexcept override;
  void state_restored(std::span<const std::byte> bytes) noexcept override;
  void step_begins() noexcept override;
  void step_ended(const Report& report) noexcept override;
  void step_failed() noexcept override;

 private:
  // Calls write(stream) and adds up its time; an exception makes the stream bad.
  template <class Write>
  void write(const Write& write) noexcept;

  std::ostream& out_;
  double writing_ms_ = 0.0;
};

/// A step that was run again. After one that failed the next starts from scratch, as it did.
struct PlayedStep {
  int number = 0;        ///< counted from 0
  std::size_t byte = 0;  ///< where its hash stands in the recording, or the size of the recording
  /// The hash of the recorded report. None if the step failed or the program ended in it.
  std::optional<std::uint64_t> recorded;
  std::uint64_t now = 0;  ///< the hash of the report now
  /// Whether both hashes are equal.
  bool same() const { return recorded == now; }
};

/// How a recording is run again.
struct PlayOptions {
  std::optional<int> threads = {};  ///< used in place of those of the recording
  Outputs outputs = {};             ///< added to those of the recording; zones and points change the hashes
};

/// Runs a recording again, step by step. One that was moved to another can only be assigned to and destroyed.
class TACT_API RecordingPlayer {
 public:
  /// Reads the head of `bytes`, which outlives the player. Errors: bad_recording, invalid_argument
  /// (PlayOptions::threads is not 0 to 1024), out_of_memory.
  explicit RecordingPlayer(std::string_view bytes, const PlayOptions& options = {});
  /// The same of a string that is given away: the player keeps it.
  template <std::same_as<std::string> Bytes>
  explicit RecordingPlayer(Bytes&& bytes, const PlayOptions& options = {});
  ~RecordingPlayer();
  RecordingPlayer(RecordingPlayer&&) noexcept;
  RecordingPlayer& operator=(RecordingPlayer&&) noexcept;

  /// Runs the calls up to and with the next step. Returns nothing at the end. Errors: bad_recording, and those of
  /// World::detect(); the next call makes the call that failed again.
  std::optional<PlayedStep> next();

  /// Returns the byte of the record that the end of the recording cuts off. None if the recording is whole, or next()
  /// has not come to its end.
  std::optional<std::size_t> cut_at() const;

  /// Returns the world that the calls are made in.
  World& world();
  /// Returns the report of the last step; empty before the first.
  const Report& report() const;
  /// Returns the version of tact that wrote the recording.
  const std::string& recorded_by() const;

 private:
  struct Implementation;
  RecordingPlayer(std::unique_ptr<const std::string> bytes, const PlayOptions& options);
  std::unique_ptr<Implementation> implementation_;
};

template <std::same_as<std::string> Bytes>
RecordingPlayer::RecordingPlayer(Bytes&& bytes, const PlayOptions& options)
    : RecordingPlayer(std::make_unique<const std::string>(std::move(bytes)), options) {}

}  // namespace tact
