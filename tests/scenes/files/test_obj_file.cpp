#include <gtest/gtest.h>

#include "tests/scenes/mesh_bytes.h"

namespace tact::scenes {
namespace {

using tests::Corners;
using tests::Point;

std::string obj_refusal(std::string_view bytes) { return tests::refusal(MeshFormat::obj, bytes); }

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjFile, ReadsVerticesAndFacets) {
  const MeshFile mesh = parse_obj(
      "# a comment\nmtllib x.mtl\no thing\nv 0.1 1e-310 -0\nv 1 0 0 1.0\nv 0 1 0 0.5 0.5 0.5\n"
      "vt 0 0\nvn 0 0 1\ng part#1\nusemtl m\ns off\nl 1 2\np 1\nf 1 2 3 # last\n",
      "m");
  EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0.1, 1e-310, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_TRUE(std::signbit(mesh.positions(2, 0)));
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}}));
}

TEST(ObjFile, SplitsPolygonsIntoFansInTheOrderOfTheFile) {
  const MeshFile mesh = parse_obj(kThree + "v -1 1 0\nv -1 0 0\nf 2 3 4 5 1\nf 1 2 3\n", "m");
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{1, 2, 3}, {1, 3, 4}, {1, 4, 0}, {0, 1, 2}}));
}

TEST(ObjFile, TakesEveryFormOfACorner) {
  const std::vector<Corners> one{{0, 1, 2}};
  for (const char* facet :
       {"f 1 2 3", "f 1/1 2/2 3/3", "f 1/1/1 2/2/2 3/3/3", "f 1//1 2//2 3//3", "f 1/ 2/ 3/", "f -3 -2 -1",
        "f -3/-3 -2//-1 -1/-1/-1", "f 1 2 \\\n3", "f 1 2\\\r\n 3", "fo 1 2 3", "f\t1\t2\t3  "}) {
    EXPECT_EQ(tests::facets_of(parse_obj(kThree + facet, "m")), one) << facet;
  }
}

TEST(ObjFile, NegativeIndicesCountFromTheVerticesAbove) {
  const MeshFile mesh = parse_obj(kThree + "f -3 -2 -1\nv 5 5 5\nf -3 -2 -1\n", "m");
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {1, 2, 3}}));
}

TEST(ObjFile, FacetsMayComeBeforeTheirVertices) {
  EXPECT_EQ(tests::facets_of(parse_obj("f 1 2 3\n" + kThree, "m")), (std::vector<Corners>{{0, 1, 2}}));
  EXPECT_EQ(obj_refusal("v 0 0 0\nf 1 2 3\nf 1 2 4\nv 1 1 1\nv 2 2 2\n"),
            "m:3: facet 1: names vertex 4, counted from 1, but the file has 3 vertices");
}

TEST(ObjFile, ReadsEveryKindOfLineEnd) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const std::string e = end;
    EXPECT_EQ(tests::facets_of(parse_obj("v 0 0 0" + e + "v 1 0 0" + e + "v 0 1 0" + e + "f 1 2 3" + e, "m")),
              (std::vector<Corners>{{0, 1, 2}}));
  }
}

// What others write and has one meaning.
TEST(ObjFile, TakesCommentsThatTouchNumbersPathsOfWindowsAndExponentsOfFortran) {
  const std::vector<Corners> one{{0, 1, 2}};
  EXPECT_EQ(tests::facets_of(parse_obj("v 0 0 0# c\nv 1 0 0 #c\nv 0 1 0\nf 1 2 3# c\n", "m")), one);
  EXPECT_EQ(tests::facets_of(parse_obj("mtllib C:\\models\\\n" + kThree + "usemtl a\\\nf 1 2 3\n", "m")), one);
  const MeshFile mesh = parse_obj("v 0.5D+00 1D1 -2d0\nv 1 0 \\\r\n0\nv 0 1 0\nf 1 \\\n 2 3\n", "m");
  EXPECT_EQ(tests::positions_of(mesh)[0], (Point{0.5, 10, -2}));
}

TEST(ObjFile, LeavesFacesWithoutCornersOutWithAWarning) {
  const MeshFile mesh = parse_obj(kThree + "f 1 2 3\nf\nf # none\nf\nf\nf\nf 3 2 1\n", "m");
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(mesh.warnings,
            (std::vector<std::string>{
                "m:5: facet 1: a face without corners is left out", "m:6: facet 1: a face without corners is left out",
                "m:7: facet 1: a face without corners is left out", "m: 2 more warnings like these"}));
}

TEST(ObjFile, RefusesNamingTheLine) {
  EXPECT_EQ(obj_refusal(""), "m: the file is empty");
  EXPECT_EQ(obj_refusal("hello\nworld\n"), "m:3: the file ends without a vertex");
  EXPECT_EQ(obj_refusal("v 0 0 0\nv 1 0\n"), "m:2: vertex 1: expected a number for z, found the end of the line");
  EXPECT_EQ(obj_refusal("v 0 0"), "m:1: vertex 0: expected a number for z, found the end of the file");
  EXPECT_EQ(obj_refusal("v 0 abc 0\n"), "m:1: vertex 0: expected a number for y, found 'abc'");
  EXPECT_EQ(obj_refusal("v 0 0 0 red\n"), "m:1: vertex 0: expected a number or the end of the line, found 'red'");
  EXPECT_EQ(obj_refusal("\nv 0 nan 0\n"), "m:2: vertex 0: y is nan, not a finite number");
  EXPECT_EQ(obj_refusal("v 0 0 -inf\n"), "m:1: vertex 0: z is -inf, not a finite number");
  EXPECT_EQ(obj_refusal("v 0,5 0 0\n"),
            "m:1: vertex 0: expected a number for x, found '0,5', with a comma where a number has a point");
  EXPECT_EQ(obj_refusal("v 0 0 0\xc2\xa0\n"),
            "m:1: vertex 0: expected a number for z, found '0\\xc2\\xa0', which holds a no-break space");
  EXPECT_EQ(obj_refusal("v 0 0 1.#INF\n"), "m:1: vertex 0: expected a number for z, found '1.#INF'");
  EXPECT_EQ(obj_refusal("v 1e400 0 0\n"), "m:1: vertex 0: expected a number for x, found '1e400'");
  EXPECT_EQ(obj_refusal("v 0 0 0\nv 1e200 0 0\n"),
            "m:2: vertex 1: x is 1e+200, larger in size than the largest coordinate, 2^300");
  EXPECT_EQ(obj_refusal(kThree + "f 1 2 3\nf 1 2 9\n"),
            "m:5: facet 1: names vertex 9, counted from 1, but the file has 3 vertices");
  EXPECT_EQ(obj_refusal(kThree + "f 0 1 2\n"), "m:4: facet 0: names vertex 0, but the format counts from 1");
  EXPECT_EQ(obj_refusal(kThree + "f -4 1 2\n"), "m:4: facet 0: names vertex -4, but there are 3 vertices above it");
  EXPECT_EQ(obj_refusal(kThree + "f 1 2\n"), "m:4: facet 0: has 2 of the 3 corners that a polygon needs");
  for (const std::string corner : {"x", "1.5", "1/x", "1//x", "1/1/1/1", "99999999999999999999"}) {
    EXPECT_EQ(obj_refusal(kThree + "f 1 2 " + corner + "\n"),
              "m:4: facet 0: expected a corner such as 7, 7/1, 7/1/2 or 7//2, found '" + corner + "'");
  }
}

}  // namespace
}  // namespace tact::scenes
