#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

#include "scenes/export/vtk.h"
#include "scenes/files/file_error.h"
#include "tests/scenes/picture_bodies.h"
#include "tests/support/environment/temporary_folder.h"

using namespace tact::scenes;
using tact::tests::TemporaryFolder;
using tact::tests::two_cubes;

namespace {

// The values of the named array of a .vtp file with appended raw data.
template <class T>
std::vector<T> array_of(const std::string& bytes, const std::string& name) {
  const std::size_t element = bytes.find("Name=\"" + name + "\"");
  const std::size_t offset_at = bytes.find("offset=\"", element) + 8;
  const std::size_t data = bytes.find("encoding=\"raw\">\n_") + 17 + std::stoul(bytes.substr(offset_at));
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data() + data, 8);
  EXPECT_LE(data + 8 + size, bytes.size()) << name;
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), bytes.data() + data + 8, size);
  return values;
}

}  // namespace

TEST(Vtk, ArraysReadBack) {
  const TemporaryFolder folder;
  PictureScene scene = two_cubes();
  scene.bodies[1].positions(0, 0) = 0.1 + 0.2;
  scene.bodies[1].meeting_facets = {0, 11};
  VtkSeries series(folder.path() / "out", "run");
  series.write(scene.bodies, 0.0);
  const std::string bytes = tact::tests::contents(folder.path() / "out" / "run_00000.vtp");
  EXPECT_NE(bytes.find("NumberOfPoints=\"16\""), std::string::npos);
  EXPECT_NE(bytes.find("NumberOfPolys=\"24\""), std::string::npos);
  const auto points = array_of<double>(bytes, "Points");
  ASSERT_EQ(points.size(), 48u);
  EXPECT_EQ(points[24], 0.1 + 0.2);
  const auto connectivity = array_of<std::int64_t>(bytes, "connectivity");
  ASSERT_EQ(connectivity.size(), 72u);
  EXPECT_EQ(connectivity[36], 8 + scene.bodies[1].facets(0, 0));
  EXPECT_EQ(array_of<std::int64_t>(bytes, "offsets").back(), 72);
  const auto body = array_of<std::int32_t>(bytes.substr(bytes.find("<CellData")), "body");
  const auto crossing = array_of<std::uint8_t>(bytes, "tact_crossing");
  const auto facet = array_of<std::int32_t>(bytes, "facet");
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(body[i], i < 12 ? 0 : 1);
    EXPECT_EQ(facet[i], static_cast<int>(i % 12));
    EXPECT_EQ(crossing[i], i == 12 || i == 23 ? 1 : 0) << i;
  }
}

TEST(Vtk, TheIndexNamesAllFramesAfterEach) {
  const TemporaryFolder folder;
  VtkSeries series(folder.path(), "a&b");
  for (int frame = 0; frame < 3; ++frame) {
    series.write(two_cubes().bodies, 0.1 * frame);
    const std::string index = tact::tests::contents(series.index_file());
    EXPECT_NE(index.find("file=\"a&amp;b_0000" + std::to_string(frame) + ".vtp\""), std::string::npos) << index;
    EXPECT_NE(index.find("</VTKFile>"), std::string::npos);
  }
  EXPECT_NE(tact::tests::contents(series.index_file()).find("timestep=\"0.2\""), std::string::npos);
}

TEST(Vtk, FoldersThatCannotBeMadeAreErrors) {
  const TemporaryFolder folder;
  const auto file = folder.write("file", "x");
  EXPECT_THROW(VtkSeries(file / "below", "run"), FileError);
}
