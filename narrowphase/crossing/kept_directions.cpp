#include "narrowphase/crossing/kept_directions.h"

#include <algorithm>
#include <cstddef>

namespace tact::narrowphase {

namespace {

Vec3 mean(Vec3 sum, int count) { return count > 0 && norm(sum) > kAgree * count ? normalized(sum) : Vec3{}; }

}  // namespace

bool KeptDirections::may_be(const Crossing& c) {
  const auto any_left = [](const CrossedSurface& surface, std::span<const CarriedNormal> carried) {
    return std::ranges::any_of(
        carried, [&](const CarriedNormal& one) { return one.gap < 0.0 && !surface.cut.is_past(one.vertex); });
  };
  return any_left(c.a(), c.carried.of_a) || any_left(c.b(), c.carried.of_b) ||
         std::ranges::any_of(c.carried.of_edges, [](const FeaturePoint& one) { return one.gap < 0.0; });
}

void KeptDirections::take(int group, Vec3 normal, double gap, bool is_past) {
  if (group < 0 && is_past) return;
  Sum& sum = group < 0 ? sums_.back() : sums_[static_cast<std::size_t>(group)];
  if (gap < 0.0) {
    sum.of_past = sum.of_past + normal;
    ++sum.past;
    sum.goes_on = sum.goes_on || is_past;
  } else {
    sum.of_others = sum.of_others + normal;
    ++sum.others;
  }
}

void KeptDirections::find(const Crossing& c, const CrossingGroups& groups) {
  sums_.assign(static_cast<std::size_t>(groups.count()) + 1, {});
  const auto take_all = [&](const CrossedSurface& surface, std::span<const CarriedNormal> carried) {
    for (const CarriedNormal& one : carried)
      take(groups.group_of(surface, one.vertex), one.normal, one.gap, surface.cut.is_past(one.vertex));
  };
  take_all(c.a(), c.carried.of_a);
  take_all(c.b(), c.carried.of_b);
  for (const FeaturePoint& one : c.carried.of_edges) take(groups.group_of(one), one.normal, one.gap, false);
}

Vec3 KeptDirections::came(int group) const {
  const Sum& sum = sums_[static_cast<std::size_t>(group)];
  if (sum.past > 0) return mean(sum.of_past, sum.past);
  if (sum.others > 0) return mean(sum.of_others, sum.others);
  return mean(sums_.back().of_past, sums_.back().past);
}

Vec3 KeptDirections::kept(int group) const {
  const Sum& sum = sums_[static_cast<std::size_t>(group)];
  return sum.goes_on ? Vec3{} : mean(sum.of_past, sum.past);
}

void KeptDirections::give(const CrossingGroups& groups, CrossedSurface& surface) const {
  surface.kept.resize(static_cast<std::size_t>(surface.cut.patch_count()));
  for (int patch = 0; patch < surface.cut.patch_count(); ++patch) {
    const int group = groups.group_of_patch(surface, patch);
    surface.kept[static_cast<std::size_t>(patch)] = group < 0 ? Vec3{} : kept(group);
  }
}

}  // namespace tact::narrowphase
