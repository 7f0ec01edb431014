// The rows of meshes of the benchmark `error`: two bodies that deform, every facet pair in query.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/error/measure.h"
#include "bench/rivals/rival.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {

// Bodies a and b of a workload, and what is true of them, frame by frame.
struct MeshRow {
  std::string name;
  Workload workload;
  std::vector<std::vector<FacetMeeting>> meetings;
  // Nothing where one of the two hulls is flat.
  struct Hulls {
    MinkowskiHeight height;
    MinkowskiFaces faces;
  };
  std::vector<std::optional<Hulls>> hulls;
};

std::vector<MeshRow> mesh_rows(bool quick);

// A rival, or tact with some setting: facet pairs, and the direction and depth of the hulls if it finds them.
struct MeshMethodKind {
  std::string library;
  std::string setting;
  Minimum minimum = Minimum::smallest;
  bool pairs = true;   // it finds facet pairs
  bool depth = false;  // and for depth and direction
  std::function<std::unique_ptr<Rival>(const Workload&)> make;
};

std::vector<MeshMethodKind> mesh_methods();

ErrorResult judge(const MeshRow& row, const MeshMethodKind& kind);
// The median time of a step in microseconds, from new positions to the list of pairs.
std::vector<double> measure(const MeshRow& row, const std::vector<MeshMethodKind>& kinds, double seconds);

// A rival that also finds depth and direction.
class HullRival : public Rival {
 public:
  // Of the last step.
  virtual HullAnswer hulls() const = 0;
};

}  // namespace tact::bench
