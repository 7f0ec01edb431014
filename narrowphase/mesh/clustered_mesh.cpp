#include "narrowphase/mesh/clustered_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "engine/base/parallel.h"

namespace tact::narrowphase {

namespace {

// Clusters that a thread refreshes at a time: at least a group, so that whoever is cut into ranges has groups.
constexpr int kFewestInRange = kGroupSize, kMostInRange = 256;
// Vertices whose positions are asked for ahead: fewer where a body is small, as none are for its last.
constexpr int kFewestAhead = 64, kMostAhead = 128;
constexpr int kMostMeasured = 128;  // facets
constexpr int kFirstUse = -1;

Box to_box(const BoxBounds& b) { return {{b.lower[0], b.lower[1], b.lower[2]}, {b.upper[0], b.upper[1], b.upper[2]}}; }

double spread_of(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  const double extent = size.x + size.y + size.z;
  return extent * extent;
}

bool is_within(const Box& box, double largest) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.lower[axis] >= -largest && box.upper[axis] <= largest)) return false;
  }
  return true;
}

[[noreturn]] void broken(const std::string& what) { throw std::logic_error("ClusteredMesh: " + what); }

}  // namespace

void BoxArrays::resize(std::size_t count) {
  stride_ = count;
  if (bounds_.size() < 6 * count + kPadding) bounds_.resize(6 * count + kPadding);
}

PositionProblem find_position_problem(const double* positions, std::size_t count, double largest) {
  const auto is_good = [&](double x) { return std::abs(x) <= largest; };
  const double *end = positions + 3 * count, *bad = std::find_if_not(positions, end, is_good);
  if (bad == end) return {};
  const auto at = bad - positions;
  const auto kind = std::isfinite(*bad) ? PositionProblem::out_of_range : PositionProblem::non_finite;
  return {kind, static_cast<int>(at / 3), static_cast<int>(at % 3)};
}

struct ClusteredMesh::Numbering {
  std::vector<int> ranges;  // of each cluster and one more
  std::vector<int> source_vertices;
  std::vector<int> borrowed, borrowed_sources;
  std::vector<int> unused_sources;
  std::vector<std::uint8_t> corner[3];
};

ClusteredMesh::ClusteredMesh(std::span<const double> positions, std::span<const int> facets)
    : source_vertex_count_(static_cast<int>(positions.size() / 3)), facet_count_(static_cast<int>(facets.size() / 3)) {
  const std::vector<int> order = facet_order(positions, facets, source_vertex_count_);
  take_memory(number_vertices(facets, order), order);
  set_positions(positions.data(), 1);
  box_ = box_of(placed_);  // if all positions are zero, nothing changed
}

ClusteredMesh::Numbering ClusteredMesh::number_vertices(std::span<const int> facets, std::span<const int> order) const {
  Numbering made;
  std::vector<int> number(static_cast<std::size_t>(source_vertex_count_), kFirstUse);
  std::vector<int> last_user(static_cast<std::size_t>(source_vertex_count_), kFirstUse);
  std::vector<int> place(static_cast<std::size_t>(source_vertex_count_), 0);  // among those that the last user borrows
  const auto source_of = [&](int f, int k) {
    return facets[3 * static_cast<std::size_t>(order[static_cast<std::size_t>(f)]) + static_cast<std::size_t>(k)];
  };
  const auto vertices = [&] { return static_cast<int>(made.source_vertices.size()); };
  std::vector<int> owned_here, borrowed_here;
  for (auto& corner : made.corner) corner.assign(static_cast<std::size_t>(facet_count()), 0);
  for (int c = 0; c < cluster_count(); ++c) {
    const int first = vertices(), first_borrowed = static_cast<int>(made.borrowed.size());
    made.ranges.insert(made.ranges.end(), {first, first_borrowed});
    owned_here.clear();
    borrowed_here.clear();
    for (int i = 0; i < 3 * (facet_end(c) - facet_begin(c)); ++i) {
      const int source = source_of(facet_begin(c) + i / 3, i % 3);
      const auto s = static_cast<std::size_t>(source);
      if (last_user[s] == c) continue;
      last_user[s] = c;
      (number[s] == kFirstUse ? owned_here : borrowed_here).push_back(source);
    }
    // In the caller's order: neighbours in memory are read one after the other.
    std::ranges::sort(owned_here);
    std::ranges::sort(borrowed_here);
    for (const int source : owned_here) {
      number[static_cast<std::size_t>(source)] = vertices();
      made.source_vertices.push_back(source);
    }
    for (const int source : borrowed_here) {
      place[static_cast<std::size_t>(source)] = static_cast<int>(made.borrowed.size()) - first_borrowed;
      made.borrowed.push_back(number[static_cast<std::size_t>(source)]);
      made.borrowed_sources.push_back(source);
    }
    const int owned = vertices() - first;
    for (int f = facet_begin(c); f < facet_end(c); ++f) {
      for (int k = 0; k < 3; ++k) {
        const auto s = static_cast<std::size_t>(source_of(f, k));
        const int local = number[s] < first ? owned + place[s] : number[s] - first;
        made.corner[k][static_cast<std::size_t>(f)] = static_cast<std::uint8_t>(local);
      }
    }
  }
  made.ranges.insert(made.ranges.end(), {vertices(), static_cast<int>(made.borrowed.size())});
  for (int s = 0; s < source_vertex_count_; ++s) {
    if (number[static_cast<std::size_t>(s)] == kFirstUse) made.unused_sources.push_back(s);
  }
  return made;
}

