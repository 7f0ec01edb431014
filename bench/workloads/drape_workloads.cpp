// Surfaces that lie on each other: cloth on bodies, see workloads.h.
#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/random.h"
#include "bench/workloads/shapes.h"
#include "bench/workloads/workloads.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

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

std::vector<Wrinkle> random_wrinkles(int count, double shortest, double longest, double height, Random& random) {
  std::vector<Wrinkle> wrinkles;
  for (int k = 0; k < count; ++k) {
    const Vector3d d = random.direction();
    const double frequency = random.uniform(shortest, longest), speed = k % 2 == 0 ? 1.0 : -1.0;
    wrinkles.push_back({frequency * d.x(), frequency * d.y(), height, random.uniform(0.0, 1.0), speed});
  }
  return wrinkles;
}

double height_at(const std::vector<Wrinkle>& wrinkles, double x, double y, double phase) {
  double height = 0.0;
  for (const Wrinkle& w : wrinkles) height += w.height * wave(w.x * x + w.y * y + w.delay + w.speed * phase);
  return height;
}

// The frames of a body, each made alone: position(phase) gives 3 x V.
template <class Positions>
void make_frames(WorkloadBody& body, int frames, const Positions& positions) {
  body.frames.resize(frames);
  base::parallel_for(body.frames.size(), 1, base::default_threads(), [&](std::size_t frame) {
    body.frames[frame] = positions(phase_of(static_cast<int>(frame), frames));
  });
}

// A body that swells, sinks in and sways as time goes, by up to 3 cm, and what lies on it alike.
Vector3d breathing(const Vector3d& p, double phase) {
  const double swell = 0.03 * wave(0.4 * p.x() - 0.3 * p.y() + 0.2 * p.z() + phase);
  return (1.0 + swell) * p + Vector3d(0.03 * wave(phase), 0.02 * wave(phase + 0.2), 0.0);
}

// The sheet of draped_densely() at a phase: 2.3 m wide, all of it on the sphere.
Matrix3Xd dense_drape(const Shape& sheet, const std::vector<Wrinkle>& wrinkles, double phase) {
  constexpr double kClearance = 0.003, kAll = 2.0;  // metres
  Matrix3Xd positions(3, sheet.positions.cols());
  for (Index v = 0; v < positions.cols(); ++v) {
    const double x = sheet.positions(0, v), y = sheet.positions(1, v);
    const DrapedPoint p = draped(x, y, kAll);
    positions.col(v) = p.position + (kClearance + height_at(wrinkles, x, y, phase)) * p.normal;
  }
  return positions;
}

constexpr double kDenseWidth = 2.3;  // metres

std::vector<Wrinkle> dense_wrinkles() {
  Random random(21);
  return random_wrinkles(5, 1.5, 5.0, 0.0025, random);
}

// Moves every vertex in every frame, so that from frame to frame none goes farther than `most`.
void jitter(WorkloadBody& body, const Matrix3Xd& rest, double most, int frames, Random& random) {
  const double half = 0.5 * most / 1.8;  // of a cube in a sphere
  for (int frame = 0; frame < frames; ++frame) {
    Matrix3Xd& p = body.frames.emplace_back(rest);
    for (Index v = 0; v < p.cols(); ++v) {
      for (int axis = 0; axis < 3; ++axis) p(axis, v) += random.uniform(-half, half);
    }
  }
}

// A limb of the figure: a round bone in heights `lower` to `upper`, whose middle line goes through at(z, phase).
struct Limb {
  double lower, upper, radius;                       // metres
  Vector2d (*at)(double z, double phase, int side);  // side: -1 or 1
  int side;
};

Vector2d torso_at(double z, double phase, int) {
  const double up = std::max(0.0, z - 1.0) / 0.45;
  return {0.05 * up * up * wave(phase), 0.02 * up * wave(phase + 0.15)};
}
Vector2d thigh_at(double z, double phase, int side) {
  const double down = (0.74 - z) / 0.39;
  return {0.09 * side, 0.12 * side * down * wave(phase)};
}
Vector2d arm_at(double z, double phase, int side) {
  const double down = (1.42 - z) / 0.3;
  return {side * (0.225 + 0.05 * down), 0.1 * side * down * wave(phase + 0.5)};
}

