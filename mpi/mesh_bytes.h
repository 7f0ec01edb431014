// A change of a body's facets as bytes, and back.
#pragma once

#include <tact/world.h>

#include <vector>

#include "mpi/bytes.h"

namespace tact::mpi {

Bytes bytes_of(const MeshUpdate& update);

/// A change of facets that holds what it names. Errors: bad_state.
class MeshOfBytes {
 public:
  explicit MeshOfBytes(std::span<const std::byte> bytes);
  MeshUpdate update() const;

 private:
  std::vector<double> positions_;
  std::vector<int> facets_, edges_, points_, vertex_map_, facet_map_;
};

}  // namespace tact::mpi
