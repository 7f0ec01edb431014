#include "bench/workloads/workloads.h"

#include <Eigen/Geometry>
#include <numeric>

#include "bench/workloads/shapes.h"

namespace tact::bench {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

}  // namespace

std::size_t Workload::facet_count() const {
  return std::accumulate(bodies.begin(), bodies.end(), std::size_t{0}, [](std::size_t sum, const WorkloadBody& body) {
    return sum + static_cast<std::size_t>(body.facets.cols());
  });
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
  // Of a sine in six frames two that follow each other are the same, which would be a step without motion.
  constexpr int kFrames = 24, kFewFrames = 8;
  if (size == Size::small) {
    return {
        {"cloth 3 k", "a sheet over a sphere", 5.0, [] { return cloth(40, kFewFrames); }},
        {"pile 27 x 320", "blobs, six neighbours each", 4.0, [] { return pile(27, 4, kFewFrames); }},
        {"organ and tool", "600 facets", 1.5, [] { return organ_and_tool(kFewFrames); }},
        {"500 x 80 scattered", "few touch", 4.0, [] { return scattered(500, kFewFrames); }},
        {"two of 8 k", "shallow overlap", 8.0, [] { return large_pair(20, kFewFrames); }},
        {"bricks aligned", "exact contact", 1.5, [] { return brick_wall(4, 4, Pose::aligned, kFewFrames); }},
        {"bricks rotated", "contact on the last bit", 8.0, [] { return brick_wall(4, 4, Pose::rotated, kFewFrames); }},
        {"terrain", "blobs on a height field", 1.0, [] { return terrain(60, 16, kFewFrames); }},
        {"sheets in layers", "all near", 1.0, [] { return layers(3, 30, kFewFrames); }},
        {"shells", "one in the other", 1.0, [] { return shells(12, kFewFrames); }},
        {"chain", "rings that are linked", 1.0, [] { return chain(10, kFewFrames); }},
        {"rods", "long and thin", 1.0, [] { return crossed_rods(4, kFewFrames); }},
        {"two boxes", "24 facets", 1.0, [] { return two_boxes(kFewFrames); }},
        {"drape 3 k", "a sheet on a sphere", 4.0, [] { return draped_densely(32, 8, BodyMotion::still, kFewFrames); }},
        {"drape 4 k, moving", "on a body that breathes", 4.0,
         [] { return draped_densely(40, 8, BodyMotion::moving, kFewFrames); }},
        {"drape 4 k, at rest", "jitter", 4.0, [] { return resting_drape(40, 8, kFewFrames); }},
        {"garment 4 k", "a dress on a walking figure", 4.0, [] { return garment(4000, kFewFrames); }},
        {"stack of 6", "sheets at rest", 4.0, [] { return sheet_stack(6, 20, kFewFrames); }},
        {"funnel", "cloth pulled through", 4.0, [] { return funnel(24, kFewFrames); }},
        {"twisted rods", "of long facets", 1.0, [] { return twisted_rods(3, 60, 15, kFewFrames); }},
        {"figures", "that fold", 1.0, [] { return folding_figures(2, 2000, kFewFrames); }},
        {"drawn funnel", "facets without area", 1.0, [] { return drawn_funnel(24, kFewFrames); }},
        {"slivers", "tubes across each other", 1.0, [] { return slivers(600, kFewFrames); }},
        {"cloth-over-sphere", "recorded", 4.0, [] { return recorded("cloth-over-sphere", 20, 40, kFewFrames); }},
        {"pile", "recorded", 4.0, [] { return recorded("pile", 12, 20, kFewFrames); }}};
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
      {"terrain", "100 blobs on a height field", 1.0, [] { return terrain(150, 100, kFrames); }},
      {"sheets in layers", "each touches the next", 1.0, [] { return layers(4, 60, kFrames); }},
      {"shells", "a sphere close inside another", 1.0, [] { return shells(32, kFrames); }},
      {"chain", "200 rings that are linked", 1.0, [] { return chain(200, kFrames); }},
      {"rods", "1,000 long and thin ones", 1.0, [] { return crossed_rods(10, kFrames); }},
      {"two boxes", "the smallest scene", 1.0, [] { return two_boxes(kFrames); }},
      {"drape 13 k", "a sheet of 8 k on a body of 5 k", 4.0,
       [] { return draped_densely(64, 16, BodyMotion::still, kFrames); }},
      {"drape 151 k, moving", "131 k on 20 k, the body breathes", 4.0,
       [] { return draped_densely(256, 32, BodyMotion::moving, kFrames); }},
      {"drape 606 k", "524 k on 82 k, wrinkles cross in patches", 4.0,
       [] { return draped_densely(512, 64, BodyMotion::still, kFrames); }},
      {"drape 606 k, at rest", "the same, every vertex moves by less than a thousandth of an edge", 4.0,
       [] { return resting_drape(512, 64, kFrames); }},
      {"garment 6 k", "a dress on a walking figure of capsules", 4.0, [] { return garment(6'000, kFrames); }},
      {"garment 60 k", "a dress on a walking figure of capsules", 4.0, [] { return garment(60'000, kFrames); }},
      {"garment 600 k", "a dress on a walking figure of capsules", 4.0, [] { return garment(600'000, kFrames); }},
      {"stack of 20", "sheets at rest, jitter", 4.0, [] { return sheet_stack(20, 50, kFrames); }},
      {"funnel", "cloth pulled through, nothing meets", 4.0, [] { return funnel(67, kFrames); }},
      {"twisted rods", "four about each other at random pitch, of long facets", 1.0,
       [] { return twisted_rods(4, 100, 25, kFrames); }},
      {"figures", "nine of 17 k that sink together", 1.0, [] { return folding_figures(3, 17'000, kFrames); }},
      {"drawn funnel", "the funnel's cloth, of which a quarter has no area", 1.0,
       [] { return drawn_funnel(67, kFrames); }},
      {"slivers", "two tubes of 4 k across each other, facets as long as they", 1.0,
       [] { return slivers(2000, kFrames); }},
      {"cloth-over-sphere", "recorded from the scene", 4.0,
       [] { return recorded("cloth-over-sphere", 64, 150, kFrames); }},
      {"pile recorded", "100 bodies, from the scene", 4.0, [] { return recorded("pile", 100, 300, kFrames); }},
  };
}

}  // namespace tact::bench
