/// Who is told of everything that enters a world: see World::set_observer().
#pragma once

#include <tact/body.h>
#include <tact/report.h>
#include <tact/settings.h>

#include <cstdint>
#include <span>

namespace tact {

struct PositionsUpdate;
struct PoseUpdate;

/// Each function is called on the thread that called the world, once that call has succeeded; what a world refuses is
/// not told. What the arguments point to is valid during the call. None may throw, nor call the world.
class TACT_API WorldObserver {
 public:
  virtual ~WorldObserver();

  /// The settings when the observer is set, and whenever they change.
  virtual void settings_changed(const Settings& settings) noexcept;
  virtual void body_added(BodyId body, const BodyDefinition& definition) noexcept;
  virtual void body_removed(BodyId body) noexcept;
  virtual void positions_set(std::span<const PositionsUpdate> updates) noexcept;
  virtual void poses_set(std::span<const PoseUpdate> updates) noexcept;
  virtual void layers_set(BodyId body, std::uint32_t layer, std::uint32_t mask) noexcept;
  virtual void group_set(BodyId body, std::uint32_t group) noexcept;
  virtual void excluded_set(BodyId a, BodyId b, bool excluded) noexcept;
  virtual void motion_set(BodyId body, Motion motion) noexcept;
  virtual void margin_set(BodyId body, double margin) noexcept;
  virtual void self_contact_set(BodyId body, bool wanted) noexcept;

  /// Before World::detect() begins, and when it has an answer; step_ended() is not called where it throws.
  virtual void step_begins() noexcept;
  virtual void step_ended(const Report& report) noexcept;
};

}  // namespace tact
