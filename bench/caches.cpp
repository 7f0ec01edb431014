#include "bench/caches.h"

#include <fmt/format.h>
#include <malloc.h>

#include <fstream>
#include <vector>

namespace tact::bench {
namespace {

// The caches of processor 0 in bytes, smallest first; as far as the system tells.
std::vector<double> data_caches() {
  std::vector<double> sizes;
  for (const int index : {0, 2, 3}) {
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/size", index));
    double size = 0.0;
    char unit = ' ';
    if (file >> size >> unit) sizes.push_back(size * (unit == 'K' ? 1024.0 : unit == 'M' ? 1048576.0 : 1.0));
  }
  return sizes;
}

}  // namespace

std::optional<int> cache_level(double bytes) {
  int level = 1;
  for (const double size : data_caches()) {
    if (bytes > size && bytes < 2.0 * size) return std::nullopt;
    level += bytes > size ? 1 : 0;
  }
  return level;
}

std::string level_name(std::optional<int> level) {
  if (!level) return "between";
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

}  // namespace tact::bench
