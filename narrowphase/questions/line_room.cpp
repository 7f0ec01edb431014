#include "narrowphase/questions/line_room.h"

#include <algorithm>

#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

// The middle of a box, and a unit in which it reaches from -1 to 1 at most.
struct LocalUnit {
  Vec3 origin;
  double scale;
  explicit LocalUnit(const Box& box) : origin(0.5 * box.lower + 0.5 * box.upper) {
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max({largest, box.upper[axis] - origin[axis], origin[axis] - box.lower[axis]});
    scale = 0.5 * unit_scale(largest);
  }
};

void fill_facets(const ClusteredMesh& mesh, int cluster, LinedFacets& lined) {
  const LocalUnit unit(mesh.cluster_boxes()[static_cast<std::size_t>(cluster)]);
  for (int axis = 0; axis < 3; ++axis) lined.origin[axis] = unit.origin[axis];
  lined.scale = unit.scale;
  kernels().line_up_facets(mesh.facets_of(cluster), &lined);
}

// Makes an array new if it is to hold more than it does.
template <class Element>
void make_room(std::unique_ptr<Element[]>& array, std::size_t& count, std::size_t wanted) {
  if (wanted <= count) return;
  count = 0;
  array.reset();
  array.reset(new Element[wanted]);
  count = wanted;
}

}  // namespace

void LineRoom::begin(const std::vector<int>& cluster_counts, std::size_t segments) {
  segments_ = segments;
  make_room(meshes_, mesh_count_, cluster_counts.size());
  std::size_t clusters = 0;
  for (std::size_t i = 0; i < cluster_counts.size(); ++i) {
    meshes_[i].state.store(kUnopened, std::memory_order_relaxed);
    meshes_[i].first_cluster = clusters;
    clusters += static_cast<std::size_t>(cluster_counts[i]);
  }
  make_room(clusters_, cluster_count_, clusters);
  for (std::size_t i = 0; i < clusters; ++i) clusters_[i].store(kUnopened, std::memory_order_relaxed);
  make_room(facets_, place_count_, std::min(clusters, kMost));
  next_place_.store(0, std::memory_order_relaxed);
}

const LinedFacets* LineRoom::facets(const ClusteredMesh& mesh, std::size_t number, int cluster) {
  auto& state = clusters_[meshes_[number].first_cluster + static_cast<std::size_t>(cluster)];
  std::uint32_t seen = state.load(std::memory_order_acquire);
  if (seen >= kFirstPlace) return &facets_[seen - kFirstPlace];
  if (seen == kUnopened) {
    state.compare_exchange_strong(seen, kOpened, std::memory_order_relaxed);
    return nullptr;
  }
  if (seen != kOpened || !state.compare_exchange_strong(seen, kBeingMade, std::memory_order_relaxed)) return nullptr;
  const std::size_t place = next_place_.fetch_add(1, std::memory_order_relaxed);
  if (place >= place_count_) return nullptr;
  fill_facets(mesh, cluster, facets_[place]);
  state.store(static_cast<std::uint32_t>(kFirstPlace + place), std::memory_order_release);
  return &facets_[place];
}

void LineRoom::fill(const ClusteredMesh& mesh, MeshEntry& entry) {
  constexpr std::size_t kMore = 16;  // floats that a kernel reads past the end
  const LocalUnit unit(mesh.box());
  entry.boxes.origin = unit.origin;
  entry.boxes.scale = unit.scale;
  const auto clusters = static_cast<std::size_t>(mesh.cluster_count());
  const auto groups = static_cast<std::size_t>(mesh.group_count());
  entry.bounds.resize(6 * (clusters + groups + 2 * kMore));
  float* to = entry.bounds.data();
  const auto copy = [&](const BoxView& from, std::size_t count, LinedBoxes& boxes) {
    for (int side = 0; side < 6; ++side) {
      const int axis = side % 3;
      const double* const bound = side < 3 ? from.lower(axis) : from.upper(axis);
      const double origin = unit.origin[axis];
      boxes.bounds[side] = to;
      for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<float>((bound[i] - origin) * unit.scale);
      to += count + kMore;
    }
  };
  copy(mesh.cluster_boxes(), clusters, entry.boxes.clusters);
  copy(mesh.group_boxes(), groups, entry.boxes.groups);
}

const MeshBoxes* LineRoom::boxes(const ClusteredMesh& mesh, std::size_t number) {
  MeshEntry& entry = meshes_[number];
  std::uint32_t seen = entry.state.load(std::memory_order_acquire);
  if (seen == kFirstPlace) return &entry.boxes;
  if (seen != kUnopened || static_cast<std::size_t>(mesh.cluster_count()) > kBoxesPerSegment * segments_ ||
      !entry.state.compare_exchange_strong(seen, kBeingMade, std::memory_order_relaxed))
    return nullptr;
  fill(mesh, entry);
  entry.state.store(kFirstPlace, std::memory_order_release);
  return &entry.boxes;
}

}  // namespace tact::narrowphase
