#include <tact/error.h>

#include <array>
#include <mutex>
#include <string>

#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/pairs/box_reach.h"
#include "narrowphase/pairs/embree.h"
#include "narrowphase/pairs/tree_builder.h"

namespace tact::narrowphase {

namespace {

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

// The first device of a process sets up TBB, which Embree stands on. Where memory is short then, TBB waits for that
// ever after: in oneTBB 2021.8 what throws in atomic_do_once() leaves it pending. So no other one is asked for.
RTCDevice make_device() {
  static std::mutex mutex;
  static bool any_made = false, was_short_of_memory = false;
  const std::lock_guard lock(mutex);
  if (was_short_of_memory) return nullptr;
  was_short_of_memory = !any_made;  // if it throws, which it does where even its own error finds no memory
  if (RTCDevice device = rtcNewDevice(nullptr); device != nullptr) {
    any_made = true;
    was_short_of_memory = false;
    return device;
  }
  const RTCError error = rtcGetDeviceError(nullptr);
  was_short_of_memory = was_short_of_memory && error == RTC_ERROR_OUT_OF_MEMORY;
  fail(error);
}

// Numbers in Embree's void pointers: never null, so that a node of zero is told from a failure.
void* pointer_of(std::int32_t child) { return reinterpret_cast<void*>(static_cast<std::intptr_t>(child) * 2 + 1); }
std::int32_t child_of(void* pointer) {
  return static_cast<std::int32_t>((reinterpret_cast<std::intptr_t>(pointer) - 1) / 2);
}

// Embree's callbacks. They run in the thread that builds, see kBoxesPerTree.
std::vector<TreeNode>& nodes_of(void* user) { return *static_cast<std::vector<TreeNode>*>(user); }
void* create_node(RTCThreadLocalAllocator, unsigned, void* user) {
  nodes_of(user).emplace_back();
  return pointer_of(static_cast<std::int32_t>(nodes_of(user).size() - 1));
}
void set_children(void* node, void** children, unsigned count, void* user) {
  TreeNode& n = nodes_of(user)[child_of(node)];
  for (unsigned i = 0; i < count; ++i) n.child[i] = child_of(children[i]);
}
void set_bounds(void*, const RTCBounds**, unsigned, void*) {}  // ours are computed from doubles
void* create_leaf(RTCThreadLocalAllocator, const RTCBuildPrimitive* primitives, std::size_t, void*) {
  return pointer_of(~static_cast<std::int32_t>(primitives[0].primID));
}

}  // namespace

EmbreeDevice::EmbreeDevice() = default;

EmbreeDevice::~EmbreeDevice() {
  if (device_ != nullptr) rtcReleaseDevice(static_cast<RTCDevice>(device_));
}

void* EmbreeDevice::get() {
  const std::lock_guard lock(mutex_);
  if (device_ == nullptr) device_ = make_device();
  return device_;
}

bool EmbreeDevice::started() const {
  const std::lock_guard lock(mutex_);
  return device_ != nullptr;
}

struct TreeBuilder::Implementation {
  RTCDevice embree;  // null: there is none, and lists are cut
  BoxView boxes;
  std::vector<TreeNode>& nodes;
  Vec3 origin = {};
  double scale = 1.0;
  std::array<RTCBuildPrimitive, kBoxesPerTree> primitives = {};

  void list_primitives(int begin, int end);
  std::int32_t halve(int begin, int end);
};

TreeBuilder::TreeBuilder(EmbreeDevice& device, BoxView boxes, int count, std::vector<TreeNode>& nodes)
    : implementation_(
          std::make_unique<Implementation>(Implementation{static_cast<RTCDevice>(device.get()), boxes, nodes})) {
  Box whole;
  for (int i = 0; i < count; ++i) whole = merged(whole, boxes[i]);
  implementation_->origin = 0.5 * whole.lower + 0.5 * whole.upper;
  implementation_->scale = unit_scale(longest_side(whole));
}
TreeBuilder::~TreeBuilder() = default;

void TreeBuilder::Implementation::list_primitives(int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const Box box = boxes[i];
    const Vec3 low = scale * (box.lower - origin), high = scale * (box.upper - origin);
    RTCBuildPrimitive& p = primitives[i - begin] = {};
    p.lower_x = static_cast<float>(low.x), p.lower_y = static_cast<float>(low.y), p.lower_z = static_cast<float>(low.z);
    p.upper_x = static_cast<float>(high.x), p.upper_y = static_cast<float>(high.y),
    p.upper_z = static_cast<float>(high.z);
    p.primID = static_cast<unsigned>(i);
  }
}

// Embree gives up, with an unknown error, where boxes gather about a point so closely that a tree which cuts space
// would be deeper than its limit. This one cuts the list, in which neighbours follow each other.
std::int32_t TreeBuilder::Implementation::halve(int begin, int end) {
  if (end - begin == 1) return ~begin;
  const auto node = static_cast<std::int32_t>(nodes.size());
  nodes.emplace_back();
  const int middle = begin + (end - begin) / 2;
  const std::int32_t first = halve(begin, middle), second = halve(middle, end);
  nodes[node].child[0] = first;
  nodes[node].child[1] = second;
  return node;
}

std::int32_t TreeBuilder::build(int begin, int end) {
  Implementation& self = *implementation_;
  if (self.embree == nullptr) return self.halve(begin, end);
  self.list_primitives(begin, end);
  RTCBVH bvh = rtcNewBVH(self.embree);
  RTCError error = take_error(self.embree);
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
  arguments.primitives = self.primitives.data();
  arguments.primitiveCount = static_cast<std::size_t>(end - begin);
  arguments.primitiveArrayCapacity = self.primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  arguments.userPtr = &self.nodes;
  const std::size_t nodes_before = self.nodes.size();
  void* root = rtcBuildBVH(&arguments);
  rtcReleaseBVH(bvh);
  error = take_error(self.embree);
  if (error != RTC_ERROR_NONE && error != RTC_ERROR_UNKNOWN) fail(error);
  if (root != nullptr && error == RTC_ERROR_NONE) return child_of(root);
  self.nodes.resize(nodes_before);
  return self.halve(begin, end);
}

}  // namespace tact::narrowphase
