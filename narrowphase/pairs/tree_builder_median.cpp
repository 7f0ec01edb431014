#include <algorithm>
#include <numeric>
#include <utility>

#include "narrowphase/pairs/tree_builder.h"

namespace tact::narrowphase {

EmbreeDevice::EmbreeDevice() = default;
EmbreeDevice::~EmbreeDevice() = default;
void* EmbreeDevice::get() { return device_; }
bool EmbreeDevice::started() const { return false; }

struct TreeBuilder::Implementation {
  BoxView boxes;
  std::vector<TreeNode>& nodes;
  int first = 0;                   // of the boxes of a tree
  std::vector<int> order = {};     // of these boxes, as they are cut
  std::vector<Vec3> middles = {};  // of these boxes, twice as far from zero

  std::int32_t cut(std::size_t begin, std::size_t end);
};

TreeBuilder::TreeBuilder(EmbreeDevice&, BoxView boxes, int, std::vector<TreeNode>& nodes)
    : implementation_(std::make_unique<Implementation>(Implementation{boxes, nodes})) {}
TreeBuilder::~TreeBuilder() = default;

// At the median along the axis on which the middles lie farthest apart; of equal ones by number.
std::int32_t TreeBuilder::Implementation::cut(std::size_t begin, std::size_t end) {
  if (end - begin == 1) return ~order[begin];
  const auto middle_of = [&](int box) { return middles[static_cast<std::size_t>(box - first)]; };
  Box spread;
  for (std::size_t i = begin; i < end; ++i) spread = merged(spread, {middle_of(order[i]), middle_of(order[i])});
  const Vec3 size = spread.upper - spread.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t half = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end), [&](int one, int other) {
    return std::pair(middle_of(one)[axis], one) < std::pair(middle_of(other)[axis], other);
  });
  const std::size_t node = nodes.size();
  nodes.emplace_back();
  const std::int32_t lower = cut(begin, half), upper = cut(half, end);
  nodes[node].child[0] = lower;
  nodes[node].child[1] = upper;
  return static_cast<std::int32_t>(node);
}

std::int32_t TreeBuilder::build(int begin, int end) {
  Implementation& self = *implementation_;
  self.first = begin;
  self.order.resize(static_cast<std::size_t>(end - begin));
  std::iota(self.order.begin(), self.order.end(), begin);
  self.middles.clear();
  for (int i = begin; i < end; ++i) self.middles.push_back(self.boxes[i].lower + self.boxes[i].upper);
  return self.cut(0, self.order.size());
}

}  // namespace tact::narrowphase
