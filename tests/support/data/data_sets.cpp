#include "tests/support/data/data_sets.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "scenes/files/mesh_file.h"

namespace tact::tests {

std::string data_folder() { return TACT_DATA_DIR; }

bool data_present() { return std::filesystem::is_directory(data_folder()); }

Mesh read_data(const std::string& name) {
  scenes::MeshFile file = scenes::read_mesh_file(std::filesystem::path(data_folder()) / name);
  return {std::move(file.positions), std::move(file.facets)};
}

Sequence read_data_sequence(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(data_folder()) / folder)) {
    if (scenes::mesh_format(entry.path())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  Sequence sequence;
  for (const std::filesystem::path& path : paths) {
    scenes::MeshFile file = scenes::read_mesh_file(path);
    if (sequence.frames.empty()) sequence.facets = std::move(file.facets);
    sequence.frames.push_back(std::move(file.positions));
  }
  return sequence;
}

}  // namespace tact::tests
