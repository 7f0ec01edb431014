#include "narrowphase/triangles/surface_pairs.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "engine/base/lowest_bits.h"
#include "narrowphase/numeric/frame.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/pairs/box_reach.h"
#include "narrowphase/triangles/surface_history.h"

namespace tact::narrowphase {

namespace {

// Bounds of rounding, in parts of the reach of two clusters together; u = 2^-24. A vertex as a float is off by u of
// each coordinate; its height along an axis, of length 1, by 4 u of the sum of three products more, which is at most
// 1.74 times the reach: in all less than 7 u. Where a cluster of B is moved to the origin of A, the way, of at
// most 1.74 times both reaches, and the sum are rounded once more, which makes 13 u.
constexpr double kHeightError = 0x1p-21, kPlaceError = 0x1p-20;
constexpr double kLeastError = 1e-36;  // of what vanishes in floats

// Cells of the grid over a cluster of A: some are left free on both sides for what lies beyond it. Each is so large
// that rounding cannot move a facet into these.
constexpr double kMostCells = 32000.0, kFreeCells = 2.0, kSmallestCell = 0x1p-18;
constexpr std::int16_t kLast = static_cast<std::int16_t>(kLastCell), kLastOfA = kLast - 1;
constexpr CellBox kAllCells{{0, 0, 0}, {kLast, kLast, kLast}};
constexpr CellBox kCellsOfA{{1, 1, 1}, {kLastOfA, kLastOfA, kLastOfA}};

// How long a certificate of facets' boxes is to last, in steps like the last one, and how much these are widened for
// it, in parts of a cluster's half side, at most.
constexpr double kLastingSteps = 32.0, kMostSlack = 1.0 / 16.0;
// More than the axes' rounding, by which a distance along one may be too long.
constexpr double kShorter = 1.0 - 0x1p-18;

// Floats: of the cluster of A, which comes first, and those that may be read beyond the last.
constexpr std::size_t kFloatsOfA = 3 * LocalVertices::kMost, kReadBeyond = 64;

int in_runs(int vertices) { return (vertices + LocalVertices::kRun - 1) / LocalVertices::kRun * LocalVertices::kRun; }

// A unit vector, or across the box's two longest sides if there is no normal.
Vec3 direction_of(const float* normal, const Box& box) {
  const Vec3 n{normal[0], normal[1], normal[2]};
  const double length = norm(n);
  if (length > 1e-30 && length < 1e30) return (1.0 / length) * n;
  const Vec3 size = box.upper - box.lower;
  if (size.z <= size.x && size.z <= size.y) return {0.0, 0.0, 1.0};
  return size.y <= size.x ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
}

void set_axis(float (&axis)[3], Vec3 v) {
  for (int k = 0; k < 3; ++k) axis[k] = static_cast<float>(v[k]);
}

double along(const float (&axis)[3], Vec3 v) {
  return (static_cast<double>(axis[0]) * v.x + static_cast<double>(axis[1]) * v.y) + static_cast<double>(axis[2]) * v.z;
}

// Of the facet with this number in the cluster.
void add_corners(const ClusterFacets& cluster, int facet, FacetBlock& block) {
  const double* const points[3] = {cluster.points.x, cluster.points.y, cluster.points.z};
  for (int k = 0; k < 3; ++k) {
    const int place = cluster.corner[k][facet];
    const int vertex =
        place < cluster.owned_count ? cluster.owned_begin + place : cluster.borrowed[place - cluster.owned_count];
    for (int axis = 0; axis < 3; ++axis) block.corner[k][axis][block.count] = points[axis][vertex];
  }
  block.facet[block.count++] = cluster.facet_begin + facet;
}

double last_step_of(const ClusteredMesh& a, int cluster_a, const ClusteredMesh& b, int cluster_b) {
  return (a.travel() == nullptr ? 0.0 : a.travel()->last_of(cluster_a)) +
         (b.travel() == nullptr ? 0.0 : b.travel()->last_of(cluster_b));
}

// For steps of this length. Of an endless one, whose length is not a number, as of a long one.
double slack_for(double step, double half_side) {
  const double lasting = kLastingSteps * step, most = kMostSlack * half_side;
  return lasting >= 0.0 && lasting <= most ? lasting : most;
}

OpenedCluster all_of(const ClusteredMesh& mesh, int cluster, std::int32_t index) {
  OpenedCluster opened{index, {}};
  opened.counts.opened_clusters = 1;
  opened.counts.kept = mesh.facet_end(cluster) - mesh.facet_begin(cluster);
  for (int f = mesh.facet_begin(cluster); f < mesh.facet_end(cluster) && !mesh.has_surface_alone(); ++f)
    opened.counts.kept_bare += mesh.is_of_surface(mesh.source_facet(f)) ? 0 : 1;
  return opened;
}

}  // namespace

void SurfacePairSearch::run(const ConfirmInput& input, const std::vector<ClusterPair>& pairs, std::size_t begin,
                            std::size_t end, std::vector<FacetPair>& found, ConfirmCounts& counts) {
  const Box all = merged(input.a->box(), input.b->box());
  bounds_ = bounds_of(all);
  scale_ = unit_scale(longest_side(all));
  opened_a_.clear();
  opened_b_.clear();
  open_a_.count = open_b_.count = 0;
  floats_used_ = kFloatsOfA;
  b_.assign(input.kept_b->count(), {});
  next_certificate_ = 0;
  for (std::size_t i = begin; i < end;) {
    const std::size_t first = i;
    while (i < end && pairs[i].a == pairs[first].a) ++i;
    const auto of_a = std::span(pairs).subspan(first, i - first);
    if (input.history == nullptr || !still_apart(input, of_a, first, counts))
      look_at(input, of_a, first, found, counts);
  }
  decide_open(input, found, counts);
}

LocalVertices SurfacePairSearch::vertices_of(const LocalCluster& cluster) {
  float* const x = floats_.data() + cluster.floats;
  const int run = in_runs(cluster.vertices);
  return {x, x + run, x + 2 * run};
}

// Returns where its floats end.
std::size_t SurfacePairSearch::take(const ClusteredMesh& mesh, int cluster, std::size_t floats, LocalCluster& local) {
  const Box box = mesh.cluster_boxes()[cluster];
  const ClusterFacets facets = mesh.facets_of(cluster);
  const Vec3 origin = 0.5 * box.lower + 0.5 * box.upper;
  const Vec3 below = origin - box.lower, above = box.upper - origin;
  local.origin = origin;
  local.reach = 1.000001 * scale_ * std::max({below.x, below.y, below.z, above.x, above.y, above.z});
  local.vertices = facets.owned_count + facets.borrowed_count;
  local.floats = floats;
  local.taken = true;
  const std::size_t end = floats + 3 * static_cast<std::size_t>(in_runs(local.vertices));
  if (floats_.size() < end + kReadBeyond) floats_.resize(2 * (end + kReadBeyond));
  const double from[3] = {origin.x, origin.y, origin.z};
  kernels().localize(facets, from, scale_, vertices_of(local));
  return end;
}

// True if all pairs of a cluster of A are as far apart as the last step's certificates say. Keeps these.
bool SurfacePairSearch::still_apart(const ConfirmInput& input, std::span<const ClusterPair> pairs, std::size_t first,
                                    ConfirmCounts& counts) {
  const std::span<const SurfaceHistory::Certificate> last = input.history->last();
  const std::span<SurfaceHistory::Certificate> now = input.history->now().subspan(first, pairs.size());
  const int cluster_a = input.kept_a->cluster[pairs[0].a];
  if (next_certificate_ == 0) {
    const auto before = [](const SurfaceHistory::Certificate& c, int cluster) { return c.a < cluster; };
    next_certificate_ =
        static_cast<std::size_t>(std::lower_bound(last.begin(), last.end(), cluster_a, before) - last.begin());
  }
  while (next_certificate_ < last.size() && last[next_certificate_].a < cluster_a) ++next_certificate_;
  std::size_t apart = 0;
  std::size_t next = next_certificate_;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const int cluster_b = input.kept_b->cluster[pairs[i].b];
    now[i] = {cluster_a, cluster_b, 0.0};
    while (next < last.size() && last[next].a == cluster_a && last[next].b < cluster_b) ++next;
    if (next < last.size() && last[next].a == cluster_a && last[next].b == cluster_b &&
        travel_of(*input.a, cluster_a, *input.b, cluster_b) < last[next].until)
      now[i].until = last[next].until;
    apart += now[i].until > 0.0 ? 1 : 0;
  }
  counts.still_apart += static_cast<std::int64_t>(apart);
  return apart == pairs.size();
}

