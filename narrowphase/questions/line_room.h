// What many segments need of the same meshes, in floats: the boxes of clusters and groups, and the corners of the
// facets of clusters, side by side. Each is made when it is first wanted, or the second time, and holds until something
// moves.
//
// Floats only propose: what a segment meets is decided by doubles. So it does not matter what there is in floats.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The boxes of a mesh: (x - origin) scale, to half a unit in the last place.
struct MeshBoxes {
  LinedBoxes clusters, groups;
  Vec3 origin;
  double scale = 1.0;
};

/// Several threads may ask at once.
class LineRoom {
 public:
  /// Forgets all. From now on there are meshes of so many clusters, numbered as they stand there, and so many segments
  /// are about to be asked.
  void begin(const std::vector<int>& cluster_counts, std::size_t segments);
  /// A cluster's facets, if they are there by now.
  const LinedFacets* facets(const ClusteredMesh& mesh, std::size_t number, int cluster);
  /// A mesh's boxes; null while another thread makes them, or if there are too few segments for so many boxes.
  const MeshBoxes* boxes(const ClusteredMesh& mesh, std::size_t number);

 private:
  // Clusters that can have their facets here at once: 20 MB, which is what 600,000 facets need.
  static constexpr std::size_t kMost = 8192;
  // Boxes that a segment pays for: to copy that many takes a tenth of its time.
  static constexpr std::size_t kBoxesPerSegment = 8;
  // What a cluster's entry says, or else which place is its own, counted from kFirstPlace. A mesh's is kFirstPlace as
  // soon as its boxes are there.
  enum State : std::uint32_t { kUnopened, kOpened, kBeingMade, kFirstPlace };

  struct MeshEntry {
    std::atomic<std::uint32_t> state = kUnopened;
    std::size_t first_cluster = 0;
    MeshBoxes boxes;
    std::vector<float> bounds;
  };
  static void fill(const ClusteredMesh& mesh, MeshEntry& entry);

  std::unique_ptr<MeshEntry[]> meshes_;
  std::size_t mesh_count_ = 0, segments_ = 0;
  std::unique_ptr<std::atomic<std::uint32_t>[]> clusters_;
  std::size_t cluster_count_ = 0;
  std::unique_ptr<LinedFacets[]> facets_;
  std::size_t place_count_ = 0;
  std::atomic<std::size_t> next_place_ = 0;
};

/// A mesh that segments are put to, and what is in floats of it, under a number; or none.
struct QuestionedMesh {
  const ClusteredMesh& mesh;
  LineRoom* room = nullptr;
  std::size_t number = 0;
};

}  // namespace tact::narrowphase
