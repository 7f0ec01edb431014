#include "narrowphase/clustered_mesh.h"

#include <atomic>
#include <cassert>
#include <numeric>
#include <stdexcept>
#include <string>

#include "engine/base/parallel.h"

namespace tact::narrowphase {

namespace {

constexpr int kLaneGroup = 8;           // facets inside a cluster are ordered in groups of so many neighbours
constexpr int kClustersPerRange = 256;  // what a thread refreshes at a time
constexpr int kNearClusters = 4;        // of so few, the positions are still near since they were checked
constexpr int kFirstUse = -1;

Vec3 source_position(std::span<const double> positions, int vertex) {
  const double* p = positions.data() + 3 * static_cast<std::size_t>(vertex);
  return {p[0], p[1], p[2]};
}

// Orders facets so that neighbours in space are neighbours in the order: halves at the median of the longest axis, cut
// at multiples of `unit` so that clusters come out full. Ties break by facet number.
class MedianOrder {
 public:
  MedianOrder(const std::vector<Vec3>& centers, std::vector<int>& order) : centers_(centers), order_(order) {}

  void sort(std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    if (count <= kLaneGroup) return;
    const std::size_t unit = count > kClusterSize ? kClusterSize : kLaneGroup;
    const std::size_t units = (count + unit - 1) / unit;
    const std::size_t middle = begin + (units + 1) / 2 * unit;
    if (middle >= end) return;
    const int axis = longest_axis(begin, end);
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](int a, int b) {
      const double x = centers_[static_cast<std::size_t>(a)][axis], y = centers_[static_cast<std::size_t>(b)][axis];
      return x < y || (x == y && a < b);
    });
    sort(begin, middle);
    sort(middle, end);
  }

 private:
  int longest_axis(std::size_t begin, std::size_t end) const {
    Box box;
    for (std::size_t i = begin; i < end; ++i) box = extended(box, centers_[static_cast<std::size_t>(order_[i])]);
    const Vec3 size = box.upper - box.lower;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  const std::vector<Vec3>& centers_;
  std::vector<int>& order_;
};

Box box_of(const BoxBounds& b) { return {{b.lower[0], b.lower[1], b.lower[2]}, {b.upper[0], b.upper[1], b.upper[2]}}; }

// Positions are gathered cluster by cluster, in an order in which memory is slow. Read once through in their own order
// before, they come at full speed, and are near when they are gathered.
void read_through(const double* positions, std::size_t count) {
  constexpr std::size_t kLine = 8;  // doubles
  double sum = 0.0;
  for (std::size_t i = 0; i < count; i += kLine) sum += positions[i];
  asm volatile("" : : "m"(sum));  // the sum itself is not wanted
}

[[noreturn]] void broken(const std::string& what) { throw std::logic_error("ClusteredMesh: " + what); }

}  // namespace

void BoxArrays::resize(std::size_t count) {
  const Box empty;
  stride_ = count;
  bounds_.assign(3 * count, empty.lower.x);
  bounds_.resize(6 * count + kPadding, empty.upper.x);
}

void BoxArrays::set(std::size_t i, const Box& box) {
  double* bound = bounds_.data() + i;
  for (int axis = 0; axis < 3; ++axis, bound += stride_) *bound = box.lower[axis];
  for (int axis = 0; axis < 3; ++axis, bound += stride_) *bound = box.upper[axis];
}

BoxPointers BoxArrays::pointers(int first) const {
  return {{lower(0) + first, lower(1) + first, lower(2) + first},
          {upper(0) + first, upper(1) + first, upper(2) + first}};
}

void BoxArrays::prefetch() const { prefetch_lines(bounds_.data(), bounds_.size()); }

PositionProblem find_position_problem(const double* positions, std::size_t count, double largest) {
  const std::int64_t at = kernels().find_large(positions, 3 * static_cast<std::int64_t>(count), largest);
  if (at < 0) return {};
  const auto kind = std::isfinite(positions[at]) ? PositionProblem::out_of_range : PositionProblem::non_finite;
  return {kind, static_cast<int>(at / 3), static_cast<int>(at % 3)};
}

ClusteredMesh::ClusteredMesh(std::span<const double> positions, std::span<const int> facets)
    : source_vertex_count_(static_cast<int>(positions.size() / 3)) {
  group_facets(positions, facets);
  number_vertices(facets);
  stride_ = static_cast<std::size_t>(vertex_count());
  coordinates_.assign(3 * stride_ + kPadding, 0.0);
  cluster_boxes_.resize(static_cast<std::size_t>(cluster_count()));
  if (group_count() > 1) group_boxes_.resize(static_cast<std::size_t>(group_count()));
  set_positions(positions.data(), 1);
}