// The pairs of one cluster of A, from the first-th of all. Those that a plane separates need no more.
void SurfacePairSearch::look_at(const ConfirmInput& input, std::span<const ClusterPair> pairs, std::size_t first,
                                std::vector<FacetPair>& found, ConfirmCounts& counts) {
  const std::int32_t index_a = pairs[0].a, cluster_a = input.kept_a->cluster[index_a];
  take(*input.a, cluster_a, 0, a_);
  const ClusterFacets facets_a = input.a->facets_of(cluster_a);
  float normal[3];
  kernels().mean_normal(vertices_of(a_), facets_a, normal);
  set_axis(frame_.axis[2], direction_of(normal, input.kept_a->boxes[index_a]));
  const LocalRange range_a = kernels().range_along(vertices_of(a_), a_.vertices, frame_.axis[2]);
  bool placed = false;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::int32_t index_b = pairs[i].b, cluster_b = input.kept_b->cluster[index_b];
    SurfaceHistory::Certificate* const certificate =
        input.history == nullptr ? nullptr : &input.history->now()[first + i];
    if (certificate != nullptr && certificate->until > 0.0) continue;
    LocalCluster& b = b_[index_b];
    if (!b.taken) floats_used_ = take(*input.b, cluster_b, floats_used_, b);
    const auto certify = [&](double gap) {
      if (certificate == nullptr) return;
      certificate->until = apart_until(travel_of(*input.a, cluster_a, *input.b, cluster_b), gap);
    };
    if (const double gap = gap_along_normal(b, range_a); gap > 0.0) {
      certify(kShorter * gap / scale_);
      ++counts.plane_apart;
      continue;
    }
    if (!std::exchange(placed, true)) {
      place_a(facets_a, range_a);
      opened_a_.push_back(all_of(*input.a, cluster_a, index_a));
    }
    if (!std::exchange(b.opened, true)) opened_b_.push_back(all_of(*input.b, cluster_b, index_b));
    const double slack = certificate == nullptr
                             ? 0.0
                             : slack_for(last_step_of(*input.a, cluster_a, *input.b, cluster_b), a_.reach / scale_);
    if (!find_meeting(input, facets_a, input.b->facets_of(cluster_b), b, slack, found, counts))
      certify(kShorter * slack);
  }
}