ClusteredMesh::MemorySize ClusteredMesh::memory_size() const {
  const auto clusters = static_cast<std::size_t>(cluster_count()), groups = static_cast<std::size_t>(group_count());
  const auto facets = static_cast<std::size_t>(facet_count_), borrowed = static_cast<std::size_t>(borrowed_count_);
  return {.placement = 3 * stride_ + 6 * (clusters + groups),
          .indices = 2 * clusters + 2 + stride_ + borrowed,
          .rest = (static_cast<std::size_t>(unused_count_) + borrowed + 2 * facets) * sizeof(int) + 3 * facets};
}

void ClusteredMesh::lay_out(const Memory& memory) {
  placed_ = memory.placement[0];
  other_ = memory.placement[1];
  ranges_ = memory.indices;
  unused_sources_ = reinterpret_cast<int*>(memory.rest);
  borrowed_ = unused_sources_ + unused_count_;
  source_facet_ = borrowed_ + borrowed_count_;
  facet_of_source_ = source_facet_ + facet_count_;
  corner_[0] = reinterpret_cast<std::uint8_t*>(facet_of_source_ + facet_count_);
  corner_[1] = corner_[0] + facet_count_;
  corner_[2] = corner_[1] + facet_count_;
}

void ClusteredMesh::take_memory(const Numbering& numbering, std::span<const int> order) {
  vertex_count_ = static_cast<int>(numbering.source_vertices.size());
  borrowed_count_ = static_cast<int>(numbering.borrowed.size());
  unused_count_ = static_cast<int>(numbering.unused_sources.size());
  stride_ = static_cast<std::size_t>(vertex_count());
  const MemorySize size = memory_size();
  const std::size_t placements = (2 * size.placement + kPadding) * sizeof(double);
  constexpr std::size_t kEnd = kPadding * sizeof(double);
  memory_ = std::make_unique<std::byte[]>(placements + size.indices * sizeof(int) + size.rest + kEnd);
  double* const first = reinterpret_cast<double*>(memory_.get());
  int* const indices = reinterpret_cast<int*>(memory_.get() + placements);
  lay_out({{first, first + size.placement}, indices, reinterpret_cast<std::byte*>(indices + size.indices)});
  int* at = std::ranges::copy(numbering.ranges, ranges_).out;
  at = std::ranges::copy(numbering.source_vertices, at).out;
  std::ranges::copy(numbering.borrowed_sources, at);
  std::ranges::copy(numbering.unused_sources, unused_sources_);
  std::ranges::copy(numbering.borrowed, borrowed_);
  std::ranges::copy(order, source_facet_);
  for (int f = 0; f < facet_count(); ++f) facet_of_source_[source_facet(f)] = f;
  for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(numbering.corner[k], corner_[k]);
}

void ClusteredMesh::move_to(const Memory& memory) {
  const MemorySize size = memory_size();
  std::copy_n(placed_, size.placement, memory.placement[0]);
  std::copy_n(other_, size.placement, memory.placement[1]);
  std::copy_n(ranges_, size.indices, memory.indices);
  std::copy_n(reinterpret_cast<const std::byte*>(unused_sources_), size.rest, memory.rest);
  lay_out(memory);
  memory_.reset();
}