void ClusteredMesh::group_facets(std::span<const double> positions, std::span<const int> facets) {
  const std::size_t count = facets.size() / 3;
  std::vector<Vec3> centers(count);
  for (std::size_t f = 0; f < count; ++f) {
    centers[f] = source_position(positions, facets[3 * f]) + source_position(positions, facets[3 * f + 1]) +
                 source_position(positions, facets[3 * f + 2]);
  }
  facet_count_ = static_cast<int>(count);
  source_facet_.resize(count);
  std::iota(source_facet_.begin(), source_facet_.end(), 0);
  MedianOrder(centers, source_facet_).sort(0, count);
  facet_of_source_.resize(count);
  for (int f = 0; f < facet_count(); ++f) facet_of_source_[static_cast<std::size_t>(source_facet(f))] = f;
}

void ClusteredMesh::number_vertices(std::span<const int> facets) {
  std::vector<int> number(static_cast<std::size_t>(source_vertex_count_), kFirstUse);
  std::vector<int> last_user(static_cast<std::size_t>(source_vertex_count_), kFirstUse);
  std::vector<int> place(static_cast<std::size_t>(source_vertex_count_), 0);  // among those that the last user borrows
  const auto source_of = [&](int f, int k) {
    return facets[3 * static_cast<std::size_t>(source_facet(f)) + static_cast<std::size_t>(k)];
  };
  std::vector<int> source_vertices, borrowed_sources;
  for (auto& corner : corner_) corner.assign(static_cast<std::size_t>(facet_count()), 0);
  for (int c = 0; c < cluster_count(); ++c) {
    const int first = vertex_count_, first_borrowed = static_cast<int>(borrowed_.size());
    indices_.insert(indices_.end(), {first, first_borrowed});
    for (int i = 0; i < 3 * (facet_end(c) - facet_begin(c)); ++i) {
      const int source = source_of(facet_begin(c) + i / 3, i % 3);
      const auto s = static_cast<std::size_t>(source);
      if (number[s] == kFirstUse) {
        number[s] = vertex_count_++;
        source_vertices.push_back(source);
      } else if (number[s] < first && last_user[s] != c) {
        place[s] = static_cast<int>(borrowed_.size()) - first_borrowed;
        borrowed_.push_back(number[s]);
        borrowed_sources.push_back(source);
      }
      last_user[s] = c;
    }
    const int owned = vertex_count_ - first;
    for (int f = facet_begin(c); f < facet_end(c); ++f) {
      for (int k = 0; k < 3; ++k) {
        const auto s = static_cast<std::size_t>(source_of(f, k));
        const int local = number[s] < first ? owned + place[s] : number[s] - first;
        corner_[k][static_cast<std::size_t>(f)] = static_cast<std::uint8_t>(local);
      }
    }
  }
  indices_.insert(indices_.end(), {vertex_count_, static_cast<int>(borrowed_.size())});
  indices_.insert(indices_.end(), source_vertices.begin(), source_vertices.end());
  indices_.insert(indices_.end(), borrowed_sources.begin(), borrowed_sources.end());
}

ClusterFacets ClusteredMesh::facets_of(int cluster) const {
  const int first = facet_begin(cluster), borrowed = borrowed_begin(cluster);
  return {.points = points(),
          .owned_begin = vertex_begin(cluster),
          .owned_count = vertex_end(cluster) - vertex_begin(cluster),
          .borrowed = borrowed_.data() + borrowed,
          .borrowed_count = borrowed_begin(cluster + 1) - borrowed,
          .corner = {corner_[0].data() + first, corner_[1].data() + first, corner_[2].data() + first},
          .facet_begin = first,
          .facet_count = facet_end(cluster) - first};
}

Corners ClusteredMesh::corners(int facet) const {
  const ClusterFacets cluster = facets_of(facet / kClusterSize);
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const int local = cluster.corner[k][facet % kClusterSize];
    corners[k] =
        local < cluster.owned_count ? cluster.owned_begin + local : cluster.borrowed[local - cluster.owned_count];
  }
  return corners;
}

