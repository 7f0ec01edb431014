#include "mpi/mesh_bytes.h"

#include "engine/bodies/columns.h"

namespace tact::mpi {

namespace {

template <class Scalar, int kRows>
void put(ByteWriter& to, const Columns<Scalar, kRows>& columns) {
  if (columns.rows() != kRows) return;  // the world will refuse it, by name
  to.put(static_cast<std::uint64_t>(columns.cols() * kRows));
  for (std::ptrdiff_t i = 0; i < columns.cols(); ++i) {
    for (const Scalar number : columns.column(i)) to.put(number);
  }
}

}  // namespace

Bytes bytes_of(const MeshUpdate& update) {
  ByteWriter writer;
  put(writer, update.positions);
  put(writer, update.facets);
  put(writer, update.edges);
  for (const std::span<const int> numbers : {update.points, update.vertex_map, update.facet_map})
    writer.put_all(numbers);
  return std::move(writer.bytes());
}

MeshOfBytes::MeshOfBytes(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  positions_ = reader.get_all<double>();
  for (std::vector<int>* const numbers : {&facets_, &edges_, &points_, &vertex_map_, &facet_map_})
    *numbers = reader.get_all<int>();
}

MeshUpdate MeshOfBytes::update() const {
  return {.positions = columns_of<Positions>(positions_),
          .facets = columns_of<Facets>(facets_),
          .edges = columns_of<Edges>(edges_),
          .points = points_,
          .vertex_map = vertex_map_,
          .facet_map = facet_map_};
}

}  // namespace tact::mpi
