#include "narrowphase/pairs/cluster_forest.h"

#include <tact/error.h>

#include <algorithm>
#include <array>
#include <string>

#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/pairs/box_reach.h"
#include "narrowphase/pairs/embree.h"

namespace tact::narrowphase {

namespace {

// Embree builds a tree of fewer boxes than this in the calling thread; above, it would wake threads of its own.
// Clusters are in spatial order, so a run of them is compact and a forest of such trees is nearly as good as one tree.
constexpr int kBoxesPerTree = 512;

[[noreturn]] void fail(RTCError code) {
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw Error(ErrorCode::out_of_memory, "Embree is out of memory");
  throw Error(ErrorCode::backend_failure, "Embree reported error " + std::to_string(static_cast<int>(code)));
}

// What the calling thread's last calls of Embree left behind. Leaves nothing for the next.
RTCError take_error(RTCDevice device) {
  RTCError code = rtcGetDeviceError(device);
  // A thread's first query allocates. Where that fails the answer is "unknown", and the reason is kept for the
  // second.
  if (code == RTC_ERROR_UNKNOWN) {
    const RTCError reason = rtcGetDeviceError(device);
    if (reason != RTC_ERROR_NONE) code = reason;
  }
  return code;
}

// Numbers in Embree's void pointers: never null, so that a node of zero is told from a failure.
void* pointer_of(std::int32_t child) { return reinterpret_cast<void*>(static_cast<std::intptr_t>(child) * 2 + 1); }
std::int32_t child_of(void* pointer) {
  return static_cast<std::int32_t>((reinterpret_cast<std::intptr_t>(pointer) - 1) / 2);
}

}  // namespace

EmbreeDevice::EmbreeDevice() = default;

EmbreeDevice::~EmbreeDevice() {
  if (device_ != nullptr) rtcReleaseDevice(static_cast<RTCDevice>(device_));
}

void* EmbreeDevice::get() {
  const std::lock_guard lock(mutex_);
  if (device_ == nullptr) {
    device_ = rtcNewDevice(nullptr);
    if (device_ == nullptr) fail(rtcGetDeviceError(nullptr));
  }
  return device_;
}

bool EmbreeDevice::started() const {
  const std::lock_guard lock(mutex_);
  return device_ != nullptr;
}

// Embree's callbacks. They run in the thread that builds, see kBoxesPerTree.
struct ClusterForest::Builder {
  ClusterForest& forest;

  static void* create_node(RTCThreadLocalAllocator, unsigned, void* user) {
    auto& nodes = static_cast<Builder*>(user)->forest.nodes_;
    nodes.emplace_back();
    return pointer_of(static_cast<std::int32_t>(nodes.size() - 1));
  }
  static void set_children(void* node, void** children, unsigned count, void* user) {
    Node& n = static_cast<Builder*>(user)->forest.nodes_[child_of(node)];
    for (unsigned i = 0; i < count; ++i) n.child[i] = child_of(children[i]);
  }
  static void set_bounds(void*, const RTCBounds**, unsigned, void*) {}  // ours are computed from doubles
  static void* create_leaf(RTCThreadLocalAllocator, const RTCBuildPrimitive* primitives, std::size_t, void*) {
    return pointer_of(~static_cast<std::int32_t>(primitives[0].primID));
  }
};

void ClusterForest::build(EmbreeDevice& device, BoxView boxes, int count) {
  nodes_.clear();
  roots_.clear();
  root_boxes_.clear();
  nodes_.reserve(count);
  Box whole;
  for (int i = 0; i < count; ++i) whole = merged(whole, boxes[i]);
  const Vec3 origin = 0.5 * whole.lower + 0.5 * whole.upper;
  const double scale = unit_scale(longest_side(whole));
  const auto embree = static_cast<RTCDevice>(device.get());
  Builder builder{*this};
  std::array<RTCBuildPrimitive, kBoxesPerTree> primitives;
  for (int begin = 0; begin < count; begin += kBoxesPerTree) {
    const int tree_size = std::min(kBoxesPerTree, count - begin);
    for (int i = begin; i < begin + tree_size; ++i) {
      const Box box = boxes[i];
      const Vec3 low = scale * (box.lower - origin), high = scale * (box.upper - origin);
      RTCBuildPrimitive& p = primitives[i - begin] = {};
      p.lower_x = static_cast<float>(low.x), p.lower_y = static_cast<float>(low.y),
      p.lower_z = static_cast<float>(low.z);
      p.upper_x = static_cast<float>(high.x), p.upper_y = static_cast<float>(high.y),
      p.upper_z = static_cast<float>(high.z);
      p.primID = static_cast<unsigned>(i);
    }
    RTCBVH bvh = rtcNewBVH(embree);
    RTCError error = take_error(embree);
    if (bvh == nullptr || error != RTC_ERROR_NONE) {
      if (bvh != nullptr) rtcReleaseBVH(bvh);
      fail(error);
    }
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxLeafSize = 1;
    arguments.maxDepth = 60;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = static_cast<std::size_t>(tree_size);
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = Builder::create_node;
    arguments.setNodeChildren = Builder::set_children;
    arguments.setNodeBounds = Builder::set_bounds;
    arguments.createLeaf = Builder::create_leaf;
    arguments.userPtr = &builder;
    const std::size_t nodes_before = nodes_.size();
    void* root = rtcBuildBVH(&arguments);
    rtcReleaseBVH(bvh);
    error = take_error(embree);
    if (error != RTC_ERROR_NONE && error != RTC_ERROR_UNKNOWN) fail(error);
    if (root != nullptr && error == RTC_ERROR_NONE) {
      roots_.push_back(child_of(root));
    } else {
      nodes_.resize(nodes_before);
      roots_.push_back(halve(begin, begin + tree_size));
    }
  }
  // Embree makes a node before its children: in reverse order, every child is ready.
  const auto box_of = [&](std::int32_t child) {
    if (child < 0) return boxes[~child];
    const Node& node = nodes_[child];
    return merged(node.box[0], node.box[1]);
  };
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    for (int k = 0; k < 2; ++k) nodes_[i].box[k] = box_of(nodes_[i].child[k]);
  }
  for (const std::int32_t root : roots_) root_boxes_.push_back(box_of(root));
}

// Embree gives up, with an unknown error, where boxes gather about a point so closely that a tree which cuts space
// would be deeper than its limit. This one cuts the list, in which neighbours follow each other.
std::int32_t ClusterForest::halve(int begin, int end) {
  if (end - begin == 1) return ~begin;
  const auto node = static_cast<std::int32_t>(nodes_.size());
  nodes_.emplace_back();
  const int middle = begin + (end - begin) / 2;
  const std::int32_t first = halve(begin, middle), second = halve(middle, end);
  nodes_[node].child[0] = first;
  nodes_[node].child[1] = second;
  return node;
}

void ClusterForest::query(const Box& box, std::vector<std::int32_t>& stack, std::vector<std::int32_t>& found) const {
  stack.clear();
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    if (overlaps(root_boxes_[i], box)) stack.push_back(roots_[i]);
  }
  while (!stack.empty()) {
    const std::int32_t child = stack.back();
    stack.pop_back();
    if (child < 0) {
      found.push_back(~child);
      continue;
    }
    const Node& node = nodes_[child];
    for (int k = 0; k < 2; ++k) {
      if (overlaps(node.box[k], box)) stack.push_back(node.child[k]);
    }
  }
}

}  // namespace tact::narrowphase
