#include "scenes/pictures/light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace tact::scenes {
namespace {

constexpr float kSunRadius = 0.07f;  // tangent of half the angle under which the sun is seen
constexpr float kReach = 0.8f;       // how far blockers darken the sky, in units of the drawn scene
const Light kZenith{0.78f, 0.88f, 1.0f};
const Light kHorizon{0.62f, 0.66f, 0.72f};
const Light kFloor{0.46f, 0.45f, 0.43f};

}  // namespace

Lights::Lights(const DrawnScene& scene)
    : scene_(scene),
      sun_((1.15f * scene.up - 0.75f * scene.right.normalized() -
            0.62f * (scene.forward - scene.up.dot(scene.forward) * scene.up).normalized())
               .normalized()),
      across_sun_(tangents(sun_)) {}

Light Lights::sky(const LitPoint& point, const BundlePoints& points, const Light& bounce) const {
  RayBundle bundle{.origin = point.place, .directions = {}, .farthest = kReach};
  const auto [first, second] = tangents(point.normal);
  for (std::size_t i = 0; i < kBundle; ++i) {
    const Eigen::Vector2f across = disk_point(points[i]);
    const float along = std::sqrt(std::max(0.0f, 1.0f - across.squaredNorm()));
    bundle.directions[i] = across.x() * first + across.y() * second + along * point.normal;
  }
  const bool near = (point.place - scene_.middle).squaredNorm() <= (scene_.radius + kReach) * (scene_.radius + kReach);
  const unsigned blocked = near ? scene_.blockers.hits(bundle) : 0u;

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

float Lights::sun_seen(const LitPoint& point, const BundlePoints& points) const {
  const Eigen::Vector3f from_middle = point.place - scene_.middle;
  const float along = from_middle.dot(sun_);
  const float reach = scene_.radius + kSunRadius * std::max(0.0f, scene_.radius - along);
  if (along > scene_.radius || from_middle.squaredNorm() - along * along > reach * reach) return 1.0f;
  RayBundle bundle{.origin = point.place, .directions = {}, .farthest = std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < kBundle; ++i) {
    const Eigen::Vector2f across = kSunRadius * disk_point(points[i]);
    bundle.directions[i] = (sun_ + across.x() * across_sun_.first + across.y() * across_sun_.second).normalized();
  }
  return 1.0f - static_cast<float>(std::popcount(scene_.blockers.hits(bundle))) / static_cast<float>(kBundle);
}

}  // namespace tact::scenes
