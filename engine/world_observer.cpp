#include <tact/world_observer.h>

namespace tact {

WorldObserver::~WorldObserver() = default;
void WorldObserver::settings_changed(const Settings&) noexcept {}
void WorldObserver::body_added(BodyId, const BodyDefinition&) noexcept {}
void WorldObserver::plane_added(BodyId, const PlaneDefinition&) noexcept {}
void WorldObserver::body_removed(BodyId) noexcept {}
void WorldObserver::positions_set(std::span<const PositionsUpdate>) noexcept {}
void WorldObserver::facets_set(BodyId, const MeshUpdate&) noexcept {}
void WorldObserver::poses_set(std::span<const PoseUpdate>) noexcept {}
void WorldObserver::layers_set(BodyId, std::uint32_t, std::uint32_t) noexcept {}
void WorldObserver::group_set(BodyId, std::uint32_t) noexcept {}
void WorldObserver::excluded_set(BodyId, BodyId, bool) noexcept {}
void WorldObserver::motion_set(BodyId, Motion) noexcept {}
void WorldObserver::margin_set(BodyId, double) noexcept {}
void WorldObserver::rest_offset_set(BodyId, std::optional<double>) noexcept {}
void WorldObserver::feature_settings_set(BodyId, const FeatureSettings&) noexcept {}
void WorldObserver::self_contact_set(BodyId, bool) noexcept {}
void WorldObserver::self_contact_filter_set(BodyId, const SelfContactFilter&) noexcept {}
void WorldObserver::excluded_labels_set(const LabelPair&, bool) noexcept {}
void WorldObserver::state_restored(std::span<const std::byte>) noexcept {}
void WorldObserver::step_begins() noexcept {}
void WorldObserver::step_ended(const Report&) noexcept {}
void WorldObserver::step_failed() noexcept {}

}  // namespace tact
