#include "narrowphase/pairs/cluster_separation.h"

#include <cmath>
#include <limits>

#include "narrowphase/distance/simplex.h"
#include "narrowphase/pairs/box_reach.h"

namespace tact::narrowphase {

namespace {

// Boxes leave few pairs of a cluster where surfaces are smooth, 3 to 9 of most, 16 of those that lie on each other:
// see worth_as_surfaces(). Where they leave half of all that there can be, they tell nothing.
constexpr std::size_t kManyOfCluster = 16, kMostOfAll = 2;

// Planes that are tried of a pair: of those that one separates, most are by the first three.
constexpr int kMostPlanes = 10;
// No plane is better by more than this part.
constexpr double kNearlyBest = 1.0 - 0x1p-10;

// In parts of the size of both clusters: by how much heights are rounded, at most, with room to spare; and how much
// farther they are to be apart than they have to, which is more than any search takes for near (motion/impacts.cpp).
constexpr double kHeightError = 0x1p-46, kFarther = 0x1p-36;
// The sizes of what is looked at: products neither vanish nor overflow.
constexpr double kLeastSize = 0x1p-300, kLargestSize = 0x1p300;

// Doubles that the kernels may read beyond the last.
constexpr int kReadBeyond = 8;

Vec3 unit(Vec3 v) {
  const double length = norm(v);
  return length > kLeastSize ? (1.0 / length) * v : Vec3{1.0, 0.0, 0.0};
}

Vec3 across(Vec3 v, Vec3 e) { return v - (dot(v, e) / dot(e, e)) * e; }

// The least length of a vector that goes straight from `a` to `b`, a little less.
double shortest(Vec3 a, Vec3 b) {
  const Vec3 way = b - a;
  const double t = std::clamp(-dot(a, way) / std::max(dot(way, way), std::numeric_limits<double>::min()), 0.0, 1.0);
  return (1.0 - 0x1p-10) * norm(a + t * way);
}

}  // namespace

// False if boxes tell enough.
bool ClusterSeparation::begin(const PairedClusters& a, const PairedClusters& b, double reach,
                              const base::Tuning& tuning, std::size_t pairs) {
  if (pairs == 0 || pairs < tuning.worth_planes) return false;
  same_ = a.boxes.mesh == b.boxes.mesh;
  const std::size_t both_ways = same_ ? 2 * pairs : pairs;
  const auto count_a = static_cast<std::size_t>(a.count), count_b = static_cast<std::size_t>(b.count);
  const bool are_many =
      both_ways > kManyOfCluster * std::max(count_a, count_b) || kMostOfAll * both_ways > count_a * count_b;
  if (tuning.worth_planes > 0 && !are_many) return false;
  a_.clusters = a;
  b_.clusters = b;
  a_.of_cluster.assign(a.boxes.mesh->cluster_count(), {});
  if (!same_) b_.of_cluster.assign(b.boxes.mesh->cluster_count(), {});
  times_ = a.boxes.way == nullptr ? 1 : 2;
  reach_ = reach;
  points_.clear();
  cluster_a_ = -1;
  return true;
}

int ClusterSeparation::number_of(const Side& side, std::int32_t i) const {
  return side.clusters.numbers == nullptr ? i : side.clusters.numbers[i];
}

ClusterSeparation::Vertices ClusterSeparation::vertices_of(Side& side, int cluster) {
  Vertices& vertices = side.of_cluster[cluster];
  if (vertices.count > 0) return vertices;
  const ClusteredMesh& mesh = *side.clusters.boxes.mesh;
  const MeshWay* const way = side.clusters.boxes.way;
  const ClusterFacets facets = mesh.facets_of(cluster);
  vertices = {points_.size(), facets.owned_count + facets.borrowed_count};
  const PointArrays now = way == nullptr || way->end == nullptr ? mesh.points() : way->end->points;
  const PointArrays at[2] = {way == nullptr ? now : way->begin->points, now};
  for (int time = 0; time < times_; ++time) {
    for (const double* const from : {at[time].x, at[time].y, at[time].z}) {
      points_.insert(points_.end(), from + facets.owned_begin, from + facets.owned_begin + facets.owned_count);
      for (int i = 0; i < facets.borrowed_count; ++i) points_.push_back(from[facets.borrowed[i]]);
    }
  }
  if (points_.capacity() < points_.size() + kReadBeyond) points_.reserve(2 * (points_.size() + kReadBeyond));
  return vertices;
}

PointArrays ClusterSeparation::points(const Vertices& vertices, int time) const {
  const double* const x = points_.data() + vertices.begin + 3 * static_cast<std::ptrdiff_t>(time * vertices.count);
  return {x, x + vertices.count, x + 2 * static_cast<std::ptrdiff_t>(vertices.count)};
}

Vec3 ClusterSeparation::point(const Vertices& vertices, int time, int i) const {
  const PointArrays p = points(vertices, time);
  return {p.x[i], p.y[i], p.z[i]};
}

// False if there is nothing to be said of them: one with itself, or with more than two common vertices.
bool ClusterSeparation::choose(ClusterPair clusters) {
  int in_a[2], in_b[2];
  common_ = 0;
  if (same_) {
    if (clusters.a == clusters.b) return false;
    const ClusterFacets b = b_.clusters.boxes.mesh->facets_of(clusters.b);
    for (int k = 0; k < b.borrowed_count; ++k) {
      const int place = places_[b.borrowed[k]];
      if (place < 0) continue;
      if (common_ == 2) return false;
      in_a[common_] = place;
      in_b[common_++] = b.owned_count + k;
    }
  }
  const auto choose_of = [&](Chosen& chosen, Vertices vertices, int(&left_out)[2]) {
    if (common_ == 2 && left_out[1] < left_out[0]) std::swap(left_out[0], left_out[1]);
    chosen.vertices = vertices;
    chosen.range_count = 0;
    int begin = 0;
    for (int k = 0; k <= common_; ++k) {
      const int end = k == common_ ? vertices.count : left_out[k];
      if (begin < end) chosen.ranges[chosen.range_count++] = {begin, end};
      begin = end + 1;
    }
  };
  const Vertices a = vertices_of(a_, clusters.a), b = vertices_of(same_ ? a_ : b_, clusters.b);
  choose_of(of_a_, a, in_a);
  choose_of(of_b_, b, in_b);
  shortest_edge_ = 0.0;
  for (int time = 0; time < times_; ++time) {
    origin_[time] = point(a, time, common_ == 0 ? 0 : in_a[0]);
    if (common_ == 2) edge_[time] = point(a, time, in_a[1]) - origin_[time];
  }
  if (common_ == 2) shortest_edge_ = shortest(edge_[0], edge_[times_ - 1]);
  return of_a_.range_count > 0 && of_b_.range_count > 0;
}

bool ClusterSeparation::are_apart(ClusterPair pair) {
  const ClusterPair clusters{number_of(a_, pair.a), number_of(b_, pair.b)};
  if (cluster_a_ != clusters.a) {
    cluster_a_ = clusters.a;
    last_ = {};
    const ClusteredMesh& mesh = *a_.clusters.boxes.mesh;
    if (same_) places_.choose(mesh.facets_of(clusters.a), mesh.vertex_count());
  }
  if (!choose(clusters)) return false;
  const Box box_a = a_.clusters.boxes[clusters.a], box_b = b_.clusters.boxes[clusters.b], both = merged(box_a, box_b);
  size_ = norm(both.upper - both.lower);
  if (!(size_ > kLeastSize && size_ < kLargestSize)) return false;
  if (common_ == 2 && !(shortest_edge_ > kFarther * size_)) return false;
  needed_ = box_reach(reach_, largest_coordinate(both)) + kFarther * size_;
  if (last_ == Vec3{}) {
    const auto middle = [](const Box& box) { return 0.5 * (box.lower + box.upper); };
    last_ = unit(middle(box_b) - middle(box_a));
  }
  return search();
}

// Gilbert, Johnson and Keerthi's search for the nearest of all ways, which ends at the first plane that is enough.
bool ClusterSeparation::search() {
  Vec3 n = common_ == 2 ? unit(across(last_, edge_[0])) : last_;
  SimplexPoints simplex;
  double distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostPlanes; ++k) {
    const Lowest lowest = lowest_along(n);
    if (separates(n, lowest.height)) {
      last_ = n;
      return true;
    }
    if (!(lowest.height < kNearlyBest * distance)) return false;
    simplex.point[static_cast<std::size_t>(simplex.count++)] = common_ == 2 ? across(lowest.way, edge_[0]) : lowest.way;
    const SimplexClosest closest = simplex_closest(simplex);
    distance = norm(closest.point);
    if (closest.carrier_count == 4 || !(distance > needed_)) return false;
    for (int i = 0; i < closest.carrier_count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      simplex.point[at] = simplex.point[static_cast<std::size_t>(closest.carrier[at])];
    }
    simplex.count = closest.carrier_count;
    n = (1.0 / distance) * closest.point;
  }
  return false;
}