// How far a plane along the normal of a_ separates it from `b`, at least, in the unit; not positive: not at all.
double SurfacePairSearch::gap_along_normal(const LocalCluster& b, const LocalRange& range_a) {
  const LocalRange range_b = kernels().range_along(vertices_of(b), b.vertices, frame_.axis[2]);
  const double way = along(frame_.axis[2], scale_ * (b.origin - a_.origin));
  const double gap = std::max(static_cast<double>(range_b.lower) + way - static_cast<double>(range_a.upper),
                              static_cast<double>(range_a.lower) - way - static_cast<double>(range_b.upper));
  return gap - kHeightError * (a_.reach + b.reach) - kLeastError;
}

// The facets of a_ in a frame along its normal, and the grid there.
void SurfacePairSearch::place_a(const ClusterFacets& facets, const LocalRange& along_normal) {
  const Vec3 n{frame_.axis[2][0], frame_.axis[2][1], frame_.axis[2][2]};
  const Frame across = frame_across(normalized(n));
  set_axis(frame_.axis[0], across.u);
  set_axis(frame_.axis[1], across.v);
  const LocalVertices vertices = vertices_of(a_);
  for (int axis = 0; axis < 3; ++axis) {
    const LocalRange range = axis == 2 ? along_normal : kernels().range_along(vertices, a_.vertices, frame_.axis[axis]);
    const double length = static_cast<double>(range.upper) - static_cast<double>(range.lower);
    const double cell = std::max(length / kMostCells, kSmallestCell * a_.reach + kLeastError);
    cell_[axis] = cell;
    frame_.cell_origin[axis] = static_cast<float>(static_cast<double>(range.lower) - kFreeCells * cell);
    frame_.cell_scale[axis] = static_cast<float>(1.0 / cell);
    frame_.offset[axis] = 0.0f;
  }
  frame_.margin = 0.0f;
  frame_.error = kPlaceError * a_.reach + kLeastError;
  kernels().place_facets(vertices, facets, frame_, kAllCells, &placed_a_.corners, &placed_a_.cells);
}

