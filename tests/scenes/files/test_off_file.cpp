#include <gtest/gtest.h>

#include "tests/scenes/mesh_bytes.h"

namespace tact::scenes {
namespace {

using tests::Corners;
using tests::Point;

std::string off_refusal(std::string_view bytes) { return tests::refusal(MeshFormat::off, bytes); }

const std::string kOffVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(OffFile, ReadsVerticesAndFans) {
  const MeshFile mesh = parse_off("OFF\n# a comment\n\n4 2 0 # counts\n" + kOffVertices + "4 0 1 2 3\n3 2 1 0\n", "m");
  EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}, {2, 1, 0}}));
}

TEST(OffFile, ReadsEveryHeader) {
  const std::vector<Corners> one{{0, 1, 2}};
  for (const char* head :
       {"OFF\n4 1 0\n", "OFF 4 1 0\n", "OFF4 1 0\n", "4 1 0\n", "4 1\n", "COFF\n4 1 0\n", "STCNOFF\n4 1 0\n"}) {
    EXPECT_EQ(tests::facets_of(parse_off(head + kOffVertices + "3 0 1 2\n", "m")), one) << head;
  }
}

TEST(OffFile, SkipsNormalsAndColours) {
  const MeshFile mesh = parse_off("NOFF\n3 1 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 nan 0 1\n3 0 1 2 255 0 0\n", "m");
  EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}}));
}

// Where lines do not hold a vertex or a polygon each, numbers may stand on any lines.
TEST(OffFile, ReadsFreeLines) {
  const std::vector<Corners> quad{{0, 1, 2}, {0, 2, 3}};
  for (const char* bytes : {"OFF\n4 1 0\n0 0 0 1 0 0 1 1 0 0 1 0\n4 0 1 2 3\n",
                            "OFF\n4 1 0\n0 0\n0\n1 0 0\n1 1\n0 0 1 0\n4 0 1\n2 3 255 0 0\n",
                            "OFF 4 1 0\n0\n0\n0\n1\n0\n0\n1\n1\n0\n0\n1\n0\n4\n0\n1\n2\n3\n",
                            "NOFF\n4 1 0\n0 0 0\n0 0 1\n1 0 0\n0 0 1\n1 1 0 0 0 1 0 1 0 0 0 1\n4 0 1 2 3 # c\n",
                            "STOFF\n4 1 0\n0 0 0\n.5 .5\n1 0 0\n1 0\n1 1 0\n0 1\n0 1 0\n1 1\n4 0 1 2 3\n"}) {
    const MeshFile mesh = parse_off(bytes, "m");
    EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})) << bytes;
    EXPECT_EQ(tests::facets_of(mesh), quad) << bytes;
  }
}

// A number too few would shift all others: it is refused, even where the rest could be read as a mesh.
TEST(OffFile, FreeLinesMissNoNumber) {
  EXPECT_EQ(off_refusal("OFF\n5 2 0\n0 0\n1 0 0\n1 1 0\n0 1 0\n2 1 0\n4 3 0 1 2\n4 0 1 2 3\n"),
            "m:3: vertex 0: expected a number for z, found the end of the line");
  EXPECT_EQ(off_refusal("COFF\n3 1 0\n0 0 0 1 1 1 1 1 0 0 1 1 1 1 0 1 0 1 1 1 1\n3 0 1 2\n"),
            "m:5: vertex 2: expected a number for x, found the end of the file");
  EXPECT_EQ(off_refusal("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0 3 0 1 2\n"),
            "m:4: vertex 1: expected a number for x, found the end of the file");
}

TEST(OffFile, ANothingIsAMesh) { EXPECT_EQ(parse_off("OFF\n0 0 0\n", "m").facets.cols(), 0); }

TEST(OffFile, RefusesNamingTheLine) {
  const std::string head = "OFF\n4 1 0\n" + kOffVertices;
  EXPECT_EQ(off_refusal("# nothing\n"), "m:2: expected OFF, found the end of the file");
  EXPECT_EQ(off_refusal("solid x\n"), "m: not an OFF file but an STL file");
  EXPECT_EQ(off_refusal("mesh x\n"), "m:1: expected OFF, or the number of vertices, found 'mesh'");
  EXPECT_EQ(off_refusal("XOFF\n"), "m:1: expected OFF, or the numbers of vertices and polygons, found 'XOFF'");
  EXPECT_EQ(off_refusal("4OFF\n1 0 0\n0 0 0 1\n"), "m:1: '4OFF': only three coordinates are read");
  EXPECT_EQ(off_refusal("OFF BINARY\n"), "m:1: binary OFF is not read");
  EXPECT_EQ(off_refusal("OFF\n4\n"), "m:2: expected the number of polygons, found the end of the line");
  EXPECT_EQ(off_refusal("OFF\n-4 1 0\n"), "m:2: the number of vertices is -4, not 0 to 2147483647");
  EXPECT_EQ(off_refusal("OFF\n4294967296 1 0\n0 0 0\n"),
            "m:2: the number of vertices is 4294967296, not 0 to 2147483647");
  EXPECT_EQ(off_refusal("OFF\n2000000000 1 0\n0 0 0\n"),
            "m:4: vertex 1: expected a number for x, found the end of the file");
  EXPECT_EQ(off_refusal("OFF\n4 1 0\n0 0 0\n1 0\n"),
            "m:4: vertex 1: expected a number for z, found the end of the line");
  EXPECT_EQ(off_refusal("OFF\n4 1 0\n0 0 0\n1 inf 0\n"), "m:4: vertex 1: y is inf, not a finite number");
  EXPECT_EQ(off_refusal(head + "3 0 1 4\n"),
            "m:7: facet 0: names vertex 4, counted from 0, but the file has 4 vertices");
  EXPECT_EQ(off_refusal(head + "3 0 1 -1\n"),
            "m:7: facet 0: names vertex -1, counted from 0, but the file has 4 vertices");
  EXPECT_EQ(off_refusal(head + "3 0 1\n"), "m:7: facet 0: expected the index of a vertex, found the end of the line");
  EXPECT_EQ(off_refusal(head + "2 0 1\n"), "m:7: facet 0: has 2 of the 3 corners that a polygon needs");
  EXPECT_EQ(off_refusal(head + "4000000000 0 1 2\n"),
            "m:7: facet 0: expected the index of a vertex, found the end of the line");
  EXPECT_EQ(off_refusal(head + "3 0 1 2 red\n"), "m:7: facet 0: expected a number or the end of the line, found 'red'");
  EXPECT_EQ(off_refusal(head), "m:7: facet 0: expected the number of corners, found the end of the file");
  EXPECT_EQ(off_refusal(head + "3 0 1 2\n3 0 1 2\n"),
            "m:8: expected the end of the file after the 1 polygon, found '3'");
}

}  // namespace
}  // namespace tact::scenes