ClusterSeparation::Lowest ClusterSeparation::lowest_along(Vec3 n) const {
  Lowest lowest{std::numeric_limits<double>::infinity(), {}};
  const auto offer = [&](double height, Vec3 way) {
    if (height < lowest.height) lowest = {height, way};
  };
  const double least = -std::numeric_limits<double>::infinity();
  for (int time = 0; time < times_; ++time) {
    const Vec3 o = origin_[time];
    const auto farthest = [&](const Chosen& chosen, Vec3 along) {
      const HeightAxis axis{along.x, along.y, along.z, o.x, o.y, o.z};
      return kernels().highest_point(points(chosen.vertices, time), nullptr, chosen.ranges, chosen.range_count, axis,
                                     least);
    };
    const HighestPoint a = farthest(of_a_, n), b = farthest(of_b_, -n);
    if (a.index < 0 || b.index < 0) return {least, {}};
    const Vec3 at_a = point(of_a_.vertices, time, a.index), at_b = point(of_b_.vertices, time, b.index);
    if (common_ == 0) {
      offer(-(a.height + b.height), at_b - at_a);
    } else {
      offer(-a.height, o - at_a);
      offer(-b.height, at_b - o);
    }
  }
  return lowest;
}

// The plane that goes through two common vertices is tilted from the one across `n` by what their heights differ.
bool ClusterSeparation::separates(Vec3 n, double height) const {
  double apart = height - kHeightError * size_;
  if (common_ < 2) return apart > needed_;
  double rise = 0.0;
  for (int time = 0; time < times_; ++time) rise = std::max(rise, std::abs(dot(n, edge_[time])));
  apart -= (rise + kHeightError * size_) / shortest_edge_ * size_;
  return std::min(apart, shortest_edge_ * apart / (3.0 * size_)) > needed_;
}

}  // namespace tact::narrowphase
