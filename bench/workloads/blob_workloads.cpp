// The workloads that are made of blobs: spheres in which smooth dents come and go while they sway.
#include <vector>

#include "bench/random.h"
#include "bench/workloads/shapes.h"
#include "bench/workloads/workloads.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// A place on the unit sphere that is pushed in and out as time goes.
struct Dent {
  Vector3d center;
  double depth = 0.0;  // of the unit
  double delay = 0.0;  // of the period
};

struct BlobMotion {
  std::vector<Dent> dents;
  Vector3d sway;   // metres, amplitudes along the axes
  Vector3d delay;  // of the period
};

struct Blob {
  Vector3d center;
  BlobMotion motion;
};

BlobMotion random_motion(Random& random, double dent_depth, double sway) {
  BlobMotion motion;
  for (int k = 0; k < 6; ++k) {
    motion.dents.push_back({random.direction(), random.uniform(0.3, 1.0) * dent_depth, random.uniform(0.0, 1.0)});
  }
  for (int axis = 0; axis < 3; ++axis) {
    motion.sway[axis] = random.uniform(0.3, 1.0) * sway;
    motion.delay[axis] = random.uniform(0.0, 1.0);
  }
  return motion;
}

Vector3d swayed(const BlobMotion& motion, const Vector3d& center, double phase) {
  Vector3d p = center;
  for (int axis = 0; axis < 3; ++axis) p[axis] += motion.sway[axis] * wave(phase + motion.delay[axis]);
  return p;
}

Matrix3Xd blob_at(const Matrix3Xd& directions, const BlobMotion& motion, const Vector3d& center, double radius,
                  double phase) {
  const Vector3d middle = swayed(motion, center, phase);
  std::vector<double> depths;
  for (const Dent& dent : motion.dents) depths.push_back(dent.depth * wave(phase + dent.delay));
  Matrix3Xd positions(3, directions.cols());
  for (Index v = 0; v < directions.cols(); ++v) {
    double r = 1.0;
    for (std::size_t k = 0; k < depths.size(); ++k)
      r += depths[k] * bump(motion.dents[k].center.dot(directions.col(v)));
    positions.col(v) = middle + radius * r * directions.col(v);
  }
  return positions;
}

// The edge of the smallest cube of cells that holds `count`.
int cube_side(int count) {
  int side = 1;
  while (side * side * side < count) ++side;
  return side;
}

// The facets of a sphere lie inside it: with this radius they are as often outside of the unit sphere as inside.
double round_radius(int frequency) { return 1.0 + 0.1 / (frequency * frequency); }

// The first `count` places of a grid of `columns` x `rows` x any number.
std::vector<Blob> packed_blobs(int count, int columns, int rows) {
  constexpr double kSpacing = 1.94, kJitter = 0.02, kDent = 0.06, kSway = 0.02;  // metres, radius 1
  Random random(12);
  std::vector<Blob> all;
  for (int k = 0; k < count; ++k) {
    Vector3d center = kSpacing * Vector3d(k % columns, k / columns % rows, k / (columns * rows));
    for (int axis = 0; axis < 3; ++axis) center[axis] += random.uniform(-kJitter, kJitter);
    all.push_back({center, random_motion(random, kDent, kSway)});
  }
  return all;
}

// A body each, of 20 * frequency² facets.
Workload blob_workload(const std::vector<Blob>& blobs, int frequency, double radius, int frames) {
  const Shape sphere = geodesic_sphere(frequency);
  Workload workload{frames, {}};
  workload.bodies.resize(blobs.size());
  base::parallel_for(blobs.size(), 1, base::default_threads(), [&](std::size_t k) {
    WorkloadBody& body = workload.bodies[k];
    body.facets = sphere.facets;
    for (int frame = 0; frame < frames; ++frame) {
      body.frames.push_back(
          blob_at(sphere.positions, blobs[k].motion, blobs[k].center, radius, phase_of(frame, frames)));
    }
  });
  return workload;
}

}  // namespace

Workload pile(int count, int frequency, int frames) {
  const int side = cube_side(count);
  return blob_workload(packed_blobs(count, side, side), frequency, round_radius(frequency), frames);
}

Workload pile_column(int height, int frequency, int frames) {
  constexpr int kSide = 8;
  return blob_workload(packed_blobs(kSide * kSide * height, kSide, kSide), frequency, round_radius(frequency), frames);
}

Workload scattered(int count, int frames) {
  constexpr double kSpacing = 9.05;  // metres, radius 1
  const double half_edge = 0.5 * kSpacing * cube_side(count);
  Random random(13);
  std::vector<Blob> all;
  for (int k = 0; k < count; ++k) {
    Vector3d center;
    for (int axis = 0; axis < 3; ++axis) center[axis] = random.uniform(-half_edge, half_edge);
    all.push_back({center, random_motion(random, 0.1, 0.3)});
  }
  return blob_workload(all, 2, 1.0, frames);
}

Workload large_pair(int frequency, int frames) {
  Random random(14);
  std::vector<Blob> all;
  for (const double side : {-1.0, 1.0}) all.push_back({{side * 0.981, 0.0, 0.0}, random_motion(random, 0.05, 0.02)});
  return blob_workload(all, frequency, 1.0, frames);
}

Workload terrain(int cells, int count, int frames) {
  constexpr double kSpacing = 2.1;  // metres, radius 1
  constexpr int kFrequency = 4;
  const auto height = [](double x, double y) { return 1.5 * wave(0.06 * x) * wave(0.045 * y); };
  int side = 1;
  while (side * side < count) ++side;
  Shape ground = square_sheet(cells, kSpacing * (side + 1));
  for (Index v = 0; v < ground.positions.cols(); ++v)
    ground.positions(2, v) = height(ground.positions(0, v), ground.positions(1, v));
  Random random(15);
  std::vector<Blob> all;
  for (int k = 0; k < count; ++k) {
    const double x = kSpacing * (k % side - 0.5 * (side - 1)), y = kSpacing * (k / side - 0.5 * (side - 1));
    all.push_back({{x, y, height(x, y) + 0.97}, random_motion(random, 0.06, 0.02)});
  }
  Workload workload = blob_workload(all, kFrequency, 1.0, frames);
  workload.bodies.push_back({.facets = ground.facets, .surface = Surface::sheet, .frames = {ground.positions}});
  return workload;
}

}  // namespace tact::bench
