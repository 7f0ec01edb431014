#include "bench/workloads.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/random.h"
#include "bench/shapes.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

double phase_of(int frame, int frames) { return static_cast<double>(frame) / frames; }

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

// Smooth, 1 at the dent's centre, a quarter at 40 degrees from it, 0 opposite.
double bump(double cosine) {
  const double half = 0.5 * (1.0 + cosine), square = half * half, fourth = square * square;
  return fourth * fourth * square;
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

struct Blob {
  Vector3d center;
  BlobMotion motion;
};

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

Workload blobs(const std::vector<Blob>& blobs, int frequency, double radius, int frames) {
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

// Where the point (x, y) of a flat sheet, 4 m wide, comes to lie when it is draped over the unit sphere about the
// origin up to `contact`, a distance from the middle in metres, and hangs straight from there: the sphere by
// stereographic projection, beyond it the tangent cone.
struct DrapedPoint {
  Vector3d position;
  Vector3d normal;
};

DrapedPoint draped(double x, double y, double contact) {
  const double distance = std::sqrt(x * x + y * y);
  const double along = std::min(distance, contact);
  const double scale = 1.0 / (4.0 + along * along);
  const double sine = 4.0 * along * scale, cosine = (4.0 - along * along) * scale;
  const double beyond = distance - along;
  const double out = sine + beyond * cosine, height = cosine - beyond * sine;
  const double ux = distance > 0.0 ? x / distance : 0.0, uy = distance > 0.0 ? y / distance : 0.0;
  return {{ux * out, uy * out, height}, {ux * sine, uy * sine, cosine}};
}

struct Wrinkle {
  double x, y;                  // waves a metre
  double height, delay, speed;  // metres, of the period, whole periods
};

}  // namespace

std::size_t Workload::facet_count() const {
  return std::accumulate(bodies.begin(), bodies.end(), std::size_t{0}, [](std::size_t sum, const WorkloadBody& body) {
    return sum + static_cast<std::size_t>(body.facets.cols());
  });
}

Workload cloth(int cells, int frames) {
  constexpr double kClearance = 0.004;  // metres by which the wrinkles' middle is above the sphere
  Random random(11);
  std::vector<Wrinkle> wrinkles;
  for (int k = 0; k < 5; ++k) {
    const Vector3d d = random.direction();
    const double frequency = random.uniform(1.3, 3.9), speed = k % 2 == 0 ? 1.0 : -1.0;
    wrinkles.push_back({frequency * d.x(), frequency * d.y(), 0.012, random.uniform(0.0, 1.0), speed});
  }
  const Shape sheet = square_sheet(cells, 4.0), sphere = geodesic_sphere(8);
  Workload workload{frames, {}};
  workload.bodies.resize(2);
  WorkloadBody& body = workload.bodies[0];
  body.facets = sheet.facets;
  body.surface = Surface::sheet;
  body.frames.resize(static_cast<std::size_t>(frames));
  base::parallel_for(body.frames.size(), 1, base::default_threads(), [&](std::size_t frame) {
    const double phase = phase_of(static_cast<int>(frame), frames);
    const double fall = wave(phase);  // lifted off the sphere for a quarter of the period
    const double lift = 0.5 * std::max(0.0, -0.75 - fall);
    const double contact = 0.9 + 0.25 * fall;
    Matrix3Xd& positions = body.frames[frame];
    positions.resize(3, sheet.positions.cols());
    for (Index v = 0; v < positions.cols(); ++v) {
      const double x = sheet.positions(0, v), y = sheet.positions(1, v);
      const DrapedPoint p = draped(x, y, contact);
      double offset = kClearance;
      for (const Wrinkle& w : wrinkles) offset += w.height * wave(w.x * x + w.y * y + w.delay + w.speed * phase);
      positions.col(v) = p.position + offset * p.normal + Vector3d(0.0, 0.0, lift);
    }
  });
  workload.bodies[1].facets = sphere.facets;
  workload.bodies[1].frames = {sphere.positions};
  return workload;
}

Workload pile(int count, int frequency, int frames) {
  const int side = cube_side(count);
  return blobs(packed_blobs(count, side, side), frequency, round_radius(frequency), frames);
}

Workload pile_column(int height, int frequency, int frames) {
  constexpr int kSide = 8;
  return blobs(packed_blobs(kSide * kSide * height, kSide, kSide), frequency, round_radius(frequency), frames);
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
  return blobs(all, 2, 1.0, frames);
}

Workload large_pair(int frequency, int frames) {
  Random random(14);
  std::vector<Blob> all;
  for (const double side : {-1.0, 1.0}) all.push_back({{side * 0.981, 0.0, 0.0}, random_motion(random, 0.05, 0.02)});
  return blobs(all, frequency, 1.0, frames);
}

Workload organ_and_tool(int frames) {
  const Shape sphere = geodesic_sphere(5);
  const Shape shaft = rod(10, 6);
  const Vector3d hollow = Vector3d(0.2, 0.3, 0.93).normalized();
  Workload workload{frames, {}};
  workload.bodies.resize(2);
  workload.bodies[0].facets = sphere.facets;
  workload.bodies[1].facets = shaft.facets;
  for (int frame = 0; frame < frames; ++frame) {
    const double phase = phase_of(frame, frames);
    Matrix3Xd organ(3, sphere.positions.cols());
    for (Index v = 0; v < organ.cols(); ++v) {
      const Vector3d d = sphere.positions.col(v);
      const double breath = 1.0 + 0.04 * wave(phase) * d.z();
      const double r = breath * (1.0 - 0.45 * bump(hollow.dot(d)));
      organ.col(v) << 0.16 * r * d.x(), 0.1 * r * d.y(),
          0.07 * r * d.z() - 0.8 * (0.16 * r * d.x()) * (0.16 * r * d.x());
    }
    Matrix3Xd tool(3, shaft.positions.cols());
    const double height = 0.0391 + 0.004 * wave(phase + 0.3);
    for (Index v = 0; v < tool.cols(); ++v) {
      const Vector3d p = shaft.positions.col(v);
      tool.col(v) << 0.02 + 0.006 * p.x() + 0.05 * p.z(), 0.02 + 0.006 * p.y(), height + 0.25 * p.z() - 0.004 * p.x();
    }
    workload.bodies[0].frames.push_back(organ);
    workload.bodies[1].frames.push_back(tool);
  }
  return workload;
}

Workload brick_wall(int side, int courses, Pose pose, int frames) {
  const Vector3d size(0.25, 0.125, 0.0625);
  std::vector<Shape> bricks;
  for (int course = 0; course < courses; ++course) {
    for (int row = 0; row < side; ++row) {
      for (int k = 0; k < side; ++k) {
        const double shift = 0.5 * (course % 2), x = k + shift, y = row + shift;
        const Vector3d lower(x * size.x(), y * size.y(), course * size.z());
        bricks.push_back(brick(lower, lower + size));
      }
    }
  }
  Workload workload{frames, {}};
  workload.bodies.resize(bricks.size());
  for (int frame = 0; frame < frames; ++frame) {
    const double w = 0.3 * wave(phase_of(frame, frames));
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    if (pose == Pose::rotated) {
      const Eigen::Quaterniond q(1.0, 0.3 + w, 0.5 - w, 0.2 + 0.5 * w);
      rotation = q.normalized().toRotationMatrix();
    }
    const Vector3d shift = pose == Pose::aligned ? Vector3d(frame % 2, 0.0, 0.0) / 64.0 : Vector3d::Zero().eval();
    for (std::size_t k = 0; k < bricks.size(); ++k) {
      Matrix3Xd positions(3, 8);
      for (Index v = 0; v < 8; ++v) positions.col(v) = rotation * (bricks[k].positions.col(v) + shift);
      workload.bodies[k].frames.push_back(positions);
    }
  }
  for (std::size_t k = 0; k < bricks.size(); ++k) workload.bodies[k].facets = bricks[k].facets;
  return workload;
}

std::vector<NamedWorkload> rival_workloads(Size size) {
  constexpr int kFrames = 24, kFewFrames = 6;
  if (size == Size::small) {
    return {
        {"cloth 3 k", "a sheet over a sphere", 5.0, [] { return cloth(40, kFewFrames); }},
        {"pile 27 x 320", "blobs, six neighbours each", 4.0, [] { return pile(27, 4, kFewFrames); }},
        {"organ and tool", "600 facets", 1.5, [] { return organ_and_tool(kFewFrames); }},
        {"500 x 80 scattered", "few touch", 4.0, [] { return scattered(500, kFewFrames); }},
        {"two of 8 k", "shallow overlap", 8.0, [] { return large_pair(20, kFewFrames); }},
        {"bricks aligned", "exact contact", 1.5, [] { return brick_wall(4, 4, Pose::aligned, kFewFrames); }},
        {"bricks rotated", "contact on the last bit", 8.0, [] { return brick_wall(4, 4, Pose::rotated, kFewFrames); }}};
  }
  return {
      {"cloth 13 k", "a sheet of 77² squares over a sphere", 5.0, [] { return cloth(77, kFrames); }},
      {"cloth 152 k", "a sheet of 275² squares over a sphere", 5.0, [] { return cloth(275, kFrames); }},
      {"cloth 606 k", "a sheet of 550² squares over a sphere", 5.0, [] { return cloth(550, kFrames); }},
      {"pile 100 x 1280", "blobs, six neighbours each", 4.0, [] { return pile(100, 8, kFrames); }},
      {"pile 1000 x 1280", "blobs, six neighbours each", 4.0, [] { return pile(1000, 8, kFrames); }},
      {"pile 4000 x 320", "blobs, six neighbours each", 4.0, [] { return pile(4000, 4, kFrames); }},
      {"organ and tool", "500 and 100 facets", 1.5, [] { return organ_and_tool(kFrames); }},
      {"10,000 x 80 scattered", "blobs of which few touch", 4.0, [] { return scattered(10000, kFrames); }},
      {"two of 500 k", "two blobs in shallow overlap", 8.0, [] { return large_pair(158, kFrames); }},
      {"bricks aligned", "a wall in exact contact", 1.5, [] { return brick_wall(7, 7, Pose::aligned, kFrames); }},
      {"bricks rotated", "the wall turned: contact hangs on the last bit", 8.0,
       [] { return brick_wall(7, 7, Pose::rotated, kFrames); }},
  };
}

}  // namespace tact::bench
