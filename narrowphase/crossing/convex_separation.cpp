#include "narrowphase/crossing/convex_separation.h"

#include <algorithm>

#include "narrowphase/crossing/convex.h"

namespace tact::narrowphase {

namespace {

// The points led out if one of so many is in still, at most: bodies that move otherwise change their vertices slowly.
constexpr std::size_t kMostOut = 3;

}  // namespace

void ConvexSeparation::find(const Crossing& c) {
  clear();
  crossing_ = &c;
  Vec3 sum;
  std::size_t count = 0, still_past = 0, past = 0;
  double least_along = 1.0;
  const auto take = [&](Vec3 normal) {
    sum = sum + normal;
    ++count;
    least_along = std::min(least_along, dot(normal, c.direction));
  };
  const auto take_all = [&](const CrossedSurface& surface, std::span<const CarriedNormal> carried) {
    past += surface.cut.past().size();
    for (const CarriedNormal& one : carried) {
      if (one.gap >= 0.0) continue;
      take(one.normal);
      still_past += surface.cut.is_past(one.vertex) ? 1 : 0;
    }
  };
  take_all(c.a(), c.carried.of_a);
  take_all(c.b(), c.carried.of_b);
  for (const FeaturePoint& one : c.carried.of_edges) {
    if (one.gap < 0.0) take(one.normal);
  }
  if (count == 0 || past == still_past || kMostOut * still_past > count) return;
  const bool agree = norm(sum) > kAgree * static_cast<double>(count);
  direction_ = agree ? normalized(sum) : c.direction;
  leads_all_ = !agree && least_along < kSameSide && are_convex();
}

bool ConvexSeparation::are_convex() {
  if (!are_convex_) are_convex_ = is_convex(crossing_->a().scaled()) && is_convex(crossing_->b().scaled());
  return *are_convex_;
}

}  // namespace tact::narrowphase
