// Any bytes are a mesh that keeps the readers' promises, or are refused in one line that names the file.
#include <tact/body.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "scenes/files/mesh_file.h"

namespace {

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

void check_mesh(const tact::scenes::MeshFile& mesh) {
  for (Eigen::Index i = 0; i < mesh.positions.size(); ++i) {
    require(std::abs(mesh.positions.data()[i]) <= tact::kLargestCoordinate, "a coordinate is finite and not too large");
  }
  for (Eigen::Index i = 0; i < mesh.facets.size(); ++i) {
    const int corner = mesh.facets.data()[i];
    require(corner >= 0 && corner < mesh.positions.cols(), "a corner is a vertex");
  }
}

void check_message(const std::string& message) {
  require(message.starts_with("fuzzed:"), "a message names the file");
  require(message.size() < 400, "a message is short");
  require(std::all_of(message.begin(), message.end(), [](char c) { return c >= 0x20 && c <= 0x7e; }),
          "a message is one printable line");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    check_mesh(tact::scenes::parse_mesh(tact::scenes::MeshFormat::TACT_FUZZ_FORMAT, bytes, "fuzzed"));
  } catch (const tact::scenes::FileError& error) {
    check_message(error.what());
  }
  return 0;
}
