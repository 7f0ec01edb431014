#include "bench/scaling/rigid.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/answer_line.h"
#include "bench/measure.h"
#include "bench/table.h"
#include "bench/workloads/workloads.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

// The bodies of a workload, each turning about its middle, with a pose a frame and where its vertices then stand.
struct TurningBodies {
  std::vector<Eigen::Matrix3Xd> rest;
  std::vector<Eigen::Matrix3Xi> facets;
  std::vector<std::vector<PoseUpdate>> poses;            // frame, body; without ids
  std::vector<std::vector<Eigen::Matrix3Xd>> positions;  // frame, body

  TurningBodies(const Workload& workload, int frames) {
    for (const WorkloadBody& body : workload.bodies) {
      rest.push_back(body.frames[0]);
      facets.push_back(body.facets);
    }
    for (int frame = 0; frame < frames; ++frame) {
      poses.emplace_back();
      positions.emplace_back();
      for (std::size_t i = 0; i < rest.size(); ++i) {
        const Eigen::Vector3d middle = rest[i].rowwise().mean();
        const auto number = static_cast<double>(i);
        const Eigen::Vector3d axis = Eigen::Vector3d(std::sin(number), std::cos(number), 0.5).normalized();
        const Eigen::Matrix3d r = Eigen::AngleAxisd(0.02 * (frame + 1), axis).toRotationMatrix();
        const Eigen::Vector3d t = middle - r * middle;
        poses.back().push_back({{}, r, t});
        positions.back().push_back(placed(rest[i], r, t));
      }
    }
  }

 private:
  // As World::set_pose() promises it.
  static Eigen::Matrix3Xd placed(const Eigen::Matrix3Xd& at, const Eigen::Matrix3d& r, const Eigen::Vector3d& t) {
    Eigen::Matrix3Xd result(3, at.cols());
    for (Eigen::Index v = 0; v < at.cols(); ++v) {
      for (int k = 0; k < 3; ++k)
        result(k, v) = ((r(k, 0) * at(0, v) + r(k, 1) * at(1, v)) + r(k, 2) * at(2, v)) + t[k];
    }
    return result;
  }
};

// What a program gives the world in every frame: poses, vertices that it has, or vertices that it computes from poses.
enum class Given { poses, vertices, computed_vertices };

struct StepTimes {
  double set_ms = 0.0, detect_ms = 0.0;
  double sum() const { return set_ms + detect_ms; }
};

class Player {
 public:
  Player(const TurningBodies& bodies, Given given, int threads)
      : bodies_(bodies), given_(given), threads_(threads), world_({.threads = threads}) {
    const Motion motion = given == Given::poses ? Motion::rigid : Motion::deformable;
    for (std::size_t i = 0; i < bodies.rest.size(); ++i) {
      const BodyId id = world_.add_body({.positions = bodies.rest[i], .facets = bodies.facets[i], .motion = motion});
      positions_.push_back({id, bodies.rest[i]});
      poses_.push_back({id});
    }
    world_.detect();
  }

  // Nothing is copied while it is timed: a program has what it gives, but for vertices that it computes.
  StepTimes step(int frame) {
    const auto f = static_cast<std::size_t>(frame) % bodies_.poses.size();
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      poses_[i].rotation = bodies_.poses[f][i].rotation;
      poses_[i].translation = bodies_.poses[f][i].translation;
      if (given_ == Given::vertices) positions_[i].positions = bodies_.positions[f][i];
    }
    const double begin = wall_ms();
    if (given_ == Given::computed_vertices) compute_vertices();
    if (given_ == Given::poses) {
      world_.set_poses(poses_);
    } else {
      world_.set_positions(positions_);
    }
    const double set = wall_ms();
    report_ = &world_.detect();
    return {set - begin, wall_ms() - set};
  }
  const Report& report() const { return *report_; }

 private:
  void compute_vertices() {
    constexpr std::size_t kAtATime = 16;  // bodies
    base::parallel_for(positions_.size(), kAtATime, threads_, [&](std::size_t i) {
      positions_[i].positions = poses_[i].rotation.lazyProduct(bodies_.rest[i]).colwise() + poses_[i].translation;
    });
  }

  const TurningBodies& bodies_;
  Given given_;
  int threads_;
  World world_;
  const Report* report_ = nullptr;
  std::vector<PositionsUpdate> positions_;
  std::vector<PoseUpdate> poses_;
};

