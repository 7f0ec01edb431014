// Bodies that meet themselves, see workloads.h.
#include <algorithm>
#include <filesystem>
#include <numbers>

#include "bench/workloads/shapes.h"
#include "bench/workloads/workloads.h"
#include "engine/base/parallel.h"
#include "scenes/files/body_files.h"

namespace tact::bench {

using Eigen::Index;
using Eigen::Matrix3Xd;

Workload cloth_alone(int cells, int frames) {
  Workload both = cloth(cells, frames);
  both.bodies.resize(1);
  return both;
}

Workload rolled_cloth(int cells, int frames) {
  constexpr double kLength = 2.0, kGap = 0.03, kWave = 0.03;  // metres
  const Shape sheet = square_sheet(cells, kLength);
  Workload workload{frames, {{.facets = sheet.facets, .surface = Surface::sheet}}};
  workload.bodies[0].frames.resize(frames);
  base::parallel_for(static_cast<std::size_t>(frames), 1, base::default_threads(), [&](std::size_t frame) {
    const double turns = 0.5 + 2.0 * wave(0.5 * phase_of(static_cast<int>(frame), frames));
    const double radius = kLength / (2.0 * std::numbers::pi * turns);
    Matrix3Xd& p = workload.bodies[0].frames[frame];
    p.resize(3, sheet.positions.cols());
    for (Index v = 0; v < p.cols(); ++v) {
      const double along = sheet.positions(0, v) / kLength + 0.5, y = sheet.positions(1, v), turn = turns * along;
      const double r = radius + kGap * turn + kWave * wave(1.7 * y + 3.1 * along);
      const Eigen::Vector2d at = r * on_circle(turn);
      p.col(v) << at.x(), y, at.y();
    }
  });
  return workload;
}

Workload toy_figure(int frames, double part_of_way) {
  const std::filesystem::path folder = "../shared/data/seq_toy_poses";
  if (!std::filesystem::is_directory(folder)) return {};
  const scenes::BodyFrames poses = scenes::read_bodies({folder}).front();
  Workload workload{frames, {{.facets = poses.facets}}};
  const auto last = static_cast<int>(poses.positions.size()) - 1;
  for (int frame = 0; frame < frames; ++frame) {
    const int half = frames / 2, there = frame <= half ? frame : frames - frame;
    const double at = part_of_way * static_cast<double>(last) * there / half;
    const int pose = std::min(static_cast<int>(at), last - 1);
    const double part = at - pose;
    workload.bodies[0].frames.push_back((1.0 - part) * poses.positions[pose] +
                                        part * poses.positions[static_cast<std::size_t>(pose) + 1]);
  }
  return workload;
}

}  // namespace tact::bench
