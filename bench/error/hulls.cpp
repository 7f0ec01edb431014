#include "bench/error/hulls.h"

#include <Eigen/Geometry>
#include <functional>

#include "bench/stability/shapes.h"

namespace tact::bench {
namespace {

constexpr double kGrain = 0x1p-40;
// The smallest separation in the first and in the last frame, in sizes of the pair.
constexpr double kStart = -0.02;
constexpr double kEnd = 0.2;

Mesh snapped(Mesh mesh) {
  mesh.positions = (mesh.positions / kGrain).array().round() * kGrain;
  return mesh;
}

using MakeHull = std::function<Mesh(StabilityRandom&)>;

// How far b must be shifted along `along` to make the smallest separation `depth`, or 0 if it is smaller from the
// start.
double shift_to_depth(const MinkowskiFaces& faces, const Eigen::Vector3d& along, double depth, double farthest) {
  double low = 0.0, high = farthest;  // the separation falls with the shift
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (faces.smallest(middle * along, 0.0).height > depth ? low : high) = middle;
  }
  return low;
}

// b comes towards a along a random direction, and slides a little across it.
HullPair pair_of(const MakeHull& make, int frames, StabilityRandom& random) {
  const Mesh a = snapped(make(random)), b = snapped(make(random));
  HullPair pair{a, b, {}, height_of(a, b), MinkowskiFaces(a, b)};
  const double size = pair.height.size();
  const Eigen::Vector3d along = random.direction();
  const Eigen::Vector3d across = 0.02 * size * along.cross(random.direction());
  for (int frame = 0; frame < frames; ++frame) {
    const double t = static_cast<double>(frame) / (frames - 1);
    const double depth = size * (kStart + (kEnd - kStart) * t);
    const Eigen::Vector3d shift = shift_to_depth(pair.faces, along, depth, 4.0 * size) * along + t * across;
    pair.path.push_back((shift / kGrain).array().round() * kGrain);
  }
  return pair;
}

Mesh aligned_box(StabilityRandom& random) {
  const Eigen::Vector3d half(0.25 * (1 + random.below(4)), 0.25 * (1 + random.below(4)), 0.25 * (1 + random.below(4)));
  return box_shape(-half, half);
}

Mesh rotated_box(StabilityRandom& random) { return rotated(aligned_box(random), random.rotation()); }

HullRow row(const char* name, int pairs, int frames, std::uint64_t seed, const MakeHull& make) {
  HullRow result{name, frames, {}};
  StabilityRandom random(seed);
  for (int i = 0; i < pairs; ++i) result.pairs.push_back(pair_of(make, frames, random));
  return result;
}

MakeHull hull_of_points(int points) {
  return [points](StabilityRandom& random) { return hull_shape(points, random); };
}

}  // namespace

std::vector<HullRow> hull_rows(bool quick) {
  const int pairs = quick ? 4 : 32, frames = quick ? 4 : 12;
  std::vector<HullRow> rows{
      row("boxes, aligned", pairs, frames, 1, aligned_box),
      row("boxes, turned", pairs, frames, 2, rotated_box),
      row("hulls of 8 vertices", pairs, frames, 3, hull_of_points(8)),
      row("hulls of 32 vertices", pairs, frames, 4, hull_of_points(32)),
      row("hulls of 128 vertices", pairs, frames, 5, hull_of_points(128)),
  };
  if (!quick) {
    rows.push_back(row("hulls of 1000 vertices", 8, frames, 6, hull_of_points(1000)));
    rows.push_back(row("spheres of 642 vertices", 8, frames, 7,
                       [](StabilityRandom& random) { return rotated(ball_shape(3), random.rotation()); }));
  }
  return rows;
}

}  // namespace tact::bench