// The facets of a_ and of `b`, in the frame of a_. False: they are all apart by more than `slack`, metres.
bool SurfacePairSearch::find_meeting(const ConfirmInput& input, const ClusterFacets& facets_a,
                                     const ClusterFacets& facets_b, const LocalCluster& b, double slack,
                                     std::vector<FacetPair>& found, ConfirmCounts& counts) {
  LocalFrame frame = frame_;
  frame.error = kPlaceError * (a_.reach + b.reach) + kLeastError;
  frame.margin = static_cast<float>(frame.error + 1.0001 * scale_ * slack);
  double gap[3];
  for (int axis = 0; axis < 3; ++axis) {
    frame.offset[axis] = static_cast<float>(along(frame.axis[axis], scale_ * (b.origin - a_.origin)));
    gap[axis] = 1.01 * cell_[axis] + 4.0 * frame.error + 2.0 * scale_ * slack;
  }
  const std::uint64_t near_b =
      kernels().place_facets(vertices_of(b), facets_b, frame, kCellsOfA, &placed_b_.corners, &placed_b_.cells);
  if (near_b == 0) return false;
  const std::uint64_t near_a = kernels().near_facets(placed_a_.cells, base::lowest_bits(facets_a.facet_count),
                                                     kernels().cells_of(placed_b_.cells, near_b));
  if (near_a == 0) return false;
  const bool few_are_b = std::popcount(near_b) < std::popcount(near_a);
  const PlacedFacets &few = few_are_b ? placed_b_ : placed_a_, &many = few_are_b ? placed_a_ : placed_b_;
  const std::uint64_t of_few = few_are_b ? near_b : near_a, of_many = few_are_b ? near_a : near_b;
  const SharedCells shared = kernels().share_cells(few.cells, of_few, many.cells, of_many, met_);
  counts.facet_box_pairs += shared.pairs;
  if (shared.pairs == 0) return false;
  kernels().leave_aside(few.corners, shared.facets, many.corners, gap, static_cast<float>(1.001 * scale_ * slack),
                        slack > 0.0 ? 1 : static_cast<int>(input.tuning->worth_a_plane), met_);
  bool any = false;
  for (std::uint64_t left = shared.facets; left != 0;) {
    listed_.count = 0;
    left = kernels().list_pairs(left, met_, few_are_b, &listed_);
    if (listed_.count == 0) break;
    any = true;
    const PairMatches matches = kernels().match_float_pairs(placed_a_.corners, placed_b_.corners, listed_, gap);
    const auto pair_of = [&](std::uint64_t bits) {
      const auto k = static_cast<std::size_t>(std::countr_zero(bits));
      return FacetPair{listed_.a[k], listed_.b[k]};
    };
    for (std::uint64_t meeting = matches.meeting; meeting != 0; meeting &= meeting - 1) {
      const FacetPair pair = pair_of(meeting);
      found.push_back(
          {input.a->source_facet(facets_a.facet_begin + pair.a), input.b->source_facet(facets_b.facet_begin + pair.b)});
    }
    counts.left_open += std::popcount(matches.undecided);
    for (std::uint64_t open = matches.undecided; open != 0; open &= open - 1) {
      const FacetPair pair = pair_of(open);
      add_corners(facets_a, pair.a, open_a_);
      add_corners(facets_b, pair.b, open_b_);
      if (open_a_.count == FacetBlock::kCapacity) decide_open(input, found, counts);
    }
  }
  return any;
}

// The pairs that floats left open, in doubles and exactly.
void SurfacePairSearch::decide_open(const ConfirmInput& input, std::vector<FacetPair>& found, ConfirmCounts& counts) {
  FacetPairList pairs;
  pairs.count = open_a_.count;
  if (pairs.count == 0) return;
  std::iota(pairs.a, pairs.a + pairs.count, std::uint8_t{0});
  std::iota(pairs.b, pairs.b + pairs.count, std::uint8_t{0});
  for (std::uint64_t meeting = decided_.meeting_of(open_a_, open_b_, pairs, bounds_, counts); meeting != 0;
       meeting &= meeting - 1) {
    const int k = std::countr_zero(meeting);
    found.push_back({input.a->source_facet(open_a_.facet[k]), input.b->source_facet(open_b_.facet[k])});
  }
  open_a_.count = open_b_.count = 0;
}

}  // namespace tact::narrowphase
