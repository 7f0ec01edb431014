// Trees over many boxes, built by Embree, for the pairs of bodies whose clusters are too many for a plain loop.
//
// Embree proposes the topology only; the boxes in the nodes are ours, in doubles, so a query reports exactly the boxes
// that overlap, however far from zero the bodies are. Its rtcCollide is not used: boxes there are floats, its threads
// are not ours, and every call allocates. As no scene is made, none of the ways in which scenes fail can occur: empty
// ones, flags that differ, boxes beyond 1.8e18, a refit of what is not a number.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

// Embree, started when it is first needed and shared by all threads.
class EmbreeDevice {
 public:
  EmbreeDevice();
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  // The RTCDevice. Errors: backend_failure, out_of_memory.
  void* get();
  bool started() const;

 private:
  mutable std::mutex mutex_;
  void* device_ = nullptr;
};

class ClusterForest {
 public:
  // A forest over boxes 0 <= i < count. Errors: backend_failure, out_of_memory.
  void build(EmbreeDevice& device, BoxView boxes, int count);

  // Appends, in no particular order, the indices of the boxes that overlap `box`. `stack` lends memory.
  void query(const Box& box, std::vector<std::int32_t>& stack, std::vector<std::int32_t>& found) const;

 private:
  // An inner node has two children, each a node (>= 0) or a box (~index < 0), and the boxes of both.
  struct Node {
    Box box[2];
    std::int32_t child[2];
  };
  struct Builder;
  std::int32_t halve(int begin, int end);

  std::vector<Node> nodes_;
  std::vector<std::int32_t> roots_;
  std::vector<Box> root_boxes_;
};

}  // namespace tact::narrowphase
