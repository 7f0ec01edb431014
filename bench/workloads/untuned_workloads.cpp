// Workloads of other kinds, see workloads.h.
#include <Eigen/Geometry>
#include <utility>

#include "bench/random.h"
#include "bench/workloads/shapes.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// A body through which a wave travels: of a random direction, that shifts by up to `height` metres.
WorkloadBody wavering(const Shape& shape, int frames, double height, Random& random) {
  const Vector3d along = 3.0 * random.direction(), shift = height * random.direction();
  const double delay = random.uniform(0.0, 1.0);
  WorkloadBody body{.facets = shape.facets};
  for (int frame = 0; frame < frames; ++frame) {
    Matrix3Xd& p = body.frames.emplace_back(shape.positions);
    const double phase = phase_of(frame, frames) + delay;
    for (Index v = 0; v < p.cols(); ++v) p.col(v) += wave(along.dot(shape.positions.col(v)) + phase) * shift;
  }
  return body;
}

Matrix3d random_rotation(Random& random) {
  const Vector3d axis = random.direction();
  const double half = random.uniform(-1.0, 1.0);  // tangent of a quarter of the angle, and more
  return Eigen::Quaterniond(1.0, half * axis.x(), half * axis.y(), half * axis.z()).normalized().toRotationMatrix();
}

Vector3d in_cube(double edge, Random& random) {
  const double x = random.uniform(0.0, edge), y = random.uniform(0.0, edge), z = random.uniform(0.0, edge);
  return {x, y, z};
}

// The shape turned at random, somewhere in a cube.
Shape strewn(Shape shape, double edge, Random& random) {
  const Matrix3d rotation = random_rotation(random);
  shape.positions = ((rotation * shape.positions).colwise() + in_cube(edge, random)).eval();
  return shape;
}

}  // namespace

Workload layers(int count, int cells, int frames) {
  constexpr double kGap = 0.01, kHeight = 0.55 * kGap;  // metres; the sheets are 2 m wide
  const Shape sheet = square_sheet(cells, 2.0);
  Workload workload{frames, {}};
  for (int k = 0; k < count; ++k) {
    WorkloadBody body{.facets = sheet.facets, .surface = Surface::sheet};
    for (int frame = 0; frame < frames; ++frame) {
      Matrix3Xd& p = body.frames.emplace_back(sheet.positions);
      for (Index v = 0; v < p.cols(); ++v) {
        const double x = p(0, v), y = p(1, v);
        p(2, v) = kGap * k + 0.3 * wave(0.3 * x) + 0.2 * wave(0.4 * y + 0.1) +
                  kHeight * wave(1.7 * x + 0.9 * y + phase_of(frame, frames) + 0.37 * k);
      }
    }
    workload.bodies.push_back(std::move(body));
  }
  return workload;
}

Workload shells(int frequency, int frames) {
  constexpr double kInner = 0.998, kHeight = 0.05;  // metres
  Workload workload{frames, {}};
  for (const double radius : {1.0, kInner}) {
    Shape sphere = geodesic_sphere(frequency);
    sphere.positions *= radius;
    Random random(16);  // both move alike
    workload.bodies.push_back(wavering(sphere, frames, kHeight, random));
  }
  return workload;
}

Workload chain(int links, int frames) {
  constexpr double kSpacing = 1.5, kTube = 0.18, kHeight = 0.08;  // metres, radius 1
  const Shape link = ring(kTube, 32, 16);
  Random random(17);
  Workload workload{frames, {}};
  for (int k = 0; k < links; ++k) {
    Shape turned = link;
    if (k % 2 == 1) {  // by a right angle about the x axis
      turned.positions.row(1) = -link.positions.row(2);
      turned.positions.row(2) = link.positions.row(1);
    }
    turned.positions.row(0).array() += kSpacing * k;
    workload.bodies.push_back(wavering(turned, frames, kHeight, random));
  }
  return workload;
}

Workload crossed_rods(int side, int frames) {
  constexpr double kRadius = 0.01, kSpacing = 0.35, kHeight = 0.01;  // metres, length 1
  Shape thin = rod(8, 20);
  thin.positions.topRows(2) *= kRadius;
  Random random(18);
  Workload workload{frames, {}};
  for (int k = 0; k < side * side * side; ++k)
    workload.bodies.push_back(wavering(strewn(thin, kSpacing * side, random), frames, kHeight, random));
  return workload;
}

Workload two_boxes(int frames) {
  const Shape box = brick({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3});
  Random random(19);
  Workload workload{frames, {}};
  for (int k = 0; k < 2; ++k) workload.bodies.push_back(wavering(strewn(box, 0.8, random), frames, 0.02, random));
  return workload;
}

}  // namespace tact::bench
