#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/files/mesh_file.h"
#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

struct KnownFile {
  const char* name;
  int vertices;
  int facets;
};

// As ../shared/data/SOURCES.md has them.
constexpr KnownFile kKnownFiles[] = {
    {"spot.ply", 2930, 5856},
    {"fish.obj", 945, 1886},
    {"dress.ply", 4072, 8106},
    {"dense_sheet.obj", 6273, 12288},
    {"cloth80x80.obj", 6400, 12482},
    {"cloth_sphere.obj", 162, 320},
    {"messy/cycloidal.ply", 21384, 43368},
    {"messy/openscad-nonmanifold-crash.obj", 717, 1442},
    {"messy/l_tibia_SOMEINVERTEDFACES.obj", 186, 390},
    {"messy/triple_vierbein.obj", 75, 108},
    {"small_answers/two-cubes-far.ply", 244, 480},
    {"small_answers/two-cubes-close.ply", 244, 480},
    {"small_answers/two-cubes-intersecting.ply", 244, 480},
    {"small_answers/two-layer-ball.ply", 1284, 2560},
    {"small_answers/thick-cloth-t0.ply", 233, 404},
    {"small_answers/thick-cloth-t1.ply", 233, 404},
};

void expect_size(const std::filesystem::path& file, int vertices, int facets) {
  const MeshFile mesh = read_mesh_file(file);
  EXPECT_EQ(mesh.positions.cols(), vertices) << file;
  EXPECT_EQ(mesh.facets.cols(), facets) << file;
}

TEST(MeshFile, ReadsTheKnownFiles) {
  const std::filesystem::path data = TACT_DATA_DIR;
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no folder " << data << ": the known files are not read";
  for (const KnownFile& known : kKnownFiles) expect_size(data / known.name, known.vertices, known.facets);
  for (const auto& entry : std::filesystem::directory_iterator(data / "seq_cloth_on_sphere"))
    expect_size(entry.path(), 289, 512);
  for (const auto& entry : std::filesystem::directory_iterator(data / "seq_toy_poses"))
    expect_size(entry.path(), 6669, 13334);
}

TEST(MeshFile, TheEndingTellsTheFormat) {
  EXPECT_EQ(mesh_format("a.b/c.obj"), MeshFormat::obj);
  EXPECT_EQ(mesh_format("C.OFF"), MeshFormat::off);
  EXPECT_EQ(mesh_format("x.Ply"), MeshFormat::ply);
  EXPECT_EQ(mesh_format("x.y.StL"), MeshFormat::stl);
  for (const char* name : {"obj", ".obj", "a.objx", "a.obj/b", "a.obj~", ""}) EXPECT_FALSE(mesh_format(name)) << name;
}

std::string refusal_of_file(const std::filesystem::path& file) {
  try {
    read_mesh_file(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshFile, RefusesWhatIsNoMeshFile) {
  const tests::TemporaryFolder folder;
  const std::string here = folder.path().string();
  EXPECT_EQ(refusal_of_file(here + "/none.obj"), here + "/none.obj: no such file or folder");
  EXPECT_EQ(refusal_of_file(here), here + ": a folder, not a file");
  EXPECT_EQ(refusal_of_file(folder.write("e.obj", "")), here + "/e.obj: the file is empty");
  EXPECT_EQ(refusal_of_file(folder.write("mesh.txt", "v 0 0 0")),
            here + "/mesh.txt: not a mesh file: its name ends in none of .obj, .off, .ply, .stl, .vtp, .vtk");
}

}  // namespace
}  // namespace tact::scenes
