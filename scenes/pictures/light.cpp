#include "scenes/pictures/light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace tact::scenes {
namespace {

constexpr float kSunRadius = 0.07f;  // tangent of half the angle under which the sun is seen
constexpr float kReach = 0.5f;       // how far blockers darken the sky, in units of the drawn scene
const Light kZenith{0.56f, 0.63f, 0.72f};
const Light kHorizon{0.44f, 0.47f, 0.51f};
const Light kFloor{0.36f, 0.35f, 0.33f};

}  // namespace

Lights::Lights(const DrawnScene& scene)
    : scene_(scene),
      sun_((1.15f * scene.up - 0.75f * scene.right.normalized() -
            0.62f * (scene.forward - scene.up.dot(scene.forward) * scene.up).normalized())
               .normalized()),
      across_sun_(tangents(sun_)) {}

Light Lights::open_sky() const { return kHorizon + 2.0f / 3.0f * (kZenith - kHorizon); }

bool Lights::near_sky(const Eigen::Vector3f& place) const {
  const float reach = scene_.radius + kReach;
  return (place - scene_.middle).squaredNorm() <= reach * reach;
}

bool Lights::near_sun(const Eigen::Vector3f& place) const {
  const Eigen::Vector3f from_middle = place - scene_.middle;
  const float along = from_middle.dot(sun_);
  const float reach = scene_.radius + kSunRadius * std::max(0.0f, scene_.radius - along);
  return along <= scene_.radius && from_middle.squaredNorm() - along * along <= reach * reach;
}

Light Lights::sky(const LitPoint& point, const DiskPoints& points, const Light& bounce) const {
  RayBundle bundle{.origin = point.place, .directions = {}, .farthest = kReach};
  const auto [first, second] = tangents(point.normal);
  for (std::size_t i = 0; i < kBundle; ++i) {
    const Eigen::Vector2f& across = points[i];
    const float along = std::sqrt(std::max(0.0f, 1.0f - across.squaredNorm()));
    bundle.directions[i] = across.x() * first + across.y() * second + along * point.normal;
  }
  const unsigned blocked = near_sky(point.place) ? scene_.blockers.hits(bundle) : 0u;

  Light sum = Light::Zero();
  for (std::size_t i = 0; i < kBundle; ++i) {
    const float rise = bundle.directions[i].dot(scene_.up);
    if (blocked >> i & 1u) {
      sum += bounce;
    } else if (rise >= 0.0f) {
      sum += kHorizon + rise * (kZenith - kHorizon);
    } else {
      // The nearer the floor, the darker it is under the body.
      const float height = scene_.ground ? point.place.dot(scene_.up) - *scene_.ground : kReach;
      sum += std::clamp(height / (-rise * kReach), 0.25f, 1.0f) * kFloor;
    }
  }
  return sum / static_cast<float>(kBundle);
}

float Lights::sun_seen(const LitPoint& point, const DiskPoints& points) const {
  if (!near_sun(point.place)) return 1.0f;
  RayBundle bundle{.origin = point.place, .directions = {}, .farthest = std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < kBundle; ++i) {
    const Eigen::Vector2f across = kSunRadius * points[i];
    bundle.directions[i] = (sun_ + across.x() * across_sun_.first + across.y() * across_sun_.second).normalized();
  }
  return 1.0f - static_cast<float>(std::popcount(scene_.blockers.hits(bundle))) / static_cast<float>(kBundle);
}

}  // namespace tact::scenes
