// Many threads call const functions of one world, between the calls that change it.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <thread>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/generators/random.h"
#include "tests/support/hashes/answer_hash.h"

namespace tact::tests {
namespace {

constexpr int kThreads = 16;

Eigen::Vector3d vector_in(double size, Random& random) {
  const Vec3 p = random.in_cube(size);
  return {p.x, p.y, p.z};
}

void ask_many_at_once(const World& world, Random& random, AnswerHash& hash) {
  std::vector<Ray> rays(300);
  std::vector<PointQuery> points(60);
  for (Ray& ray : rays) ray = {vector_in(6.0, random), vector_in(6.0, random)};
  for (PointQuery& point : points) point.point = vector_in(6.0, random);
  std::vector<RayHit> hits(rays.size());
  world.cast_rays(rays, hits);
  hash.add(hits);
  std::vector<ClosestPoint> closest(points.size());
  world.closest_points(points, closest);
  hash.add(closest);
  std::vector<std::vector<BodyId>> containing(points.size());
  world.bodies_containing_each(points, containing);
  for (const std::vector<BodyId>& bodies : containing) hash.add(bodies);
  std::vector<ClosestPoint> signed_ones(points.size());
  world.signed_distances(points, signed_ones);
  hash.add(signed_ones);
}

void ask_of_bodies(const World& world, Random& random, AnswerHash& hash) {
  const std::vector<BodyId> bodies = world.bodies();
  const auto any = [&] { return bodies[static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())))]; };
  for (const BodyDistance& near : world.nearest_bodies({.body = any(), .count = 3})) hash.add(near.a_barycentric);
  const SweepHit hit = world.sweep({.body = any(), .way = vector_in(3.0, random), .angle = 0.5});
  hash.add(hit.barycentric);
  const BodyId a = any(), b = any();
  if (a != b) hash.add(std::array{world.distance({a, b}).distance, world.overlap(a, b).volume, hit.fraction});
}

void ask_one_by_one(const World& world, Random& random, AnswerHash& hash) {
  for (int i = 0; i < 10; ++i) {
    const Ray ray{vector_in(6.0, random), vector_in(6.0, random)};
    const PointQuery point{.point = vector_in(4.0, random)};
    const Eigen::Vector3d lower = vector_in(4.0, random);
    hash.add(world.cast_ray(ray));
    hash.add(world.cast_ray(ray, RayHits::any));
    hash.add(world.cast_ray_all(ray));
    hash.add(world.closest_point(point));
    hash.add(world.bodies_containing(point));
    hash.add(world.overlap_box({.lower = lower, .upper = lower + Eigen::Vector3d(0.5, 0.5, 0.5)}));
  }
}

void look_at_bodies(const World& world, Random& random, AnswerHash& hash) {
  const std::vector<BodyId> bodies = world.bodies();
  for (int i = 0; i < 10; ++i) {
    const BodyId body = bodies[static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())))];
    const Bounds bounds = world.bounds(body);
    hash.add(bounds.lower);
    hash.add(bounds.upper);
    std::vector<double> positions(3 * world.vertex_count(body));
    world.copy_positions(body, positions);
    hash.add(positions);
    hash.add_feature(world.name(body).size() + world.layer(body) + world.facet_count(body));
    hash.add_feature(static_cast<std::uint64_t>(world.motion(body)) + (world.contains(body) ? 1 : 0));
  }
}

// What a thread asks; in another order than its neighbours.
std::uint64_t answers(const World& world, int thread) {
  AnswerHash hash;
  Random random(static_cast<std::uint64_t>(thread) + 1);
  for (int i = 0; i < 3; ++i) {
    const int kind = (i + thread) % 3;
    if (kind == 0) ask_many_at_once(world, random, hash);
    if (kind == 1) ask_one_by_one(world, random, hash), ask_of_bodies(world, random, hash);
    if (kind == 2) look_at_bodies(world, random, hash);
  }
  const AnswerHashes hashes = hash.hashes();
  return hashes.features ^ (hashes.numbers + 1);
}

// Rigid bodies are placed, and the tree over bodies is made, by whichever thread comes first.
class ConstCalls {
 public:
  explicit ConstCalls(int threads) : world_({.threads = threads}) {
    for (const Mesh& blob : crowd_of_blobs(150, 9))
      moving_.push_back(world_.add_body({.positions = blob.positions, .facets = blob.facets}));
    const Mesh ball = icosphere(2);
    for (int i = 0; i < 30; ++i)
      rigid_.push_back(world_.add_body({.positions = ball.positions, .facets = ball.facets, .motion = Motion::rigid}));
  }

  void move(int step) {
    Random random(static_cast<std::uint64_t>(step) + 100);
    const std::vector<Mesh> blobs = crowd_of_blobs(150, static_cast<std::uint64_t>(step) + 20);
    for (std::size_t i = 0; i < moving_.size(); i += step % 2 == 0 ? 1 : 50)
      if (world_.vertex_count(moving_[i]) == static_cast<std::size_t>(blobs[i].positions.cols()))
        world_.set_positions(moving_[i], blobs[i].positions);
    for (const BodyId body : rigid_) {
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.25 * step, Eigen::Vector3d::UnitX()).toRotationMatrix();
      world_.set_pose(body, turn, vector_in(5.0, random));
    }
    if (step % 3 == 2) world_.detect();
  }
  const World& world() const { return world_; }

 private:
  World world_;
  std::vector<BodyId> moving_, rigid_;
};

// Of a world alone, without the threads.
std::vector<std::uint64_t> answers_one_after_another() {
  ConstCalls calls(1);
  std::vector<std::uint64_t> all;
  for (int step = 0; step < 5; ++step) {
    calls.move(step);
    for (int thread = 0; thread < kThreads; ++thread) all.push_back(answers(calls.world(), thread));
  }
  return all;
}

TEST(ConstCalls, OfManyThreadsAtOnceHaveTheAnswersOfOne) {
  const std::vector<std::uint64_t> expected = answers_one_after_another();
  for (const int own_threads : {1, 2}) {
    ConstCalls calls(own_threads);
    std::vector<std::uint64_t> found;
    for (int step = 0; step < 5; ++step) {
      calls.move(step);
      std::vector<std::uint64_t> of_threads(kThreads);
      std::vector<std::thread> threads;
      for (int thread = 0; thread < kThreads; ++thread) {
        threads.emplace_back(
            [&, thread] { of_threads[static_cast<std::size_t>(thread)] = answers(calls.world(), thread); });
      }
      for (std::thread& thread : threads) thread.join();
      found.insert(found.end(), of_threads.begin(), of_threads.end());
    }
    EXPECT_EQ(found, expected) << own_threads << " threads of the world's own";
  }
}

}  // namespace
}  // namespace tact::tests
