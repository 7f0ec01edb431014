#include "narrowphase/self/smooth_patches.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "narrowphase/kernels/kernels.h"

namespace tact::narrowphase {

namespace {

// Coordinates of this size at most have products of four that neither overflow nor, where it matters, vanish.
constexpr double kLargestSize = 0x1p200;
constexpr double kLeastSize = 0x1p-200;  // of clusters at a corner: errors of products of two are far from vanishing

// Cosines of angles between normals and a direction are off by less than this. A normal is off by at most 2^-49 of the
// product of two edges, which is at most 2^20 times its length; the axes of a view and what is computed of cones are
// off by some 2^-50.
constexpr double kSlack = 0x1p-27;
constexpr double kLeastSineSquared = 0x1p-40;

// A coordinate in a view is off by less than this part of the size of the patch: of the difference from the origin
// 2^-53, of three products and two sums of it 2^-51 each at most, and the axes are unit vectors.
constexpr double kViewSlack = 0x1p-48;

// Clusters in a patch: ten around two, twenty around a cluster and those around it. Of more the boundary is long.
constexpr std::size_t kMostInPatch = 40;

double sum_of_sides(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  return size.x + size.y + size.z;
}

}  // namespace

void SmoothPatches::begin(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors) {
  cones_.resize(mesh.cluster_count());
  rims_.resize(neighbors.rim_count());
  usable_ = sum_of_sides(mesh.box()) < kLargestSize;
}

void SmoothPatches::look_at(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors, int cluster) {
  find_cone(mesh, cluster);
  std::size_t rim = neighbors.first_rim(cluster);
  for (const ClusterNeighbors::Rim& one : neighbors.rims(cluster)) {
    Box box;
    for (const ClusterNeighbors::Side& side : neighbors.sides(one)) {
      box = extended(box, mesh.position(side.from));
      box = extended(box, mesh.position(side.to));
    }
    const Vec3 middle = 0.5 * box.lower + 0.5 * box.upper;  // as it is rounded
    const auto half = [&](int axis) {
      return std::max(box.upper[axis] - middle[axis], middle[axis] - box.lower[axis]);
    };
    rims_[rim++] = {middle, {half(0), half(1), half(2)}};
  }
}

void SmoothPatches::find_cone(const ClusteredMesh& mesh, int cluster) {
  NormalCone& cone = cones_[cluster] = {};
  if (!usable_) return;
  const NormalSpread spread = kernels().normal_spread(mesh.facets_of(cluster), kLeastSineSquared);
  if (!(spread.least > 0.0)) return;
  const auto [x, y, z] = spread.axis;
  cone = {{x, y, z}, std::sqrt(spread.least), std::sqrt(std::max(0.0, 1.0 - spread.least))};
}

SmoothPatches::Outlook SmoothPatches::outlook_on(const ClusteredMesh& mesh, std::span<const int> clusters) const {
  Vec3 sum;
  for (const int c : clusters) sum = sum + cones_[c].axis;
  if (!(norm_squared(sum) > 0.25)) return {};
  const Vec3 up = normalized(sum);
  double least = 1.0;  // the cosine of the largest angle between `up` and a normal
  Box box;
  for (const int c : clusters) {
    const double cosine = dot(up, cones_[c].axis), sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    least = std::min(least, cosine * cones_[c].cosine - sine * cones_[c].sine);
    box = merged(box, mesh.cluster_boxes()[c]);
  }
  return {up, least > 2.0 * kSlack ? least - kSlack : 0.0, sum_of_sides(box)};
}

bool SmoothPatches::never_meet_at(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors, int corner) const {
  if (!usable_) return false;
  const std::span<const int> clusters = neighbors.clusters_at(corner);
  const Outlook outlook = outlook_on(mesh, clusters);
  if (!(outlook.least_cosine > 0.0) || !(outlook.size > kLeastSize)) return false;
  const Vec3 up = outlook.up, x = normalized(cross(up, std::abs(up.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Vec3 y = cross(up, x), origin = mesh.cluster_boxes()[clusters.front()].lower;
  FlatPolygon line;
  static_assert(FlatPolygon::kMost == ClusterNeighbors::kMostAround);
  line.count = 0;
  for (const int vertex : neighbors.line_around(corner)) {
    const Vec3 d = mesh.position(vertex) - origin;
    line.x[line.count] = dot(x, d);
    line.y[line.count++] = dot(y, d);
  }
  line.error = kViewSlack * outlook.size;
  line.size = outlook.size;
  return kernels().comes_nowhere_twice(&line);
}

bool SmoothPatches::Judge::gather(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors,
                                  std::span<const int> clusters) {
  if (marks_.size() != static_cast<std::size_t>(mesh.cluster_count()) || mark_ > std::numeric_limits<int>::max() - 4)
    marks_.assign(mesh.cluster_count(), mark_ = 0);
  mark_ += 2;
  patch_.clear();
  for (const int cluster : clusters) {
    bool connected = patch_.empty();
    for (const int c : neighbors.around(cluster)) {
      if (in_patch(c)) {
        connected = true;
        continue;
      }
      if (neighbors.irregular(c)) return false;
      marks_[c] = mark_;
      patch_.push_back(c);
    }
    if (!connected || patch_.size() > kMostInPatch) return false;
  }
  for (const int cluster : clusters) marks_[cluster] = mark_ + 1;
  return true;
}

// Along the ends of the surface, or along the clusters; zero if these have no length.
Vec3 SmoothPatches::Judge::along(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors,
                                 std::span<const int> clusters) const {
  Vec3 sum;
  for (const int c : clusters) {
    const auto rims = neighbors.rims(c);
    if (rims.empty() || rims.front().other >= 0) continue;
    for (const ClusterNeighbors::Side& side : neighbors.sides(rims.front()))
      sum = sum + (mesh.position(side.to) - mesh.position(side.from));
  }
  if (sum != Vec3{}) return sum;
  const auto box = [&](int c) { return mesh.cluster_boxes()[c]; };
  const Box first = box(clusters.front()), last = box(clusters.back());
  sum = (last.lower + last.upper) - (first.lower + first.upper);
  return sum != Vec3{} ? sum : first.upper - first.lower;
}

// Half the length of a box along an axis, and what rounding may make of it.
double SmoothPatches::Judge::half_along(const RimBox& rim, Vec3 axis) const {
  return std::abs(axis.x) * rim.half.x + std::abs(axis.y) * rim.half.y + std::abs(axis.z) * rim.half.z + 4.0 * slack_;
}

// The polygon around some clusters. What is farthest in a direction lies on their boundary: around any other vertex
// there are facets on all sides.
SmoothPatches::Judge::Region SmoothPatches::Judge::region_of(const ClusteredMesh& mesh,
                                                             const ClusterNeighbors& neighbors,
                                                             std::span<const int> clusters, const View& view) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Region region{kInfinity, -kInfinity, kInfinity, -kInfinity, {}, {}};
  std::ranges::fill(region.low, kInfinity);
  std::ranges::fill(region.high, -kInfinity);
  for (const int cluster : clusters) {
    for (const ClusterNeighbors::Rim& rim : neighbors.rims(cluster)) {
      if (rim.other >= 0 && in_core(rim.other)) continue;
      for (const ClusterNeighbors::Side& side : neighbors.sides(rim)) {
        const Flat p = seen(view, mesh.position(side.from));
        region.low_x = std::min(region.low_x, p.x);
        region.high_x = std::max(region.high_x, p.x);
        region.low_y = std::min(region.low_y, p.y);
        region.high_y = std::max(region.high_y, p.y);
        const auto along = between(p);
        for (std::size_t k = 0; k < kBetween; ++k) {
          region.low[k] = std::min(region.low[k], along[k]);
          region.high[k] = std::max(region.high[k], along[k]);
        }
      }
    }
  }
  const double wider = 16.0 * slack_;  // coordinates between add three errors, here and where they are compared
  for (int k = 0; k < kBetween; ++k) {
    region.low[k] -= wider;
    region.high[k] += wider;
  }
  region.low_x -= wider;
  region.high_x += wider;
  region.low_y -= wider;
  region.high_y += wider;
  return region;
}

// True if the line from one point to another lies beyond one of the region's sides between x and y; `above`: on that of
// y.
bool SmoothPatches::Judge::lies_beyond(const Region& region, const Flat& p, const Flat& q, bool& above) {
  const auto along_p = between(p), along_q = between(q);
  for (int k = 0; k < kBetween; ++k) {
    above = along_p[k] > region.high[k] && along_q[k] > region.high[k];
    if (above || (along_p[k] < region.low[k] && along_q[k] < region.low[k])) return true;
  }
  return false;
}

// True if a rim lies beyond one side of the region and crosses the ray as often one way as the other. By its box.
bool SmoothPatches::Judge::passes_by(const RimBox& rim, const View& view, const Region& region) const {
  const Flat middle = seen(view, rim.middle);
  const double half_x = half_along(rim, view.x), half_y = half_along(rim, view.y);
  if (middle.x + half_x < region.low_x || middle.x - half_x > region.high_x || middle.y + half_y < region.low_y)
    return true;
  const bool beside_ray = std::abs(middle.x - region.ray()) > half_x;
  if (middle.y - half_y > region.high_y) return beside_ray;
  const auto along = between(middle), half = between({half_x, half_y});
  for (std::size_t k = 0; k < kBetween; ++k) {
    const double reach = half[k - k % 2];  // the direction before an odd one is the same but for a sign
    if (along[k] + reach < region.low[k]) return true;
    if (along[k] - reach > region.high[k]) return beside_ray;
  }
  return false;
}

// Each edge of the boundary lies beyond one side of the region, or it does not avoid it. How often the region is
// covered is how often the boundary crosses the ray that runs from it along y, counted by the way it goes: there it
// lies beyond a side above the region.
bool SmoothPatches::Judge::walk_along(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors,
                                      const ClusterNeighbors::Rim& rim, const View& view, const Region& region,
                                      int& covered) {
  enum : unsigned { kAbove = 1, kBelow = 2, kBefore = 4, kBehind = 8 };
  const double ray = region.ray();
  const auto look = [&](int vertex) -> Seen {
    const Flat p = seen(view, mesh.position(vertex));
    return {p, (p.y > region.high_y ? kAbove : 0u) | (p.y < region.low_y ? kBelow : 0u) |
                   (p.x < region.low_x ? kBefore : 0u) | (p.x > region.high_x ? kBehind : 0u)};
  };
  int last = -1;
  Seen p{}, q{};
  for (const ClusterNeighbors::Side& side : neighbors.sides(rim)) {
    p = side.from == last ? q : look(side.from);
    q = look(side.to);
    last = side.to;
    const unsigned beyond = p.beyond & q.beyond;
    bool above = (beyond & kAbove) != 0;
    if (beyond == 0 && !lies_beyond(region, p.at, q.at, above)) {
      if (rim.other >= 0) return false;
      ends_.push_back({side, p.at, q.at});
    } else if (above) {
      covered += (q.at.x <= ray ? 1 : 0) - (p.at.x <= ray ? 1 : 0);
    }
  }
  return true;
}

SmoothPatches::Judge::Boundary SmoothPatches::Judge::walk(const SmoothPatches& patches, const ClusteredMesh& mesh,
                                                          const ClusterNeighbors& neighbors, const View& view,
                                                          const Region& region) {
  ends_.clear();
  int covered = 0;
  for (const int c : patch_) {
    std::size_t number = neighbors.first_rim(c);
    for (const ClusterNeighbors::Rim& rim : neighbors.rims(c)) {
      const RimBox& box = patches.rims_[number++];
      if (rim.other >= 0 && in_patch(rim.other)) continue;
      if (!passes_by(box, view, region) && !walk_along(mesh, neighbors, rim, view, region, covered))
        return Boundary::crosses;
    }
  }
  if (covered != 1) return Boundary::crosses;
  return ends_.empty() ? Boundary::avoids : Boundary::ends;
}

// True if strips that run from all ends against y continue the surface, and the rays at the ends of chains avoid the
// region. Sorts the ends along x.
bool SmoothPatches::Judge::continues(const Region& region) {
  std::ranges::sort(ends_, {}, [](const End& end) { return end.from.x; });
  const auto avoids = [&](const Flat& p) {
    const auto along = between(p);
    return p.x < region.low_x || p.x > region.high_x || p.y < region.low_y ||
           !std::ranges::equal(along, region.low, std::greater_equal<>());
  };
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const End& end = ends_[i];
    if (!(end.to.x - end.from.x > 2.0 * slack_)) return false;
    const bool begins = i == 0 || ends_[i - 1].side.to != end.side.from;
    const bool stops = i + 1 == ends_.size() || ends_[i + 1].side.from != end.side.to;
    if ((begins && !avoids(end.from)) || (stops && !avoids(end.to))) return false;
  }
  return true;
}

// Its cosine; zero or less if it may be a right angle. The turn so far, at least 0 and less than a right angle, is kept
// as a cosine and a sine. Each edge adds less than 180 degrees to it or takes up to 180 away, so the sign of the sine
// tells if less than nothing is left, and that of the cosine if it is no longer acute. Each edge adds some four
// roundings: of thousands that is far less than kSlack.
double SmoothPatches::Judge::cosine_of_inward_turn() const {
  double cosine = 1.0, sine = 0.0, least = 1.0;
  for (std::size_t i = 1; i < ends_.size() && least > 0.0; ++i) {
    const End &one = ends_[i - 1], &next = ends_[i];
    const double ux = one.to.x - one.from.x, uy = one.to.y - one.from.y;
    const double wx = next.to.x - next.from.x, wy = next.to.y - next.from.y;
    const double along = ux * wx + uy * wy, inward = uy * wx - ux * wy;
    const double length = std::sqrt(along * along + inward * inward);
    const double more_cosine = along / length, more_sine = inward / length;
    const double turned = sine * more_cosine + cosine * more_sine;
    cosine = cosine * more_cosine - sine * more_sine;
    sine = turned;
    if (one.side.to != next.side.from || (more_sine < 0.0 && sine <= 0.0)) cosine = 1.0, sine = 0.0;
    least = length > 0.0 ? std::min(least, cosine) : 0.0;
  }
  return least;
}

SelfVerdict SmoothPatches::Judge::operator()(const SmoothPatches& patches, const ClusteredMesh& mesh,
                                             const ClusterNeighbors& neighbors, std::span<const int> clusters) {
  if (!patches.usable_ || !gather(mesh, neighbors, clusters)) return SelfVerdict::open;
  const Outlook outlook = patches.outlook_on(mesh, patch_);
  slack_ = kViewSlack * outlook.size;
  if (!(outlook.least_cosine > 0.0)) return SelfVerdict::open;
  return look(patches, mesh, neighbors, clusters, outlook.up, outlook.least_cosine);
}

// From a direction whose angle with every normal has at least this cosine.
SelfVerdict SmoothPatches::Judge::look(const SmoothPatches& patches, const ClusteredMesh& mesh,
                                       const ClusterNeighbors& neighbors, std::span<const int> clusters, Vec3 up,
                                       double least_cosine) {
  Vec3 x = along(mesh, neighbors, clusters);
  for (bool again = false;; again = true) {
    const Vec3 across = cross(up, x);
    if (!(norm_squared(across) > 1e-4 * norm_squared(x))) return SelfVerdict::open;
    View view{mesh.cluster_boxes()[clusters.front()].lower, {}, normalized(across)};
    view.x = cross(view.y, up);
    const Region region = region_of(mesh, neighbors, clusters, view);
    const Boundary boundary = walk(patches, mesh, neighbors, view, region);
    if (boundary == Boundary::crosses) return SelfVerdict::open;
    if (boundary == Boundary::avoids || continues(region)) break;
    if (again) return SelfVerdict::open;
    x = {};
    for (const End& end : ends_) x = x + (mesh.position(end.side.to) - mesh.position(end.side.from));
  }
  const double tangent = std::sqrt(1.0 - least_cosine * least_cosine) / least_cosine;
  return tangent < cosine_of_inward_turn() - kSlack ? SelfVerdict::never_contact : SelfVerdict::never_meet;
}

}  // namespace tact::narrowphase
