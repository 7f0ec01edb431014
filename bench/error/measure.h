// Errors of methods against the truth, and their times.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/error/methods.h"

namespace tact::bench {

// A method on a row. Lengths are in units of the pair's size, the largest edge of the box around both.
struct ErrorResult {
  std::string row;
  std::string library;
  std::string setting;
  Minimum minimum = Minimum::smallest;
  double microseconds = 0.0;  // a pair and step, median over the steps
  int queries = 0;            // pairs and steps that were judged
  int missed = 0;             // overlapping hulls called apart; or facet pairs that were not found
  int wrong = 0;              // hulls apart called overlapping; or facet pairs found that do not meet
  int failed = 0;  // no answer: threw, not a number, a limit reached, or a direction that is no minimum at all
  // Against the nearest minimum of w that the method promises: the smallest one, or a local one. Largest and median.
  // Nothing for methods without a depth.
  std::optional<double> depth_error = {}, median_depth_error = {};
  std::optional<double> direction_error = {}, median_direction_error = {};  // radians
};

// Collects errors of depth and direction, and writes the largest and the median of each into a result.
class HullErrors {
 public:
  // `answer` against the smallest or the nearest minimum of w, where the second body is shifted by `shift`. Counts it
  // in `result` as a query, unless the hulls touch or nearly do.
  void judge(const HullAnswer& answer, Minimum minimum, const MinkowskiFaces& faces, const MinkowskiHeight& w,
             const Eigen::Vector3d& shift, ErrorResult& result);
  void summarize(ErrorResult& result) const;

 private:
  std::vector<double> depth_, direction_;
};

// The frame of a step, where frames are played there and back again, and the steps until they begin anew.
int frame_of_step(int step, int frames);
inline int steps_there_and_back(int frames) { return 2 * frames - 2; }

// The median time of a step of each method in microseconds: `step(frame)` is called for the frames there and back
// again, at least twice, for about `seconds` a method. They take turns, so that what disturbs the machine for a while
// disturbs all.
std::vector<double> median_step_times(const std::vector<std::function<void(int)>>& steps, int frames, double seconds);

template <class Method>
std::vector<double> median_step_times(const std::vector<std::unique_ptr<Method>>& methods, int frames, double seconds) {
  std::vector<std::function<void(int)>> steps;
  for (const auto& method : methods) steps.emplace_back([&](int frame) { method->step(frame); });
  return median_step_times(steps, frames, seconds);
}

// All answers of a method for all frames of a row, there and back again.
ErrorResult judge(const HullRow& row, const HullMethodKind& kind);
// The median time of a pair in microseconds, of each method.
std::vector<double> measure(const HullRow& row, const std::vector<HullMethodKind>& kinds, double seconds);

}  // namespace tact::bench
