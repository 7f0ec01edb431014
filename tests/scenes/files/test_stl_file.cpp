#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/scenes/mesh_bytes.h"
#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

using tests::bytes_of;
using tests::Corners;
using tests::Point;
using FloatFacet = std::array<float, 9>;

std::string stl_refusal(std::string_view bytes) { return tests::refusal(MeshFormat::stl, bytes); }

std::string binary_stl(const std::vector<FloatFacet>& facets, std::string head = "a part") {
  head.resize(80, ' ');
  std::string bytes = head + bytes_of(static_cast<std::uint32_t>(facets.size()));
  for (const FloatFacet& facet : facets) {
    for (int i = 0; i < 3; ++i)
      bytes += bytes_of(std::numeric_limits<float>::quiet_NaN());  // a normal that nobody needs
    for (const float value : facet) bytes += bytes_of(value);
    bytes += bytes_of(std::uint16_t{0x1234});
  }
  return bytes;
}

const FloatFacet kFirst = {0, 0, 0, 0.1f, 0, 0, 0, 1e-40f, 0};
const FloatFacet kSecond = {0.1f, 0, 0, 0, 0, 0, 0, 0, -1};

std::string text_facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal nan nan nan\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " + c +
         "\n endloop\nendfacet\n";
}

TEST(StlFile, ReadsBinaryAndMergesEqualCorners) {
  const MeshFile mesh = parse_stl(binary_stl({kFirst, kSecond}), "m");
  EXPECT_EQ(tests::positions_of(mesh),
            (std::vector<Point>{{0, 0, 0}, {double{0.1f}, 0, 0}, {0, double{1e-40f}, 0}, {0, 0, -1}}));
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {1, 0, 3}}));
}

TEST(StlFile, ReadsTextAndMergesEqualCorners) {
  const MeshFile mesh = parse_stl("solid the name\n" + text_facet("0 0 0", "0.1 0 0", "0 1e-310 0") +
                                      text_facet("0.1 0 0", "0 0 0", "0 0 -1") + "endsolid the name\n",
                                  "m");
  EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0, 0, 0}, {0.1, 0, 0}, {0, 1e-310, 0}, {0, 0, -1}}));
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {1, 0, 3}}));
}

TEST(StlFile, VerticesAtOtherPlacesAreOthersAndBothZerosAreOne) {
  const MeshFile mesh =
      parse_stl("solid\n" + text_facet("-0 0 0", "0 0 1e-310", "0 0 0.1") +
                    text_facet("0 0 0.10000000000000000555", "0 0 0.10000000000000002", "0 -0 -0.0") + "endsolid",
                "m");
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {2, 3, 0}}));
  EXPECT_TRUE(std::signbit(mesh.positions(0, 0))) << "a vertex has the coordinates that come first";
}

// What others write and has one meaning; `normal` with or without numbers, and all that may be on one line.
TEST(StlFile, ReadsWhatOthersLeaveOutOrAdd) {
  const std::string loop = " outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
  for (const std::string& bytes :
       {"solid a facet normal 0 0 1" + loop + "endsolid a", "solid facet" + loop + "endsolid",
        "solid a facet normal" + loop + "endsolid\n", "solid\nfacet\n" + loop + "\nendsolid\n",
        "solid facet of a facet normal nan nan nan" + loop + "endsolid facet\n",
        "solid a\ncolor 0.5 0.5 0.5\nfacet normal 0 0 1" + loop + "\nCOLOR 1 0 0\nendsolid",
        std::string("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nend loop\n"
                    "end facet\nend solid a\n"),
        "solid facet normal of it\nfacet normal 0 0 1" + loop + "endsolid solid of it"}) {
    const MeshFile mesh = parse_stl(bytes, "m");
    EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}})) << bytes;
    EXPECT_TRUE(mesh.warnings.empty()) << bytes;
  }
  const std::string two = "solid a facet normal 0 0 1" + loop + "endsolid a solid b facet" + loop + "endsolid b";
  EXPECT_EQ(parse_stl(two, "m").facets.cols(), 2);
}

TEST(StlFile, WarnsOfASolidWithoutEnd) {
  const std::string open = "solid s\n" + text_facet("0 0 0", "1 0 0", "0 1 0");
  const MeshFile cut = parse_stl(open, "m");
  EXPECT_EQ(tests::facets_of(cut), (std::vector<Corners>{{0, 1, 2}}));
  EXPECT_EQ(cut.warnings, std::vector<std::string>{"m:9: the file ends without endsolid: it may have been cut"});
  const MeshFile joined = parse_stl(open + open + "endsolid\n", "m");
  EXPECT_EQ(joined.facets.cols(), 2);
  EXPECT_EQ(joined.warnings, std::vector<std::string>{"m:9: a solid begins before the endsolid of the last one"});
}

