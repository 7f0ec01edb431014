// Clocks, and the figures that are made of many times.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <vector>

namespace tact::bench {

// Milliseconds of wall time since some moment.
inline double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Milliseconds of processor time that all threads of the process have used.
inline double processor_ms() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// Reading the processor's clock is a system call: shorter work is timed by wall time alone.
inline constexpr double kShortWork_ms = 0.2;

// How long work() takes, in milliseconds. On one thread that is processor time, so that other programs on the machine
// disturb it less; on several, and for short work, wall time.
template <class Work>
double time_ms(int threads, double expected_ms, const Work& work) {
  const bool by_processor = threads == 1 && expected_ms > kShortWork_ms;
  const double start = by_processor ? processor_ms() : wall_ms();
  work();
  return (by_processor ? processor_ms() : wall_ms()) - start;
}

// The value below which the given part of `values` lies, 0 to 1; `values` must not be empty.
inline double quantile(std::vector<double> values, double part) {
  const auto rank = static_cast<std::size_t>(std::llround(part * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

// The sum of `count` doubles, in as many chains as it takes for memory to be the bound.
inline double sum_of(const double* values, std::size_t count) {
  std::array<double, 16> lanes{};
  const std::size_t whole = count - count % lanes.size();
  for (std::size_t k = 0; k < whole; k += lanes.size()) {
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) lanes[lane] += values[k + lane];
  }
  double sum = 0.0;
  for (const double lane : lanes) sum += lane;
  for (std::size_t k = whole; k < count; ++k) sum += values[k];
  return sum;
}

// The exponent e of the best fit y = c * x^e: the slope of log y over log x by least squares. At least two points.
inline double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double u = std::log(x[k]), v = std::log(y[k]);
    sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  const double n = static_cast<double>(x.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace tact::bench
