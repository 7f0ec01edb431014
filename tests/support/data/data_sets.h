// The meshes of ../shared/data, which is not part of the repository: tests that read it skip themselves where it is
// missing.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/mesh.h"

// Leaves a test, skipped, with a line that says why.
#define TACT_SKIP_WITHOUT_DATA() \
  if (!::tact::tests::data_present()) GTEST_SKIP() << "no folder of test data at " << ::tact::tests::data_folder()

namespace tact::tests {

std::string data_folder();
bool data_present();

// The mesh of a file such as "messy/cycloidal.ply". Errors: scenes::FileError.
Mesh read_data(const std::string& name);

// The positions of every mesh file in a folder, in the order of their names, and the facets of the first.
struct Sequence {
  Eigen::Matrix3Xi facets;
  std::vector<Eigen::Matrix3Xd> frames;
};
Sequence read_data_sequence(const std::string& folder);

}  // namespace tact::tests
