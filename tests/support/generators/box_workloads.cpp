#include "tests/support/generators/box_workloads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace tact::tests {
namespace {

using base::Box;
using base::Vec3;

// A cube of edge 1 meets 8 / kVolumePerBox others on average: about one pair a box.
constexpr double kVolumePerBox = 4.0;
constexpr double kStep = 0.02;  // largest motion in a step, as a part of the size
constexpr int kLayers = 10;     // of which one slides

struct Named {
  BoxWorkloadKind kind;
  const char* name;
};
constexpr std::array kNames{
    Named{BoxWorkloadKind::small_motion, "small_motion"},
    Named{BoxWorkloadKind::all_far, "all_far"},
    Named{BoxWorkloadKind::few_moving, "few_moving"},
    Named{BoxWorkloadKind::churn, "churn"},
    Named{BoxWorkloadKind::tall_pile, "tall_pile"},
    Named{BoxWorkloadKind::thin_layer, "thin_layer"},
    Named{BoxWorkloadKind::one_huge, "one_huge"},
    Named{BoxWorkloadKind::size_spread, "size_spread"},
    Named{BoxWorkloadKind::rods, "rods"},
    Named{BoxWorkloadKind::lattice, "lattice"},
};

Vec3 domain_for(BoxWorkloadKind kind, double count) {
  const double volume = kVolumePerBox * count;
  switch (kind) {
    case BoxWorkloadKind::tall_pile: return {2.0, 2.0, volume / 9.0};
    case BoxWorkloadKind::thin_layer: return {std::sqrt(volume), std::sqrt(volume), 0.5};
    case BoxWorkloadKind::size_spread:
      return Vec3{1.0, 1.0, 1.0} * (2.17 * std::cbrt(volume));  // about one pair a box here too
    default: return Vec3{1.0, 1.0, 1.0} * std::cbrt(volume);
  }
}

}  // namespace

std::span<const BoxWorkloadKind> all_box_workloads() {
  static constexpr auto kKinds = [] {
    std::array<BoxWorkloadKind, kNames.size()> kinds{};
    for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = kNames[i].kind;
    return kinds;
  }();
  return kKinds;
}

std::string name_of(BoxWorkloadKind kind) {
  const auto named = std::find_if(kNames.begin(), kNames.end(), [&](const Named& one) { return one.kind == kind; });
  return named->name;
}

BoxWorkload::BoxWorkload(BoxWorkloadKind kind, std::size_t count, std::uint64_t seed)
    : kind_(kind),
      random_(seed),
      domain_(domain_for(kind, static_cast<double>(count))),
      boxes_(count),
      velocities_(count),
      filters_(count),
      changed_(count) {
  mark_all();
  if (kind == BoxWorkloadKind::lattice) {
    place_lattice();
    return;
  }
  for (std::size_t i = 0; i < count; ++i) place(i);
  if (kind == BoxWorkloadKind::one_huge && count > 0) boxes_[count / 2] = {{0.0, 0.0, 0.0}, domain_};
  if (kind == BoxWorkloadKind::churn) {
    for (std::size_t i = 0; i < count / 10; ++i) boxes_[i] = Box{};
  }
}

void BoxWorkload::mark_all() {
  changed_.resize(boxes_.size());
  std::iota(changed_.begin(), changed_.end(), 0u);
}

void BoxWorkload::step() {
  ++steps_;
  switch (kind_) {
    case BoxWorkloadKind::all_far:
      for (std::size_t i = 0; i < boxes_.size(); ++i) place(i);
      break;
    case BoxWorkloadKind::few_moving:
      changed_.clear();
      for (std::size_t i = 0; i < std::min<std::size_t>(10, boxes_.size()); ++i) {
        changed_.push_back(static_cast<std::uint32_t>(random_() % boxes_.size()));
        place(changed_.back());
      }
      break;
    case BoxWorkloadKind::churn: exchange(); break;
    case BoxWorkloadKind::lattice: slide_layers(); break;
    default: drift(); break;
  }
}

// Not the standard library's distribution: that differs between platforms.
double BoxWorkload::uniform(double lower, double upper) {
  return lower + (upper - lower) * (static_cast<double>(random_() >> 11) * 0x1p-53);
}

Vec3 BoxWorkload::random_point() {
  const double x = uniform(0.0, domain_.x);
  const double y = uniform(0.0, domain_.y);
  return {x, y, uniform(0.0, domain_.z)};
}

Vec3 BoxWorkload::random_size(std::size_t index) {
  Vec3 size{1.0, 1.0, 1.0};
  if (kind_ == BoxWorkloadKind::size_spread) {
    size = (8.0 * std::pow(1000.0, uniform(-1.0, 0.0))) * size;
  }
  if (kind_ == BoxWorkloadKind::rods && index % 100 == 0) size[static_cast<int>(random_() % 3)] = 20.0;
  return size;
}

void BoxWorkload::place(std::size_t index) {
  const Vec3 size = random_size(index);
  const Vec3 lower = random_point() - 0.5 * size;
  boxes_[index] = {lower, lower + size};
  for (int axis = 0; axis < 3; ++axis) velocities_[index][axis] = uniform(-kStep, kStep) * std::min(size[axis], 1.0);
}

// Bounces at the borders of the domain.
void BoxWorkload::drift() {
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      double& velocity = velocities_[i][axis];
      const double center = 0.5 * (boxes_[i].lower[axis] + boxes_[i].upper[axis]);
      if ((center < 0.0 && velocity < 0.0) || (center > domain_[axis] && velocity > 0.0)) velocity = -velocity;
    }
    boxes_[i] = {boxes_[i].lower + velocities_[i], boxes_[i].upper + velocities_[i]};
  }
}

// Bricks of 1 x 2 x 0.5, every coordinate a multiple of 0.5.
void BoxWorkload::place_lattice() {
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(boxes_.size()))));
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Vec3 lower{static_cast<double>(i % side), 2.0 * static_cast<double>(i / side % side),
                     0.5 * static_cast<double>(i / side / side)};
    boxes_[i] = {lower, lower + Vec3{1.0, 2.0, 0.5}};
  }
}

void BoxWorkload::slide_layers() {
  changed_.clear();
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const auto layer = static_cast<int>(boxes_[i].lower.z * 2.0);
    if (layer % kLayers != steps_ % kLayers) continue;
    const Vec3 motion{layer % 2 == 0 ? 1.0 : -1.0, 0.0, 0.0};
    boxes_[i] = {boxes_[i].lower + motion, boxes_[i].upper + motion};
    changed_.push_back(static_cast<std::uint32_t>(i));
  }
}

// The missing boxes are a tenth of all, taken round in turn.
void BoxWorkload::exchange() {
  changed_.clear();
  const std::size_t tenth = boxes_.size() / 10;
  const std::size_t first = (static_cast<std::size_t>(steps_) - 1) * tenth;
  for (std::size_t i = 0; i < tenth; ++i) {
    const std::size_t added = (first + i) % boxes_.size();
    const std::size_t removed = (first + tenth + i) % boxes_.size();
    place(added);
    boxes_[removed] = Box{};
    changed_.push_back(static_cast<std::uint32_t>(added));
    changed_.push_back(static_cast<std::uint32_t>(removed));
  }
}

}  // namespace tact::tests
