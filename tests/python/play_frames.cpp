// Plays the frames in a file that frames.py has written: the C++ side of what Python is held against.
//
//   play_frames FILE THREADS [MARGIN]
//
// Prints the hash of each step, then the median milliseconds of a step, of processor time if there is one thread. With
// a margin all points are read.
#include <tact/tact.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace {

class Reader {
 public:
  explicit Reader(const char* file) : stream_(file, std::ios::binary) {}
  std::int64_t number() {
    std::int64_t value = 0;
    read(&value, sizeof value);
    return value;
  }
  template <class Scalar>
  Eigen::Matrix<Scalar, 3, Eigen::Dynamic> columns() {
    Eigen::Matrix<Scalar, 3, Eigen::Dynamic> matrix(3, number());
    read(matrix.data(), sizeof(Scalar) * static_cast<std::size_t>(matrix.size()));
    return matrix;
  }

 private:
  void read(void* to, std::size_t bytes) {
    if (!stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)))
      throw std::runtime_error("the file ends early");
  }
  std::ifstream stream_;
};

// All points of a report, in memory that is used again.
struct Points {
  void read(const tact::Report& report) {
    const std::size_t count = point_count(report);
    bodies.resize(2 * count), contacts.resize(count), kinds.resize(count), minima.resize(count);
    a_vertices.resize(3 * count), b_vertices.resize(3 * count), ids.resize(count), patch_ids.resize(count);
    a_weights.resize(3 * count), b_weights.resize(3 * count), normals.resize(3 * count), gaps.resize(count);
    copy_points(report, {bodies, contacts, kinds, a_vertices, b_vertices, a_weights, b_weights, normals, gaps, ids,
                         patch_ids, minima});
  }
  std::vector<std::uint32_t> bodies;
  std::vector<int> contacts, a_vertices, b_vertices;
  std::vector<std::uint8_t> kinds, minima;
  std::vector<double> a_weights, b_weights, normals, gaps;
  std::vector<std::uint64_t> ids, patch_ids;
};

void play(const char* file, int threads, double margin) {
  const auto now_ms = [&] {
    if (threads == 1) return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  Reader reader(file);
  tact::World world({.threads = threads, .outputs = {.points = margin > 0.0}});
  std::vector<tact::BodyId> bodies;
  for (std::int64_t left = reader.number(); left > 0; --left) {
    const Eigen::Matrix3Xd positions = reader.columns<double>();
    const Eigen::Matrix3Xi facets = reader.columns<int>();
    bodies.push_back(world.add_body({.positions = positions, .facets = facets, .margin = margin}));
  }
  std::vector<std::vector<Eigen::Matrix3Xd>> frames(static_cast<std::size_t>(reader.number()));
  for (std::vector<Eigen::Matrix3Xd>& frame : frames) {
    for (std::size_t i = 0; i < bodies.size(); ++i) frame.push_back(reader.columns<double>());
  }
  std::vector<double> times;
  Points points;
  for (const std::vector<Eigen::Matrix3Xd>& frame : frames) {
    const double start = now_ms();
    std::vector<tact::PositionsUpdate> updates;
    for (std::size_t i = 0; i < bodies.size(); ++i) updates.push_back({bodies[i], frame[i]});
    world.set_positions(updates);
    const tact::Report& report = world.detect();
    if (margin > 0.0) points.read(report);
    times.push_back(now_ms() - start);
    std::printf("%llu\n", static_cast<unsigned long long>(report.hash()));
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  std::printf("%.6f\n", *middle);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3 && count != 4) return 2;
  try {
    play(words[1], std::atoi(words[2]), count == 4 ? std::strtod(words[3], nullptr) : 0.0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
