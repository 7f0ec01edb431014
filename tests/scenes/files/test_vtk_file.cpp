#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "scenes/files/body_files.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/pvd_file.h"
#include "tests/scenes/mesh_bytes.h"
#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

using tests::Corners;
using tests::Point;

std::string vtp_refusal(std::string_view bytes) { return tests::refusal(MeshFormat::vtp, bytes); }
std::string vtk_refusal(std::string_view bytes) { return tests::refusal(MeshFormat::vtk, bytes); }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

const std::string kVtp =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\">\n"
    "<PolyData><Piece NumberOfPoints=\"4\" NumberOfStrips=\"1\" NumberOfPolys=\"1\">\n"
    "<PointData><DataArray type=\"Int32\" Name=\"body\" format=\"ascii\">0 0 0 0</DataArray></PointData>\n"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
    "0 0 0 0.1 0 0 0 1e-310 0 0 0 -1</DataArray></Points>\n"
    "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>\n"
    "<Strips><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray></Strips>\n"
    "</Piece></PolyData></VTKFile>\n";

const std::string kVtk =
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0 0.1 0 0\n0 1e-310 0 0 0 -1\n"
    "POLYGONS 2 8\n3 0 1 2\n3 1 0 3\n";

}  // namespace

// As VTK 9.1 writes one tetrahedron in each of its ways, see tests/fuzz/corpus.
TEST(VtkFile, EveryWayInWhichVtkWritesIsTheSameMesh) {
  int files = 0;
  for (const char* format : {"vtp", "vtk"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(TACT_SOURCE_DIR "/tests/fuzz/corpus/" + std::string(format))) {
      const MeshFile mesh = read_mesh_file(entry.path());
      EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0, 0, 0}, {0.1, 0, 0}, {0, 0.25, 0}, {0, 0, 1}}))
          << entry.path();
      EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}))
          << entry.path();
      ++files;
    }
  }
  EXPECT_GE(files, 15);
}

TEST(VtkFile, ReadsPolygonsStripsAndBodies) {
  const MeshFile mesh = parse_vtp(kVtp, "m");
  EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0, 0, 0}, {0.1, 0, 0}, {0, 1e-310, 0}, {0, 0, -1}}));
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(mesh.body_of_vertex, (std::vector<int>{0, 0, 0, 0}));
  EXPECT_EQ(tests::facets_of(parse_vtk(kVtk, "m")), (std::vector<Corners>{{0, 1, 2}, {1, 0, 3}}));
}

TEST(VtkFile, BrokenFilesAreRefusedWithTheirPlace) {
  EXPECT_EQ(vtp_refusal(replaced(kVtp, "PolyData", "Image")), "m:2: 'Image': only files of PolyData are read");
  EXPECT_EQ(vtp_refusal(replaced(kVtp, "0.1 0 0", "0,1 0 0")), "m:5: number 3: expected a number, found '0,1'");
  EXPECT_EQ(vtp_refusal(replaced(kVtp, "1e-310", "nan")), "m:5: vertex 2: y is nan, not a finite number");
  EXPECT_EQ(vtp_refusal(replaced(kVtp, "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\"")),
            "m:5: the array has 12 coordinates, and the piece says 15");
  EXPECT_EQ(vtp_refusal(replaced(kVtp, "\"ascii\">0 1 2<", "\"ascii\">0 1 4<")),
            "m:7: facet 0: names vertex 4, counted from 0, but the file has 4 vertices");
  EXPECT_EQ(vtp_refusal(kVtp.substr(0, 300)), "m:5: a tag without its end, >");
  EXPECT_EQ(vtk_refusal(replaced(kVtk, "3 1 0 3", "3 1 0 4")),
            "m:10: facet 1: names vertex 4, counted from 0, but the file has 4 vertices");
  EXPECT_EQ(vtk_refusal(replaced(kVtk, "3 1 0 3", "9 1 0 3")), "m:8: cell 1: its corners go beyond the 8 numbers");
  EXPECT_EQ(vtk_refusal(replaced(kVtk, "POLYDATA", "STRUCTURED_GRID")),
            "m:4: 'STRUCTURED_GRID': only POLYDATA and UNSTRUCTURED_GRID are read");
}

TEST(VtkFile, ACollectionGivesItsPartsAndTheirBodies) {
  const tests::TemporaryFolder folder;
  folder.write("in/a_0.vtp", kVtp);
  const std::string moved = replaced(kVtp, "0 0 0 0.1", "0 0 9 0.1");
  folder.write("in/a_1.vtp", moved);
  folder.write("in/b.vtk", kVtk);
  const auto series = folder.write(
      "in.pvd",
      "<VTKFile type=\"Collection\"><Collection>\n<DataSet timestep=\"0.5\" part=\"0\" file=\"in/a_1.vtp\"/>\n"
      "<DataSet timestep=\"0.25\" part=\"0\" file=\"in/a_0.vtp\"/><DataSet timestep=\"0.25\" part=\"1\" "
      "file=\"in/b.vtk\"/>"
      "<DataSet timestep=\"0.5\" part=\"1\" file=\"in/b.vtk\"/></Collection></VTKFile>");
  const auto bodies = read_bodies({series});
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[1].name, "in.pvd#2");
  EXPECT_EQ(bodies[1].short_name, "in#2");
  EXPECT_EQ(times_of(bodies), (std::vector<double>{0.25, 0.5}));
  ASSERT_EQ(bodies[0].positions.size(), 2u);
  EXPECT_EQ(bodies[0].positions[0](2, 0), 0.0);
  EXPECT_EQ(bodies[0].positions[1](2, 0), 9.0);
}

TEST(VtkFile, BrokenCollectionsAreRefusedWithTheirPlace) {
  const auto refused = [](const std::string& entries) -> std::string {
    try {
      parse_pvd("<VTKFile type=\"Collection\">\n" + entries + "</VTKFile>", "c.pvd");
    } catch (const FileError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refused(""), "c.pvd:2: the collection names no file");
  EXPECT_EQ(refused("<DataSet timestep=\"1\"/>"), "c.pvd:2: <DataSet> has no attribute file");
  EXPECT_EQ(refused("<DataSet timestep=\"x\" file=\"a.vtp\"/>"), "c.pvd:2: the timestep is 'x', not a number");
  EXPECT_EQ(refused("<DataSet file=\"a\nb.vtp\"/>"), "c.pvd:2: 'a\\x0ab.vtp' is no name of a file");
  EXPECT_EQ(refused("<DataSet part=\"0\" file=\"a.vtp\"/><DataSet part=\"1\" timestep=\"1\" file=\"b.vtp\"/>"),
            "c.pvd:2: part '1' has other times than part '0'");
}

TEST(VtkFile, AFileThatTellsOfBodiesIsThoseBodies) {
  const tests::TemporaryFolder folder;
  const std::string two = replaced(kVtp, "0 0 0 0<", "7 2 7 7<");
  EXPECT_EQ(tests::facets_of(parse_vtp(two, "m")).size(), 3u);
  const auto file = folder.write("two.vtp", two);
  try {
    read_bodies({file});
    ADD_FAILURE() << "a facet joins two bodies";
  } catch (const FileError& error) {
    EXPECT_EQ(error.what(), file.string() + ": facet 0 joins vertices of two bodies");
  }
}

}  // namespace tact::scenes