// Streaming programs do not know the number of facets when they write it.
TEST(StlFile, ReadsFacetsThatAreNotCounted) {
  std::string bytes = binary_stl({kFirst, kSecond});
  for (const std::uint32_t count : {0u, 0xffffffffu}) {
    bytes.replace(80, 4, bytes_of(count));
    const MeshFile mesh = parse_stl(bytes, "m");
    EXPECT_EQ(mesh.facets.cols(), 2);
    EXPECT_EQ(mesh.warnings, std::vector<std::string>{"m: byte 80: promises " + std::to_string(count) +
                                                      " facets; all 2 that follow are read"});
    EXPECT_NE(stl_refusal(bytes + "x"), "accepted");
  }
  EXPECT_EQ(parse_stl(binary_stl({}), "m").facets.cols(), 0);
}

TEST(StlFile, WarnsOfSurplusBytes) {
  const MeshFile mesh = parse_stl(binary_stl({kFirst, kSecond}) + "xy", "m");
  EXPECT_EQ(mesh.facets.cols(), 2);
  EXPECT_EQ(mesh.warnings,
            std::vector<std::string>{"m: byte 80: promises 2 facets, and 2 more bytes follow them: not read"});
  std::string more = binary_stl({kFirst, kSecond, kFirst});
  more.replace(80, 4, bytes_of(std::uint32_t{2}));
  EXPECT_EQ(stl_refusal(more), "m: byte 80: promises 2 facets, which take 184 bytes, but the file has 234")
      << "a whole facet more: which of both is wrong?";
}

TEST(StlFile, ReadsTextOfAnyLayoutAndManySolids) {
  const std::string one =
      "SOLID A\rFacet Normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0\rvertex 0 1 0 endloop endfacet\rEndSolid A\r";
  EXPECT_EQ(tests::facets_of(parse_stl(one + one, "m")), (std::vector<Corners>{{0, 1, 2}, {0, 1, 2}}));
  EXPECT_EQ(parse_stl("solid nothing\nendsolid nothing\n", "m").facets.cols(), 0);
}

TEST(StlFile, BinaryMayBeginLikeText) {
  const MeshFile mesh = parse_stl(binary_stl({kFirst}, "solid but binary\nfacet"), "m");
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}}));
}

TEST(StlFile, RefusesBinaryNamingTheByte) {
  FloatFacet bad = kSecond;
  bad[5] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(stl_refusal(binary_stl({kFirst, bad})), "m: byte 166: facet 1: z is inf, not a finite number");
  const std::string whole = binary_stl({kFirst, kSecond});
  EXPECT_EQ(stl_refusal(whole.substr(0, 183)),
            "m: byte 80: promises 2 facets, which take 184 bytes, but the file has 183");
  EXPECT_EQ(stl_refusal(std::string(80, ' ') + "\xff\xff\xff\xff"),
            "m: byte 80: promises 4294967295 facets, which take 214748364834 bytes, but the file has 84");
  EXPECT_EQ(stl_refusal("junk"),
            "m: byte 4: neither text that begins with solid nor the 84 bytes that begin binary STL");
}

TEST(StlFile, EveryShorterBinaryFileIsRefused) {
  const std::string whole = binary_stl({kFirst, kSecond}, "solid");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(stl_refusal(std::string_view(whole).substr(0, size)), "accepted") << size;
  }
}

TEST(StlFile, RefusesTextNamingTheLine) {
  const std::string good = "solid s\n" + text_facet("0 0 0", "1 0 0", "0 1 0");  // 8 lines
  EXPECT_EQ(stl_refusal("solid s\n"), "m:2: expected facet or endsolid, found the end of the file");
  EXPECT_EQ(stl_refusal(good + "endsolid\njunk\n"), "m:10: expected solid, found 'junk'");
  EXPECT_EQ(stl_refusal(good + "face\n"), "m:9: expected facet or endsolid, found 'face'");
  EXPECT_EQ(stl_refusal(good + text_facet("0 0 0", "1 x 0", "0 1 0")),
            "m:12: facet 1: expected a number for y, found 'x'");
  EXPECT_EQ(stl_refusal(good + text_facet("0 0 0", "1 0 0", "0 nan 0")),
            "m:13: facet 1: y is nan, not a finite number");
  EXPECT_EQ(stl_refusal(good + text_facet("0 0 0", "1 0 0", "0 1 0\n  vertex 1 1 1")),
            "m:14: facet 1: expected endloop, found 'vertex'");
  EXPECT_EQ(stl_refusal(good + "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
            "m:13: facet 1: expected vertex, found 'endloop'");
}

// Ten gigabytes of zeros, which take no room on the disk: only the first page is read.
TEST(StlFile, OfZerosIsRefusedByNameAtOnce) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "zeros.stl";
  std::ofstream(path).put('\0');
  std::filesystem::resize_file(path, 10'000'000'000);
  try {
    read_mesh_file(path);
    FAIL() << "it was read";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("zeros.stl: not an STL file but bytes of zero"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace tact::scenes