constexpr Limb kTorso{1.0, 1.45, 0.15, torso_at, 0};
constexpr Limb kThighs[2] = {{0.35, 0.74, 0.08, thigh_at, -1}, {0.35, 0.74, 0.08, thigh_at, 1}};
constexpr Limb kLimbs[5] = {
    kTorso, kThighs[0], kThighs[1], {1.12, 1.42, 0.045, arm_at, -1}, {1.12, 1.42, 0.045, arm_at, 1}};

// How far the dress is from the z axis at height z, towards `out`: tight on the torso, a hull around both thighs, and
// straight between them.
double dress_reach(const Vector2d& out, double z, double phase) {
  const auto of = [&](const Limb& limb, double height) {
    return limb.at(height, phase, limb.side).dot(out) + limb.radius;
  };
  const auto of_thighs = [&](double height) { return std::max(of(kThighs[0], height), of(kThighs[1], height)); };
  const double top = kThighs[0].upper, waist = kTorso.lower;
  if (z >= waist) return of(kTorso, z);
  if (z <= top) return of_thighs(z);
  const double t = (z - top) / (waist - top);
  return t * of(kTorso, waist) + (1.0 - t) * of_thighs(top);
}

}  // namespace

Workload cloth(int cells, int frames) {
  constexpr double kClearance = 0.004;  // metres by which the wrinkles' middle is above the sphere
  Random random(11);
  const std::vector<Wrinkle> wrinkles = random_wrinkles(5, 1.3, 3.9, 0.012, random);
  const Shape sheet = square_sheet(cells, 4.0), sphere = geodesic_sphere(8);
  Workload workload{frames, {}};
  workload.bodies.resize(2);
  WorkloadBody& body = workload.bodies[0];
  body.facets = sheet.facets;
  body.surface = Surface::sheet;
  body.frames.resize(frames);
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

Workload draped_densely(int cells, int frequency, BodyMotion motion, int frames) {
  const Shape sheet = square_sheet(cells, kDenseWidth), sphere = geodesic_sphere(frequency);
  const std::vector<Wrinkle> wrinkles = dense_wrinkles();
  const auto moved = [&](Matrix3Xd p, double phase) {
    if (motion == BodyMotion::moving) {
      for (Index v = 0; v < p.cols(); ++v) p.col(v) = breathing(p.col(v), phase);
    }
    return p;
  };
  Workload workload{frames, {{.facets = sheet.facets, .surface = Surface::sheet}, {.facets = sphere.facets}}};
  make_frames(workload.bodies[0], frames,
              [&](double phase) { return moved(dense_drape(sheet, wrinkles, phase), phase); });
  make_frames(workload.bodies[1], motion == BodyMotion::moving ? frames : 1,
              [&](double phase) { return moved(sphere.positions, phase); });
  return workload;
}

Workload resting_drape(int cells, int frequency, int frames) {
  const Shape sheet = square_sheet(cells, kDenseWidth), sphere = geodesic_sphere(frequency);
  Random random(22);
  Workload workload{frames, {{.facets = sheet.facets, .surface = Surface::sheet}, {.facets = sphere.facets}}};
  jitter(workload.bodies[0], dense_drape(sheet, dense_wrinkles(), 0.3), 1e-3 * kDenseWidth / cells, frames, random);
  workload.bodies[1].frames = {sphere.positions};
  return workload;
}

Workload garment(int facets, int frames) {
  constexpr double kLowest = 0.45, kHighest = 1.42, kGirth = 1.0, kClearance = 0.002;  // metres
  constexpr double kFigureArea = 1.45;                                                 // square metres
  const double body_edge = std::sqrt(2.0 * kFigureArea / (0.5 * facets));
  const double edge = std::sqrt(2.0 * (kHighest - kLowest) * kGirth / (0.5 * facets));
  const int around = static_cast<int>(kGirth / edge), bands = static_cast<int>((kHighest - kLowest) / edge);
  Workload workload{frames, {}};
  for (const Limb& limb : kLimbs) {
    const Shape shape = capsule((limb.upper - limb.lower) / limb.radius, body_edge / limb.radius);
    workload.bodies.push_back({.facets = shape.facets});
    make_frames(workload.bodies.back(), frames, [&](double phase) {
      Matrix3Xd p = limb.radius * shape.positions;
      for (Index v = 0; v < p.cols(); ++v) {
        p(2, v) += limb.lower;
        p.col(v).head<2>() += limb.at(std::clamp(p(2, v), limb.lower, limb.upper), phase, limb.side);
      }
      return p;
    });
  }
  const Shape dress = tube(around, bands);
  Random random(23);
  std::vector<Wrinkle> wrinkles = random_wrinkles(5, 2.0, 5.0, 0.002, random);
  for (Wrinkle& w : wrinkles) w.x = std::floor(w.x + 0.5);  // the tube closes
  workload.bodies.push_back({.facets = dress.facets, .surface = Surface::sheet});
  make_frames(workload.bodies.back(), frames, [&](double phase) {
    Matrix3Xd p = dress.positions;
    for (Index v = 0; v < p.cols(); ++v) {
      const Vector2d out = dress.positions.col(v).head<2>();
      const double z = kLowest + (kHighest - kLowest) * dress.positions(2, v);
      const double turn = static_cast<double>(v % around) / around;
      const double reach = dress_reach(out, z, phase) + kClearance + height_at(wrinkles, turn, z, phase);
      p.col(v) << reach * out.x(), reach * out.y(), z;
    }
    return p;
  });
  return workload;
}

Workload sheet_stack(int count, int cells, int frames) {
  constexpr double kWidth = 2.0, kGap = 0.002, kHeight = 0.55 * kGap;  // metres
  const Shape sheet = square_sheet(cells, kWidth);
  Random random(24);
  Workload workload{frames, {}};
  for (int k = 0; k < count; ++k) {
    Matrix3Xd rest = sheet.positions;
    for (Index v = 0; v < rest.cols(); ++v) {
      const double x = rest(0, v), y = rest(1, v);
      rest(2, v) =
          kGap * k + 0.1 * wave(0.3 * x) + 0.07 * wave(0.4 * y + 0.1) + kHeight * wave(1.1 * x + 0.9 * y + 0.37 * k);
    }
    workload.bodies.push_back({.facets = sheet.facets, .surface = Surface::sheet});
    jitter(workload.bodies.back(), rest, 1e-3 * kWidth / cells, frames, random);
  }
  return workload;
}

Workload funnel(int around, int frames) {
  constexpr double kThroat = 0.15, kClearance = 0.004, kFold = 0.003;  // metres
  // How wide the funnel is at a height from 0 to 1, metres.
  const auto radius = [](double z) { return kThroat + 0.6 * z * z; };
  const Shape wall = tube(around, around), cloth = tube(around, around);
  Workload workload{
      frames,
      {{.facets = cloth.facets, .surface = Surface::sheet}, {.facets = wall.facets, .surface = Surface::sheet}}};
  Matrix3Xd still = wall.positions;
  for (Index v = 0; v < still.cols(); ++v) still.col(v).head<2>() *= radius(still(2, v));
  workload.bodies[1].frames = {still};
  make_frames(workload.bodies[0], frames, [&](double phase) {
    Matrix3Xd p = cloth.positions;
    for (Index v = 0; v < p.cols(); ++v) {
      const double z = 0.2 + 0.6 * p(2, v) + 0.15 * wave(phase);  // pulled through, and back
      const double turn = static_cast<double>(v % around) / around;
      const double fold = kFold * (1.0 + wave(8.0 * turn + z)) / (0.3 + radius(z));
      p.col(v).head<2>() *= radius(z) - kClearance - fold;
      p(2, v) = z;
    }
    return p;
  });
  return workload;
}

}  // namespace tact::bench
