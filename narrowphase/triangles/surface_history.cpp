#include "narrowphase/triangles/surface_history.h"

#include <algorithm>
#include <utility>

#include "narrowphase/pairs/box_reach.h"

namespace tact::narrowphase {

namespace {

// A step of less than this part of a cluster's side, a tenth of an edge, is little: a gap of an edge then lasts for
// some steps. Of a mesh without travel so many vertices are looked at.
constexpr double kLittle = 1.0 / 128.0;
constexpr int kLookedAt = 16;

// Certificates pay if they tell of half of the pairs at least: they cost the travel of both bodies, half a refresh, and
// wider boxes of facets (tact-bench rivals: sheets in layers, where they tell of fewer, 3.2 ms with them, 2.3 without;
// stack of 20 17.5 and 21.9). Else they are tried again after a pause, which doubles up to so many steps.
constexpr std::int64_t kLeastSaved = 2;

// A facet pair that floats leave open costs 50 ns more than among blocks of facets, as its corners are gathered one by
// one; a cluster pair that is apart, among long facets, of which floats leave most open, is worth some of them. Seen:
// twisted rods of long facets leave 67 and 165 and take 1.09 and 1.10 of the time of blocks, a drape of 13 k 24 and
// takes half of it.
constexpr std::int64_t kOpenForOne = 48;

double side_of(const ClusteredMesh& mesh) {
  constexpr int kMeasured = 16;
  const int step = (mesh.cluster_count() + kMeasured - 1) / kMeasured;
  double sum = 0.0;
  int count = 0;
  for (int c = 0; c < mesh.cluster_count(); c += step, ++count) sum += longest_side(mesh.cluster_boxes()[c]);
  return sum / count;
}

double longest_step(const ClusteredMesh& mesh) {
  double longest = 0.0;
  if (mesh.travel() != nullptr) {
    for (int c = 0; c < mesh.cluster_count(); ++c) longest = std::max(longest, mesh.travel()->last_of(c));
    return longest;
  }
  const PointArrays now = mesh.points(), before = mesh.placements().before().points;
  const int step = (mesh.vertex_count() + kLookedAt - 1) / kLookedAt;
  for (int v = 0; v < mesh.vertex_count(); v += step)
    longest = std::max(longest, norm(Vec3{now.x[v], now.y[v], now.z[v]} - Vec3{before.x[v], before.y[v], before.z[v]}));
  return longest;
}

// A rigid mesh does not know where it was, nor how far it goes.
bool moves_little(const ClusteredMesh& mesh) {
  return !mesh.is_rigid() && longest_step(mesh) < kLittle * side_of(mesh);
}

}  // namespace

bool SurfaceHistory::OfBody::start(const ClusteredMesh& now, bool& same) {
  const bool stands = mesh == &now && epoch == now.travel_epoch();
  same = same && stands;
  mesh = &now;
  epoch = now.travel_epoch();
  if (stands && now.travel() == nullptr) return true;
  wants_travel = moves_little(now);
  return wants_travel && now.travel() != nullptr;
}

bool SurfaceHistory::start(const ConfirmInput& input, const std::vector<ClusterPair>& pairs) {
  std::swap(last_, now_);
  now_.clear();
  of_a_.wants_travel = of_b_.wants_travel = false;
  if (certificates_.takes_step()) return false;
  bool same = true;
  const bool use_a = of_a_.start(*input.a, same), use_b = of_b_.start(*input.b, same);
  if (!same) last_.clear();
  if (!use_a || !use_b) return false;
  now_.resize(pairs.size());
  return true;
}

void SurfaceHistory::finish(std::int64_t still_apart) {
  if (last_.empty()) return;  // there were none to use
  certificates_.judge(kLeastSaved * still_apart >= static_cast<std::int64_t>(now_.size()));
}

void SurfaceHistory::weigh(const ConfirmCounts& counts) {
  surfaces_.judge(counts.left_open <= kOpenForOne * (counts.plane_apart + counts.still_apart));
}

void Pause::judge(bool pays) {
  if (pays) {
    next_ = kFirst;
    return;
  }
  left_ = next_;
  next_ = std::min(2 * next_, kLongest);
}

}  // namespace tact::narrowphase
