/// Recordings: everything that entered a world and the hash of what it answered, to run it again later. `tact replay`
/// plays them, too; one is what a bug report should hold.
///
///     std::ofstream file("engine.tactrec", std::ios::binary);
///     tact::Recorder recorder(file);
///     world.set_observer(&recorder);  // before the first body is added
#pragma once

#include <tact/world.h>
#include <tact/world_observer.h>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace tact {

/// Writes a recording while a world is used. The input of a step is flushed before the step begins, so a program that
/// dies leaves all that led there. Its answers are the same with and without a recorder.
class TACT_API Recorder final : public WorldObserver {
 public:
  /// Writes the head. `out` must outlive the recorder, which in turn outlives the world or is taken away from it first.
  /// Whether `out` took all is for its owner to ask at the end.
  explicit Recorder(std::ostream& out);

  /// What writing took in all, milliseconds.
  double writing_ms() const { return writing_ms_; }

  void settings_changed(const Settings& settings) noexcept override;
  void body_added(BodyId body, const BodyDefinition& definition) noexcept override;
  void body_removed(BodyId body) noexcept override;
  void positions_set(std::span<const PositionsUpdate> updates) noexcept override;
  void poses_set(std::span<const PoseUpdate> updates) noexcept override;
  void layers_set(BodyId body, std::uint32_t layer, std::uint32_t mask) noexcept override;
  void group_set(BodyId body, std::uint32_t group) noexcept override;
  void excluded_set(BodyId a, BodyId b, bool excluded) noexcept override;
  void motion_set(BodyId body, Motion motion) noexcept override;
  void margin_set(BodyId body, double margin) noexcept override;
  void self_contact_set(BodyId body, bool wanted) noexcept override;
  void step_begins() noexcept override;
  void step_ended(const Report& report) noexcept override;

 private:
  // Calls write(stream) and counts its time; where it throws, the stream is bad from then on.
  template <class Write>
  void write(const Write& write) noexcept;

  std::ostream& out_;
  double writing_ms_ = 0.0;
};

/// A step that was run again.
struct PlayedStep {
  int number = 0;        ///< from 0
  std::size_t byte = 0;  ///< where its hash stands in the recording; its size if there is none
  /// Hash of the report then. None if the step had no answer: it failed, or the program ended in it.
  std::optional<std::uint64_t> recorded;
  std::uint64_t now = 0;  ///< hash of the report now
  bool same() const { return recorded == now; }
};

/// How a recording is run again.
struct PlayOptions {
  std::optional<int> threads = {};  ///< in place of those of the recording
  Outputs outputs = {};             ///< besides those of the recording; zones and points change the hashes
};

/// Runs a recording again, step by step. It takes memory for what the recording holds, never for what it promises.
class TACT_API RecordingPlayer {
 public:
  /// Reads the head of `bytes`, which must outlive the player. Errors: bad_recording, with the byte.
  explicit RecordingPlayer(std::string_view bytes, const PlayOptions& options = {});
  ~RecordingPlayer();
  RecordingPlayer(RecordingPlayer&&) noexcept;
  RecordingPlayer& operator=(RecordingPlayer&&) noexcept;

  /// Makes the calls up to the next detect(), and that one; nothing at the end of the recording, or of what is whole of
  /// it: see cut_at(). Calls after the last detect() are made too.
  /// Errors: bad_recording, with byte and step, for what is no recording or what the world refuses; and those of
  /// detect().
  std::optional<PlayedStep> next();

  /// Where the record begins that the end of a recording cuts off: that of a program that was killed, say. Known once
  /// next() has returned nothing; none if the recording is whole.
  std::optional<std::size_t> cut_at() const;

  /// The world that the calls are made in: to look at, or to ask for more than the recording's program did. Calls that
  /// change it change what the steps find. An observer that is set before the first next() is told of every body.
  World& world();
  /// The report of the step that next() made last; before it has, an empty one.
  const Report& report() const;
  /// The version of tact that wrote the recording.
  const std::string& recorded_by() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tact