// The same bodies with their middles farther from the origin.
Workload spread(Workload workload, double factor) {
  for (WorkloadBody& body : workload.bodies) {
    const Eigen::Vector3d away = (factor - 1.0) * body.frames[0].rowwise().mean();
    for (Eigen::Matrix3Xd& frame : body.frames) frame.colwise() += away;
  }
  return workload;
}

struct Scene {
  std::string name;
  std::function<Workload()> make;
};

StepTimes median_of(const std::vector<StepTimes>& steps) {
  std::vector<double> set, detect;
  for (const StepTimes& step : steps) {
    set.push_back(step.set_ms);
    detect.push_back(step.detect_ms);
  }
  return {median(set), median(detect)};
}

// With one thread the answers are added to `answers`.
void add_row(const Scene& scene, int threads, double budget_ms, Table& table, tests::AnswerHash& answers) {
  constexpr int kFrames = 4;
  const TurningBodies bodies(scene.make(), kFrames);
  Player by_pose(bodies, Given::poses, threads), by_vertices(bodies, Given::vertices, threads),
      computed(bodies, Given::computed_vertices, threads);
  std::int64_t placed = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    for (Player* const player : {&by_pose, &by_vertices, &computed}) player->step(frame);
    if (by_pose.report().hash() != by_vertices.report().hash())
      throw std::runtime_error(scene.name + ": the answers differ");
    if (threads == 1) answers.add(by_pose.report());
    placed = by_pose.report().stats().placed_bodies;
  }
  std::vector<StepTimes> pose_steps, vertex_steps, computed_steps;
  int frame = 0;
  for (const double start = wall_ms(); frame < 6 || wall_ms() - start < budget_ms; ++frame) {
    pose_steps.push_back(by_pose.step(frame));
    vertex_steps.push_back(by_vertices.step(frame));
    computed_steps.push_back(computed.step(frame));
  }
  const StepTimes pose = median_of(pose_steps), vertices = median_of(vertex_steps), all = median_of(computed_steps);
  table.add({scene.name, fmt::to_string(bodies.rest.size()), fmt::to_string(placed), fmt::to_string(threads),
             three_digits(vertices.set_ms), three_digits(vertices.detect_ms), three_digits(all.set_ms),
             three_digits(pose.set_ms), three_digits(pose.detect_ms), three_digits(pose.sum() / vertices.sum()),
             three_digits(vertices.detect_ms / vertices.sum()), three_digits(pose.sum() / all.sum())});
}

}  // namespace

int run_rigid(const BenchOptions& options) {
  const int threads = thread_count(options.threads), few = options.quick ? 20 : 1;
  const double budget_ms = options.quick ? 50.0 : 3000.0;
  fmt::print("{}\n\n", machine_line(threads));
  const std::vector<Scene> scenes{
      {"scattered, 80 facets", [=] { return scattered(10000 / few, 2); }},
      {"pile, 5,120 facets", [=] { return pile(250 / few, 16, 2); }},
      {"apart, 320 facets", [=] { return spread(pile(10000 / few, 4, 2), 1.5); }},
      {"apart, 1,280 facets", [=] { return spread(pile(2000 / few, 8, 2), 1.5); }},
      {"pile, 320 facets", [=] { return pile(4000 / few, 4, 2); }},
  };
  // "at least" is what setting poses for nothing would leave: what detect() takes where the vertices are there.
  Table table({"bodies that turn", "bodies", "placed a step", "threads", "set vertices ms", "detect ms",
               "compute and set vertices ms", "set poses ms", "detect and place ms", "poses / vertices", "at least",
               "poses / computed vertices"});
  tests::AnswerHash answers;
  for (const Scene& scene : scenes) {
    if (!options.plays(scene.name)) continue;
    for (int t = 1; t <= threads; t *= 2) add_row(scene, t, budget_ms, table, answers);
  }
  if (table.empty()) options.reject_only();
  table.print();
  print_answer_line(answers);
  if (!options.out.empty()) table.write_csv(options.out / "rigid.csv");
  return 0;
}

}  // namespace tact::bench