bool ClusteredMesh::set_positions(const double* positions, int threads) {
  const int ranges = (cluster_count() + kClustersPerRange - 1) / kClustersPerRange;
  const bool in_ranges = ranges > 1 && threads > 1;
  Refreshed all;
  if (!in_ranges) {
    if (cluster_count() > kNearClusters) read_through(positions, 3 * static_cast<std::size_t>(source_vertex_count_));
    all = refresh_range(positions, 0, cluster_count());
  } else {
    const std::size_t part = 3 * static_cast<std::size_t>(source_vertex_count_) / static_cast<std::size_t>(ranges) + 1;
    base::parallel_for(static_cast<std::size_t>(ranges), 1, threads, [&](std::size_t i) {
      const std::size_t begin = i * part, end = 3 * static_cast<std::size_t>(source_vertex_count_);
      if (begin < end) read_through(positions + begin, std::min(part, end - begin));
    });
    std::atomic<bool> any_changed{false};
    base::parallel_for(static_cast<std::size_t>(ranges), 1, threads, [&](std::size_t i) {
      const int begin = static_cast<int>(i) * kClustersPerRange;
      if (refresh_range(positions, begin, std::min(begin + kClustersPerRange, cluster_count())).changed)
        any_changed = true;
    });
    all.changed = any_changed;
  }
  for (int g = 0; g < group_count() && group_count() > 1; ++g) {
    const int begin = cluster_begin(g), count = cluster_end(g) - begin;
    group_boxes_.set(static_cast<std::size_t>(g), box_of(kernels().bounds(cluster_boxes_.pointers(begin), count)));
  }
  box_ = in_ranges ? box_of(kernels().bounds(group_boxes_.pointers(), group_count())) : all.box;
  return all.changed;
}

void ClusteredMesh::prefetch() const {
  prefetch_lines(indices_.data(), indices_.size());
  prefetch_lines(coordinates_.data(), coordinates_.size());
  cluster_boxes_.prefetch();
}

ClusteredMesh::Refreshed ClusteredMesh::refresh_range(const double* positions, int cluster_begin, int cluster_end) {
  Refreshed refreshed;
  for (int cluster = cluster_begin; cluster < cluster_end; ++cluster) {
    const auto c = static_cast<std::size_t>(cluster);
    const int first = vertex_begin(cluster);
    const int borrowed = borrowed_begin(cluster);
    const RefreshInput input{.source = positions,
                             .owned = source_vertices() + first,
                             .owned_count = vertex_end(cluster) - first,
                             .borrowed = borrowed_sources() + borrowed,
                             .borrowed_count = borrowed_begin(cluster + 1) - borrowed,
                             .x = coordinates_.data() + first,
                             .y = coordinates_.data() + stride_ + first,
                             .z = coordinates_.data() + 2 * stride_ + first};
    BoxBounds bounds;
    refreshed.changed = kernels().refresh_cluster(input, &bounds) || refreshed.changed;
    const Box box = box_of(bounds);
    cluster_boxes_.set(c, box);
    refreshed.box = merged(refreshed.box, box);
  }
  return refreshed;
}

Triangle ClusteredMesh::triangle(int facet) const {
  const Corners c = corners(facet);
  return {position(c[0]), position(c[1]), position(c[2])};
}

void ClusteredMesh::validate() const {
  std::vector<char> seen(static_cast<std::size_t>(facet_count()), 0);
  for (const int f : source_facet_) {
    if (f < 0 || f >= facet_count() || seen[static_cast<std::size_t>(f)]++) broken("source facet " + std::to_string(f));
  }
  std::vector<char> owned(static_cast<std::size_t>(source_vertex_count_), 0);
  for (const int s : std::span(source_vertices(), static_cast<std::size_t>(vertex_count()))) {
    if (owned[static_cast<std::size_t>(s)]++) broken("source vertex " + std::to_string(s) + " has two owners");
  }
  Box whole;
  for (int c = 0; c < cluster_count(); ++c) {
    Box box;
    for (int f = facet_begin(c); f < facet_end(c); ++f) {
      for (const int v : corners(f)) {
        if (v >= vertex_end(c)) broken("cluster " + std::to_string(c) + " uses a vertex of a later one");
        box = extended(box, position(v));
      }
    }
    if (!(box == cluster_boxes_[static_cast<std::size_t>(c)])) broken("box of cluster " + std::to_string(c));
    whole = merged(whole, box);
  }
  if (!(whole == box_)) broken("box of the mesh");
  for (int g = 0; g < group_count() && group_count() > 1; ++g) {
    Box box;
    for (int c = cluster_begin(g); c < cluster_end(g); ++c)
      box = merged(box, cluster_boxes_[static_cast<std::size_t>(c)]);
    if (!(box == group_boxes_[static_cast<std::size_t>(g)])) broken("box of group " + std::to_string(g));
  }
}

}  // namespace tact::narrowphase
