/// Observers of a world: see World::set_observer().
#pragma once

#include <tact/body.h>
#include <tact/report.h>
#include <tact/settings.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace tact {

struct MeshUpdate;
struct PositionsUpdate;
struct PoseUpdate;

/// Sees all mutating calls of a world. Each function is called on the thread of the call, once it has succeeded.
/// Arguments are valid during the call. No function may throw or call the world.
class TACT_API WorldObserver {
 public:
  virtual ~WorldObserver();

  /// Called when the observer is set, and when settings change.
  virtual void settings_changed(const Settings& settings) noexcept;
  virtual void body_added(BodyId body, const BodyDefinition& definition) noexcept;
  virtual void plane_added(BodyId body, const PlaneDefinition& definition) noexcept;
  virtual void body_removed(BodyId body) noexcept;
  virtual void positions_set(std::span<const PositionsUpdate> updates) noexcept;
  virtual void facets_set(BodyId body, const MeshUpdate& update) noexcept;
  virtual void poses_set(std::span<const PoseUpdate> updates) noexcept;
  virtual void layers_set(BodyId body, std::uint32_t layer, std::uint32_t mask) noexcept;
  virtual void group_set(BodyId body, std::uint32_t group) noexcept;
  virtual void excluded_set(BodyId a, BodyId b, bool excluded) noexcept;
  virtual void motion_set(BodyId body, Motion motion) noexcept;
  virtual void margin_set(BodyId body, double margin) noexcept;
  virtual void rest_offset_set(BodyId body, std::optional<double> rest_offset) noexcept;
  virtual void feature_settings_set(BodyId body, const FeatureSettings& settings) noexcept;
  virtual void self_contact_set(BodyId body, bool wanted) noexcept;
  virtual void self_contact_filter_set(BodyId body, const SelfContactFilter& filter) noexcept;
  virtual void excluded_labels_set(const LabelPair& labels, bool excluded) noexcept;
  /// Called when World::restore() has set the settings and bodies of the bytes.
  virtual void state_restored(std::span<const std::byte> bytes) noexcept;

  /// Called before World::detect() begins.
  virtual void step_begins() noexcept;
  /// Called when World::detect() has an answer; not if it throws.
  virtual void step_ended(const Report& report) noexcept;
  /// Called when World::detect() throws: the next step starts from scratch.
  virtual void step_failed() noexcept;
};

}  // namespace tact
