#include "scenes/pictures/light_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kSampleRowsAtATime = 8;  // that a thread takes at a time
constexpr float kSameNormal = 0.95f;           // least cosine between normals of one piece of surface
constexpr float kSamePlace = 0.04f;            // greatest distance between its points, in units of the drawn scene
constexpr float kSameSurface = 0.004f;         // greatest distance of a point from the other's tangent plane

bool same_piece(const LitPoint& a, const LitPoint& b) {
  if (a.mesh != b.mesh || a.normal.dot(b.normal) < kSameNormal) return false;
  const Eigen::Vector3f apart = b.place - a.place;
  return std::abs(apart.dot(a.normal)) < kSameSurface && apart.squaredNorm() < kSamePlace * kSamePlace;
}

}  // namespace

LightBuffer::LightBuffer(int width, int height)
    : width_(width),
      height_(height),
      points_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      lights_(points_.size()) {}

std::size_t LightBuffer::index(int x, int y) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
}

void LightBuffer::set(int x, int y, const LitPoint& point, const Lighting& lighting) {
  points_[index(x, y)] = point;
  lights_[index(x, y)] = lighting;
}

Lighting LightBuffer::mean(int x, int y, int reach) const {
  const LitPoint& point = points_[index(x, y)];
  Lighting sum;
  int count = 0;
  for (int v = std::max(0, y - reach); v <= std::min(height_ - 1, y + reach); ++v) {
    for (int u = std::max(0, x - reach); u <= std::min(width_ - 1, x + reach); ++u) {
      const std::size_t i = index(u, v);
      if (!same_piece(point, points_[i])) continue;
      sum.sky += lights_[i].sky;
      sum.sun_seen += lights_[i].sun_seen;
      ++count;
    }
  }
  const float share = 1.0f / static_cast<float>(count);
  return {.sky = share * sum.sky, .sun_seen = share * sum.sun_seen};
}

void LightBuffer::smooth(int reach, int threads) {
  std::vector<Lighting> smoothed(lights_.size());
  base::parallel_for(static_cast<std::size_t>(height_), kSampleRowsAtATime, threads, [&](std::size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = index(x, y);
      if (!points_[i].normal.isZero(0.0f)) smoothed[i] = mean(x, y, reach);
    }
  });
  lights_ = std::move(smoothed);
}

const Lighting* LightBuffer::find(int x, int y, const LitPoint& point) const {
  constexpr std::array<std::array<int, 2>, 9> kNeighbours{
      {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
  for (const auto& [dx, dy] : kNeighbours) {
    if (x + dx < 0 || y + dy < 0 || x + dx >= width_ || y + dy >= height_) continue;
    const std::size_t i = index(x + dx, y + dy);
    if (same_piece(point, points_[i])) return &lights_[i];
  }
  return nullptr;
}

}  // namespace tact::scenes