ClusterFacets ClusteredMesh::facets_of(int cluster) const {
  const int first = facet_begin(cluster), borrowed = borrowed_begin(cluster);
  return {.points = points(),
          .owned_begin = vertex_begin(cluster),
          .owned_count = vertex_end(cluster) - vertex_begin(cluster),
          .borrowed = borrowed_ + borrowed,
          .borrowed_count = borrowed_begin(cluster + 1) - borrowed,
          .corner = {corner_[0] + first, corner_[1] + first, corner_[2] + first},
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

ClusteredMesh::Refresh ClusteredMesh::refresh(const double* positions, double largest, int threads, bool asks_ahead) {
  const int per_range = std::clamp(cluster_count() / (4 * threads), kFewestInRange, kMostInRange);
  const int ranges = (cluster_count() + per_range - 1) / per_range;
  const bool in_ranges = threads > 1 && ranges > 1;
  Refreshed all{};
  if (!in_ranges) {
    all = refresh_range(positions, 0, cluster_count(), asks_ahead);
  } else {
    std::atomic<bool> any_changed{false}, any_not_a_number{false};
    base::parallel_for(static_cast<std::size_t>(ranges), 1, threads, [&](std::size_t i) {
      const int begin = static_cast<int>(i) * per_range;
      const Refreshed range = refresh_range(positions, begin, std::min(begin + per_range, cluster_count()), asks_ahead);
      if (range.changed) any_changed = true;
      if (range.not_a_number) any_not_a_number = true;
    });
    all.changed = any_changed;
    all.not_a_number = any_not_a_number;
  }
  refresh_groups();
  const Box box = in_ranges ? box_of(other_) : to_box(all.box);
  const auto unused_is_bad = [&](int vertex) {
    const double* position = positions + 3 * static_cast<std::ptrdiff_t>(vertex);
    return find_position_problem(position, 1, largest).kind != PositionProblem::none;
  };
  if (all.not_a_number || !is_within(box, largest) ||
      std::any_of(unused_sources_, unused_sources_ + unused_count_, unused_is_bad))
    return Refresh::bad;
  if (!all.changed) return Refresh::same;
  std::swap(placed_, other_);
  box_ = box;
  return Refresh::changed;
}

void ClusteredMesh::take_back() {
  std::swap(placed_, other_);
  box_ = box_of(placed_);
}

Placement ClusteredMesh::placement_in(const double* memory) const {
  return {{memory, memory + stride_, memory + 2 * stride_}, cluster_boxes(memory), box_of(memory)};
}

bool ClusteredMesh::set_positions(const double* positions, int threads) {
  return refresh(positions, std::numeric_limits<double>::infinity(), threads) == Refresh::changed;
}

void ClusteredMesh::prefetch(const double* positions) const {
  prefetch_lines(positions, 3 * static_cast<std::size_t>(source_vertex_count_) + 1);  // masked loads touch one more
  prefetch_lines(ranges_, static_cast<std::size_t>(2 * cluster_count() + 2 + vertex_reads()));
  prefetch_lines(other_, 3 * stride_ + 6 * static_cast<std::size_t>(cluster_count() + group_count()));
  prefetch_line(placed_);  // if anything moves, the first x of all do
}

// From the boxes of the clusters, or of the groups if there are several.
Box ClusteredMesh::box_of(const double* placement) const {
  const bool has_groups = group_count() > 1;
  const BoxView boxes = has_groups ? group_boxes(placement) : cluster_boxes(placement);
  return to_box(kernels().bounds(boxes.pointers(), has_groups ? group_count() : cluster_count()));
}

Refreshed ClusteredMesh::refresh_range(const double* positions, int cluster_begin, int cluster_end,
                                       bool asks_ahead) const {
  // Positions are gathered cluster by cluster, in an order that no hardware foresees. A small body was asked for whole.
  const int ahead = std::clamp(vertex_count() / 8, kFewestAhead, kMostAhead);
  return kernels().refresh_clusters({.source = positions,
                                     .cluster_begin = cluster_begin,
                                     .cluster_end = cluster_end,
                                     .ranges = ranges_,
                                     .owned = source_vertices(),
                                     .borrowed = borrowed_sources(),
                                     .ahead = asks_ahead && vertex_count() > ahead ? ahead : 0,
                                     .before = {placed_, placed_ + stride_, placed_ + 2 * stride_},
                                     .x = other_,
                                     .y = other_ + stride_,
                                     .z = other_ + 2 * stride_,
                                     .boxes = other_ + 3 * stride_,
                                     .box_stride = cluster_count()});
}

void ClusteredMesh::refresh_groups() const {
  if (group_count() <= 1) return;
  double* const bounds = other_ + 3 * stride_ + 6 * static_cast<std::size_t>(cluster_count());
  for (int g = 0; g < group_count(); ++g) {
    const int begin = cluster_begin(g), count = cluster_end(g) - begin;
    const Box box = to_box(kernels().bounds(cluster_boxes(other_).pointers(begin), count));
    set_box(bounds, static_cast<std::size_t>(group_count()), static_cast<std::size_t>(g), box);
  }
}

double ClusteredMesh::spread() const {
  const BoxView boxes = cluster_boxes();
  double sum = 0.0;
  for (int c = 0; c < cluster_count(); ++c) sum += spread_of(boxes[static_cast<std::size_t>(c)]);
  return sum;
}

// Facets are taken by the caller's numbers, which grouping does not change.
double ClusteredMesh::looseness() const {
  const int step = (facet_count() + kMostMeasured - 1) / kMostMeasured;
  double sum = 0.0;
  int measured = 0;
  for (int source = 0; source < facet_count(); source += step, ++measured) {
    Box box;
    for (const int v : corners(facet_of_source(source))) box = extended(box, position(v));
    sum += spread_of(box);
  }
  return sum > 0.0 ? spread() / (sum / measured * facet_count()) : 0.0;
}

ClusteredMesh ClusteredMesh::regrouped() const {
  std::vector<double> positions(3 * static_cast<std::size_t>(source_vertex_count_), 0.0);
  std::vector<int> facets(3 * static_cast<std::size_t>(facet_count_));
  for (int v = 0; v < vertex_count(); ++v) {
    const Vec3 p = position(v);
    for (int axis = 0; axis < 3; ++axis)
      positions[3 * static_cast<std::size_t>(source_vertex(v)) + static_cast<std::size_t>(axis)] = p[axis];
  }
  for (int f = 0; f < facet_count(); ++f) {
    const Corners c = corners(f);
    for (std::size_t k = 0; k < 3; ++k) facets[3 * static_cast<std::size_t>(source_facet(f)) + k] = source_vertex(c[k]);
  }
  return {positions, facets};
}

std::vector<int> ClusteredMesh::numbers_in(const ClusteredMesh& other) const {
  std::vector<int> of_source(static_cast<std::size_t>(source_vertex_count_)), numbers;
  for (int v = 0; v < other.vertex_count(); ++v) of_source[static_cast<std::size_t>(other.source_vertex(v))] = v;
  numbers.reserve(static_cast<std::size_t>(vertex_count()));
  for (int v = 0; v < vertex_count(); ++v) numbers.push_back(of_source[static_cast<std::size_t>(source_vertex(v))]);
  return numbers;
}

Triangle ClusteredMesh::triangle(int facet) const {
  const Corners c = corners(facet);
  return {position(c[0]), position(c[1]), position(c[2])};
}

void ClusteredMesh::validate() const {
  std::vector<char> seen(static_cast<std::size_t>(facet_count()), 0);
  for (const int f : std::span(source_facet_, static_cast<std::size_t>(facet_count()))) {
    if (f < 0 || f >= facet_count() || seen[static_cast<std::size_t>(f)]++) broken("source facet " + std::to_string(f));
    if (source_facet(facet_of_source(f)) != f) broken("the place of source facet " + std::to_string(f));
  }
  std::vector<char> owned(static_cast<std::size_t>(source_vertex_count_), 0);
  for (const int s : std::span(source_vertices(), static_cast<std::size_t>(vertex_count()))) {
    if (owned[static_cast<std::size_t>(s)]++) broken("source vertex " + std::to_string(s) + " has two owners");
  }
  for (int c = 0; c < cluster_count(); ++c) {
    if (!std::is_sorted(source_vertices() + vertex_begin(c), source_vertices() + vertex_end(c)))
      broken("the order of the vertices of cluster " + std::to_string(c));
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
    if (!(box == cluster_boxes()[static_cast<std::size_t>(c)])) broken("box of cluster " + std::to_string(c));
    whole = merged(whole, box);
  }
  if (!(whole == box())) broken("box of the mesh");
  for (int g = 0; g < group_count() && group_count() > 1; ++g) {
    Box box;
    for (int c = cluster_begin(g); c < cluster_end(g); ++c)
      box = merged(box, cluster_boxes()[static_cast<std::size_t>(c)]);
    if (!(box == group_boxes()[static_cast<std::size_t>(g)])) broken("box of group " + std::to_string(g));
  }
}

}  // namespace tact::narrowphase
