// Two sheets on two ranks that cross: both ranks have the contact, and one counts it.
#include <mpi.h>
#include <tact/mpi/world.h>

#include <array>
#include <cstdio>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int counted = 0, found = 0;
  {
    tact::mpi::World world(MPI_COMM_WORLD);
    const double x = world.rank() == 0 ? 0.0 : 0.25;
    const std::array<double, 9> flat{0, 0, 0, 1, 0, 0, 0, 1, 0}, upright{x, 0.1, -1, x, 0.1, 1, x, 1, 0};
    const std::array<int, 3> facet{0, 1, 2};
    const auto& corners = world.rank() == 0 ? flat : upright;
    world.add_body({.positions = tact::Positions::strided(corners.data(), 3),
                    .facets = tact::Facets::strided(facet.data(), 1),
                    .surface = tact::Surface::sheet,
                    .key = static_cast<std::uint64_t>(world.rank())});
    for (const tact::mpi::Contact& contact : world.detect().contacts()) {
      ++found;
      counted += contact.bodies.counted ? 1 : 0;
    }
    MPI_Allreduce(MPI_IN_PLACE, &counted, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    std::printf("rank %d: %d contact, counted %d time(s)\n", world.rank(), found, counted);
  }
  MPI_Finalize();
  return found == 1 && counted == 1 ? 0 : 1;
}
