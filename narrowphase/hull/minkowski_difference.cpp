#include "narrowphase/hull/minkowski_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

// A height n · (x - o) is off by at most 4 roundoffs of |x - o|, n being of unit length but for rounding. Two vertices
// are chosen, each at most two such errors below the true extreme, and n · (a - b), |a - b| <= 2 size, is off by 4 of 2
// size.
//
// Besides, where products fall below the smallest normal number, each of the three of n · (x - o) may be off by half of
// the least subnormal one. That is in metres: one unit is 3/2 of it rounded up, and heights that choose vertices are
// off by four such errors.
constexpr double kVertexRoundings = 4.0 * 1.05;
constexpr double kHeightRoundings = (2.0 * 2.0 * 4.0 + 2.0 * 4.0) * 1.05;
constexpr double kUnderflow = 2.0 * std::numeric_limits<double>::denorm_min();

constexpr double kSmallBodies = 0x1p900;  // scale from which on what vanishes counts

}  // namespace

MinkowskiDifference::MinkowskiDifference(const ClusteredMesh& a, const ClusteredMesh& b, const base::Tuning& tuning)
    : a_(&a), b_(&b), by_clusters_(tuning.support_by_clusters) {
  const Box common = intersection(a.box(), b.box());
  origin_ = 0.5 * common.lower + 0.5 * common.upper;
  const Vec3 far_a = farthest_from(origin_, a.box()), far_b = farthest_from(origin_, b.box());
  const Vec3 reach{std::max(far_a.x, far_b.x), std::max(far_a.y, far_b.y), std::max(far_a.z, far_b.z)};
  const double largest = largest_coordinate(reach);
  scale_ = unit_scale(largest);
  size_ = norm(scale_ * reach);
  // size_, not the norm of what it was scaled from, whose squares vanish where bodies are tiny.
  vertex_height_error_ = kVertexRoundings * kUnitRoundoff * size_ / scale_ + kUnderflow;
  height_error_ = kHeightRoundings * kUnitRoundoff * size_;
  // Elsewhere it would not change the last bit, and with a factor that small it takes a hundred cycles.
  if (scale_ > kSmallBodies || size_ < 1.0) height_error_ += 4.0 * scale_ * kUnderflow;
}

MinkowskiVertex MinkowskiDifference::support(Vec3 direction) const { return support(direction, {}); }

MinkowskiVertex MinkowskiDifference::support(Vec3 direction, const MinkowskiVertex& near) const {
  if (!by_clusters_) {
    return vertex(support_by_full_scan(*a_, direction, origin_).vertex,
                  support_by_full_scan(*b_, -direction, origin_).vertex);
  }
  return vertex(narrowphase::support(*a_, direction, origin_, near.a).vertex,
                narrowphase::support(*b_, -direction, origin_, near.b).vertex);
}

bool MinkowskiDifference::separated_by_plane(Vec3 direction, int a, int b) const {
  const double height_a = dot(direction, a_->position(a) - origin_);
  const double height_b = dot(-direction, b_->position(b) - origin_);
  const double to_plane = -0.5 * (height_a + height_b) - 2.0 * vertex_height_error_;
  return to_plane > 0.0 && stays_below(*a_, direction, origin_, height_a + to_plane) &&
         stays_below(*b_, -direction, origin_, height_b + to_plane);
}

}  // namespace tact::narrowphase
