#include "bench/error/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "bench/measure.h"
#include "engine/base/timer.h"
#include "engine/eigen_vectors.h"

namespace tact::bench {
namespace {

// Of size: hulls that overlap, or are apart, by less are not asked about, and normals whose heights differ by less are
// equally good.
constexpr double kUndecided = 1e-9;
constexpr double kTie = 1e-9;
constexpr double kMinimumTolerance = 1e-12;

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

void HullErrors::judge(const HullAnswer& answer, Minimum minimum, const MinkowskiFaces& faces, const MinkowskiHeight& w,
                       const Eigen::Vector3d& shift, ErrorResult& result) {
  const double size = w.size();
  const MinkowskiFaces::Smallest smallest = faces.smallest(shift, kTie * size);
  if (std::abs(smallest.height) < kUndecided * size) return;
  ++result.queries;
  if (answer.failed) {
    ++result.failed;
  } else if (answer.overlap != (smallest.height > 0.0)) {
    ++(answer.overlap ? result.wrong : result.missed);
  } else if (answer.overlap) {
    const Eigen::Vector3d n = answer.direction.normalized();
    MinkowskiFaces::Nearest truth{smallest.directions.front(), smallest.height};
    if (minimum == Minimum::local) {
      truth = faces.nearest(n, shift);
      if (!w.is_local_minimum(from_eigen(n), kMinimumTolerance * size, from_eigen(shift))) ++result.failed;
    } else {
      truth.direction =
          *std::ranges::min_element(smallest.directions, {}, [&](const auto& m) { return (m - n).norm(); });
    }
    depth_.push_back(std::abs(answer.depth - truth.height) / size);
    direction_.push_back(angle_between(n, truth.direction));
  }
}

void HullErrors::summarize(ErrorResult& result) const {
  if (depth_.empty()) return;
  result.depth_error = *std::ranges::max_element(depth_);
  result.direction_error = *std::ranges::max_element(direction_);
  result.median_depth_error = median(depth_);
  result.median_direction_error = median(direction_);
}

int frame_of_step(int step, int frames) {
  const int place = step % steps_there_and_back(frames);
  return place < frames ? place : steps_there_and_back(frames) - place;
}

std::vector<double> median_step_times(const std::vector<std::function<void(int)>>& steps, int frames, double seconds) {
  constexpr int kTurns = 4;
  std::vector<std::vector<double>> times(steps.size());
  for (int turn = 0; turn < kTurns; ++turn) {
    for (std::size_t k = 0; k < steps.size(); ++k) {
      double spent = 0.0;
      for (int i = 0; spent < 1e3 * seconds / kTurns || i < frames; ++i) {
        base::Timer timer;
        steps[k](frame_of_step(static_cast<int>(times[k].size()), frames));
        times[k].push_back(timer.lap());
        spent += times[k].back();
      }
    }
  }
  std::vector<double> medians;
  for (const std::vector<double>& of_one : times) medians.push_back(1e3 * median(of_one));
  return medians;
}

ErrorResult judge(const HullRow& row, const HullMethodKind& kind) {
  ErrorResult result{.row = row.name, .library = kind.library, .setting = kind.setting, .minimum = kind.minimum};
  HullErrors errors;
  const std::unique_ptr<HullMethod> method = kind.make(row);
  for (int step = 0; step < steps_there_and_back(row.frames); ++step) {
    const int frame = frame_of_step(step, row.frames);
    method->step(frame);
    for (std::size_t i = 0; i < row.pairs.size(); ++i) {
      const HullPair& pair = row.pairs[i];
      const Eigen::Vector3d& shift = pair.path[frame];
      errors.judge(method->answer(i), kind.minimum, pair.faces, pair.height, shift, result);
    }
  }
  errors.summarize(result);
  return result;
}

std::vector<double> measure(const HullRow& row, const std::vector<HullMethodKind>& kinds, double seconds) {
  std::vector<std::unique_ptr<HullMethod>> methods;
  for (const HullMethodKind& kind : kinds) methods.push_back(kind.make(row));
  std::vector<double> times = median_step_times(methods, row.frames, seconds);
  for (double& time : times) time /= static_cast<double>(row.pairs.size());
  return times;
}

}  // namespace tact::bench
