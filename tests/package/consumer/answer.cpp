// Prints the hash of each step's report: bodies of uneven boxes that pass through each other. Their positions are sums
// of small multiples of 1/1024, the same doubles however this file is compiled. Fails if its recording does not play
// again, a box whose facets have corners of their own is not welded, or C colours stencils otherwise than C++.
#include <tact/recording.h>
#include <tact/solver.h>
#include <tact/tact.h>
#include <tact/tact_c_solver.h>
#include <tact/weld.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <sstream>
#include <vector>

namespace {

constexpr int kBodies = 40;

int scrambled(int i) { return static_cast<int>(static_cast<unsigned>(i) * 2654435761u >> 22); }  // 0 to 1023

Eigen::Matrix3Xd box_at_step(int body, int step) {
  Eigen::Matrix3Xd positions(3, 8);
  for (int vertex = 0; vertex < 8; ++vertex) {
    for (int axis = 0; axis < 3; ++axis) {
      const int key = 24 * body + 3 * vertex + axis;
      const int corner = vertex >> axis & 1 ? 1024 : -1024;
      const int place = 4 * scrambled(3 * body + axis + 5000);
      const int motion = step * (scrambled(3 * body + axis + 9000) - 512) / 4;
      positions(axis, vertex) = (corner + place + motion + scrambled(key) / 2) / 1024.0;
    }
  }
  return positions;
}

// Whether each step of a recording has its hash again.
bool plays(const std::ostringstream& recording) {
  tact::RecordingPlayer player(recording.str());
  int steps = 0;
  for (; const auto step = player.next(); ++steps) {
    if (!step->same()) return false;
  }
  return steps == 10;
}

// Whether a box whose facets have corners of their own has eight again.
bool welds(const Eigen::Matrix3Xd& box, const Eigen::Matrix3Xi& facets) {
  Eigen::Matrix3Xd corners(3, facets.size());
  Eigen::Matrix3Xi own(3, facets.cols());
  for (int i = 0; i < facets.size(); ++i) {
    corners.col(i) = box.col(facets(i % 3, i / 3));
    own(i % 3, i / 3) = i;
  }
  tact::WeldedMesh mesh = tact::weld(corners, own);
  mesh.positions.conservativeResize(3, mesh.positions.cols() + 1);  // by this program's Eigen
  return mesh.positions.cols() == 9 && mesh.facets.maxCoeff() == 7 && mesh.merged_vertices == 28;
}

// Whether a chain of stencils has the same colours in C and in C++.
bool colors() {
  std::vector<tact::solver::Stencil> chain(64);
  std::vector<tact_stencil> chain_in_c(chain.size());
  for (int i = 0; i < 64; ++i) {
    chain[i] = {.vertices = {i, i + 1, -1, -1}, .weights = {-1.0, 1.0, 0.0, 0.0}, .normal = {0.0, 0.0, 1.0}};
    std::ranges::copy(chain[i].vertices, chain_in_c[i].vertices);  // of two points, as zero says
  }
  std::vector<int> expected(chain.size()), found(chain.size());
  const tact::solver::Coloring coloring = tact::solver::color(chain, 65);
  for (int color = 0; color < coloring.count(); ++color) {
    for (const int stencil : coloring.of(color)) expected[stencil] = color;
  }
  return tact_stencil_colors(chain_in_c.data(), chain_in_c.size(), 65, found.data()) == TACT_OK && found == expected;
}

}  // namespace

int main() {
  Eigen::Matrix3Xi facets(3, 12);
  facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,        //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  if (!welds(box_at_step(0, 0), facets) || !colors()) return 1;
  std::ostringstream recording;
  tact::Recorder recorder(recording);
  tact::World world({.threads = 2, .outputs = {.zones = true, .patches = true}});
  world.set_observer(&recorder);
  std::vector<tact::BodyId> bodies;
  for (int body = 0; body < kBodies; ++body) {
    bodies.push_back(world.add_body({.positions = box_at_step(body, 0), .facets = facets}));
  }
  const tact::SurfaceCheck surface = world.check_surface(bodies[0]);
  if (!surface.is_solid() || !surface.is_clean()) return 1;
  for (int step = 1; step <= 10; ++step) {
    for (int body = 0; body < kBodies; ++body) world.set_positions(bodies[body], box_at_step(body, step));
    const tact::Report& report = world.detect();
    std::printf("step %d: %016" PRIx64 ", %zu contacts, %" PRId64 " facet pairs\n", step, report.hash(),
                report.contacts().size(), report.stats().facet_pairs);
    if (report.stats().facet_pairs == 0) return 1;
  }
  return plays(recording) ? 0 : 1;
}
