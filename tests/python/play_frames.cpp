// Plays the frames in a file that frames.py has written: the C++ side of what Python is held against.
//
//   play_frames FILE THREADS      prints the hash of each step, then the median milliseconds of a step
#include <tact/tact.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
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

void play(const char* file, int threads) {
  using Clock = std::chrono::steady_clock;
  Reader reader(file);
  tact::World world(tact::Settings{.threads = threads});
  std::vector<tact::BodyId> bodies;
  for (std::int64_t left = reader.number(); left > 0; --left) {
    const Eigen::Matrix3Xd positions = reader.columns<double>();
    bodies.push_back(world.add_body({.positions = positions, .facets = reader.columns<int>()}));
  }
  std::vector<std::vector<Eigen::Matrix3Xd>> frames(static_cast<std::size_t>(reader.number()));
  for (std::vector<Eigen::Matrix3Xd>& frame : frames) {
    for (std::size_t i = 0; i < bodies.size(); ++i) frame.push_back(reader.columns<double>());
  }
  std::vector<double> times;
  for (const std::vector<Eigen::Matrix3Xd>& frame : frames) {
    const Clock::time_point start = Clock::now();
    std::vector<tact::PositionsUpdate> updates;
    for (std::size_t i = 0; i < bodies.size(); ++i) updates.push_back({bodies[i], frame[i]});
    world.set_positions(updates);
    const tact::Report& report = world.detect();
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    std::printf("%llu\n", static_cast<unsigned long long>(report.hash()));
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  std::printf("%.6f\n", *middle);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 2;
  try {
    play(words[1], std::atoi(words[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
