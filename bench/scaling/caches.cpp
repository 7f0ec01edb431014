#include "bench/scaling/caches.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "bench/measure.h"

namespace tact::bench {
namespace {

// The caches of processor 0 in bytes, smallest first; as far as the system tells, or else the C library, which asks the
// processor: virtual machines may have no files of them.
std::vector<double> named_caches() {
  std::vector<double> sizes;
  for (const int index : {0, 2, 3}) {
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/size", index));
    double size = 0.0;
    char unit = ' ';
    if (file >> size >> unit) sizes.push_back(size * (unit == 'K' ? 1024.0 : unit == 'M' ? 1048576.0 : 1.0));
  }
  if (!sizes.empty()) return sizes;
  for (const int name : {_SC_LEVEL1_DCACHE_SIZE, _SC_LEVEL2_CACHE_SIZE, _SC_LEVEL3_CACHE_SIZE}) {
    if (const long size = sysconf(name); size > 0) sizes.push_back(static_cast<double>(size));
  }
  return sizes;
}

// Bytes a millisecond at which the first `bytes` are read, again and again, when nothing disturbs.
double reading_rate(const std::vector<double>& memory, double bytes) {
  constexpr int kTimes = 9;
  const auto count = static_cast<std::size_t>(bytes / sizeof(double));
  double sum = sum_of(memory.data(), count), least = HUGE_VAL;
  for (int k = 0; k < kTimes; ++k) {
    const double start = wall_ms();
    sum += sum_of(memory.data(), count);
    least = std::min(least, wall_ms() - start);
  }
  if (!std::isfinite(sum)) throw std::logic_error("a sum of ones is not finite");  // used, so that it is made
  return bytes / least;
}

// How much of a cache of `size` bytes, above one of `smaller`, is read nearly as fast as a little of it.
double part_held(double smaller, double size) {
  constexpr double kStep = 1.25, kNearly = 2.0 / 3.0;
  const std::vector<double> memory(static_cast<std::size_t>(size / sizeof(double)), 1.0);
  double held = std::min(2.0 * smaller, size);
  const double rate = reading_rate(memory, held);
  for (double bytes = held; bytes <= size; bytes *= kStep) {
    if (reading_rate(memory, bytes) >= kNearly * rate) held = bytes;
  }
  return kStep * held > size ? size : held;
}

const std::vector<double>& data_caches() {
  static const std::vector<double> sizes = [] {
    std::vector<double> found = named_caches();
    if (found.size() > 1) found.back() = part_held(found[found.size() - 2], found.back());
    return found;
  }();
  return sizes;
}

}  // namespace

std::optional<int> cache_level(double bytes) {
  if (data_caches().empty()) return std::nullopt;
  int level = 1;
  for (const double size : data_caches()) {
    if (bytes > size && bytes < 2.0 * size) return std::nullopt;
    level += bytes > size ? 1 : 0;
  }
  return level;
}

std::string cache_line() {
  const std::vector<double> named = named_caches();
  if (named.empty()) return "the system names no caches";
  std::string line = "caches of";
  for (const double size : named) line += fmt::format("{} {} kB", size == named.front() ? "" : ",", size / 1024.0);
  return line + fmt::format("; of the last {:.0f} kB are read nearly as fast as a few", data_caches().back() / 1024.0);
}

std::string level_name(std::optional<int> level) {
  if (!level) return data_caches().empty() ? "unknown" : "between";
  return *level > 3 ? "memory" : fmt::format("L{}", *level);
}

double heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

double frame_bytes(const Workload& workload) {
  double bytes = 0.0;
  for (const WorkloadBody& body : workload.bodies)
    bytes += static_cast<double>(body.frames.front().size()) * sizeof(double);
  return bytes;
}

double copy_ms(const Workload& workload, int frames, double budget_ms) {
  std::vector<Eigen::Matrix3Xd> copies;
  for (const WorkloadBody& body : workload.bodies) copies.push_back(body.positions(0));
  std::vector<double> times;
  const double start = wall_ms();
  for (int k = 0; k < 8 || wall_ms() - start < budget_ms; ++k) {
    const double begin = wall_ms();
    for (std::size_t i = 0; i < copies.size(); ++i) {
      const Eigen::Matrix3Xd& positions = workload.bodies[i].positions(k % frames);
      std::copy_n(positions.data(), positions.size(), copies[i].data());
    }
    times.push_back(wall_ms() - begin);
  }
  return median(times);
}

}  // namespace tact::bench
