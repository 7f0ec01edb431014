#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/scenes/mesh_bytes.h"

namespace tact::scenes {
namespace {

using tests::bytes_of;
using tests::Corners;
using tests::Point;

std::string ply_refusal(std::string_view bytes) { return tests::refusal(MeshFormat::ply, bytes); }

const std::string kPly = "ply\nformat ascii 1.0\n";
const std::string kXyz = "property double x\nproperty double y\nproperty double z\n";
const std::string kList = "property list uchar int vertex_indices\n";
const std::string kHead = kPly + "element vertex 4\n" + kXyz + "element face 1\n" + kList + "end_header\n";
const std::string kPlyVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";  // lines 10 to 13 after kHead

TEST(PlyFile, ReadsText) {
  const MeshFile mesh = parse_ply(kHead + "0.1 1e-310 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n\n", "m");
  EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0.1, 1e-310, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(PlyFile, ReadsNumbersOfATextToTheNearestDoubleWhateverTheirType) {
  const MeshFile mesh = parse_ply(
      kPly + "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0.1 0.2 0.3\n", "m");
  EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{0.1, 0.2, 0.3}}));
}

TEST(PlyFile, SkipsOtherElementsAndProperties) {
  const MeshFile mesh = parse_ply(
      "ply\r\nformat ascii 1.0\r\ncomment property junk\r\nobj_info more\r\nelement camera 2\r\nproperty list uchar "
      "float v\r\n"
      "property int n\r\nelement vertex 3\r\nproperty uchar red\r\nproperty double z\r\nproperty list int int tags\r\n"
      "property double y\r\nproperty double x\r\nelement empty 4000000000\r\nelement face 1\r\nproperty float "
      "quality\r\n"
      "property list uint8 uint32 vertex_index\r\nproperty list uchar float texcoord\r\nend_header\r\n"
      "2 0.5 0.5 7\r\n0 8\r\n1 3 2 9 9 2 1\r\n1 6 0 5 4\r\n1 9 1 7 8 7\r\n0.5 3 0 1 2 2 0 0\r\n",
      "m");
  EXPECT_EQ(tests::positions_of(mesh), (std::vector<Point>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}}));
}

// Four vertices and a quad with properties of every type around them.
std::string binary_ply(std::endian order, const std::string& line_end) {
  std::string header =
      "ply\nformat " + std::string(order == std::endian::little ? "binary_little_endian" : "binary_big_endian") +
      " 1.0\nelement vertex 4\nproperty char a\nproperty double x\nproperty ushort b\nproperty float y\n"
      "property short z\nproperty list int double c\nelement face 1\nproperty list ushort uint vertex_indices\n"
      "property uchar d\nend_header\n";
  for (std::size_t at = 0; (at = header.find('\n', at)) != std::string::npos; at += line_end.size())
    header.replace(at, 1, line_end);
  std::string body;
  for (int i = 0; i < 4; ++i) {
    body += bytes_of(std::int8_t{10}, order) + bytes_of(0.1 * i, order) + bytes_of(std::uint16_t{13}, order);
    body += bytes_of(0.5f * static_cast<float>(i), order) + bytes_of(static_cast<std::int16_t>(-i), order);
    body += bytes_of(std::int32_t{i}, order);
    for (int k = 0; k < i; ++k) body += bytes_of(1e300, order);
  }
  body += bytes_of(std::uint16_t{4}, order);
  for (std::uint32_t i = 0; i < 4; ++i) body += bytes_of(i, order);
  return header + body + bytes_of(std::uint8_t{255}, order);
}

TEST(PlyFile, ReadsBothByteOrdersAfterEveryLineEnd) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      const MeshFile mesh = parse_ply(binary_ply(order, line_end), "m");
      EXPECT_EQ(tests::positions_of(mesh),
                (std::vector<Point>{{0, 0, 0}, {0.1, 0.5, -1}, {0.2, 1, -2}, {0.1 * 3, 1.5, -3}}));
      EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}));
    }
  }
}

TEST(PlyFile, TheLastLineOfTheHeaderMayEndOtherwise) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\nproperty char y\nproperty char z\n";
  // A body that begins like an end of line.
  EXPECT_EQ(tests::positions_of(parse_ply(head + "end_header\n\r\n\n", "m")), (std::vector<Point>{{13, 10, 10}}));
  EXPECT_EQ(tests::positions_of(parse_ply(head + "end_header\r\n\n\r\n", "m")), (std::vector<Point>{{10, 13, 10}}));
  EXPECT_EQ(tests::positions_of(parse_ply(head + "end_header\r\1\2\3", "m")), (std::vector<Point>{{1, 2, 3}}));
  std::string returns = head + "end_header\r";
  std::replace(returns.begin(), returns.end(), '\n', '\r');
  EXPECT_EQ(tests::positions_of(parse_ply(returns + "\n\2\3", "m")), (std::vector<Point>{{10, 2, 3}}));
}

TEST(PlyFile, ReadsIndicesOf64Bits) {
  const std::vector<Corners> one{{0, 1, 2}};
  for (const char* type : {"int64", "uint64"}) {
    const std::string list = std::string("property list uint64 ") + type + " vertex_indices\n";
    EXPECT_EQ(tests::facets_of(parse_ply(kPly + "element vertex 4\n" + kXyz + "element face 1\n" + list +
                                             "end_header\n" + kPlyVertices + "3 0 1 2\n",
                                         "m")),
              one);
    const std::string head =
        "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty int64 x\nproperty uint64 y\nproperty char z\n"
        "property list uchar uint64 tags\nelement face 1\n" +
        list + "end_header\n";
    const auto wide = [](std::uint64_t value) { return bytes_of(value, std::endian::big); };
    std::string body;
    for (int i = 0; i < 3; ++i) body += wide(~std::uint64_t{0}) + wide(std::uint64_t{1} << 63) + "\1\1" + wide(7);
    const MeshFile mesh = parse_ply(head + body + wide(3) + wide(0) + wide(1) + wide(2), "m");
    EXPECT_EQ(tests::positions_of(mesh)[0], (Point{-1, 0x1p63, 1}));
    EXPECT_EQ(tests::facets_of(mesh), one);
    EXPECT_NE(ply_refusal(head + body + wide(std::uint64_t{1} << 62) + wide(0)).find("the file ends too early"),
              std::string::npos);
    const std::string large = ply_refusal(head + body + wide(3) + wide(0) + wide(1) + wide(std::uint64_t{1} << 63));
    EXPECT_TRUE(large.ends_with(": names vertex -9223372036854775808, counted from 0, but the file has 3 vertices") ||
                large.ends_with(": vertex_indices holds 9223372036854775808, too large for any file"))
        << large;
  }
  // A length whose bytes are more than can be counted.
  const std::string huge = "ply\nformat binary_little_endian 1.0\nelement vertex 0\n" + kXyz +
                           "element tag 1\nproperty list int64 double t\nend_header\n";
  EXPECT_NE(ply_refusal(huge + bytes_of(std::int64_t{1} << 61)).find("the file ends too early"), std::string::npos);
}

TEST(PlyFile, ReadsStrips) {
  const std::string head = kPly + "element vertex 6\n" + kXyz + "element tristrips 2\nproperty list int int " +
                           "vertex_indices\nend_header\n" + kPlyVertices + "2 0 0\n2 1 0\n";
  const MeshFile mesh = parse_ply(head + "9 0 1 3 2 -1 4 5 2 -1\n7 0 1 3 3 2 2 5\n", "m");
  EXPECT_EQ(tests::facets_of(mesh), (std::vector<Corners>{{0, 1, 3}, {3, 1, 2}, {4, 5, 2}, {0, 1, 3}}));
  EXPECT_EQ(tests::facets_of(parse_ply(head + "0\n6 0 1 3 3 2 5\n", "m")),
            (std::vector<Corners>{{0, 1, 3}, {2, 3, 5}}));
  EXPECT_EQ(ply_refusal(head + "5 0 1 2 -1 3\n0\n"), "m:16: tristrips 0: has 1 of the 3 corners that a polygon needs");
  EXPECT_EQ(ply_refusal(head + "4 0 1 2 -2\n0\n"),
            "m:16: tristrips 0: names vertex -2, counted from 0, but the file has 6 vertices");
}

TEST(PlyFile, EveryShorterBinaryFileIsRefused) {
  const std::string whole = binary_ply(std::endian::little, "\n");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string message = ply_refusal(std::string_view(whole).substr(0, size));
    EXPECT_TRUE(message.starts_with("m:")) << size << ": " << message;
  }
}

std::string binary_points(const std::string& count, const std::string& body) {
  return "ply\nformat binary_big_endian 1.0\nelement vertex " + count + "\n" + kXyz + "end_header\n" + body;
}

TEST(PlyFile, RefusesBinaryNamingTheByte) {
  const auto number = [](double value) { return bytes_of(value, std::endian::big); };
  const std::string two =
      number(1) + number(2) + number(3) + number(4) + number(std::numeric_limits<double>::quiet_NaN());
  const std::string header = binary_points("2", "");
  EXPECT_EQ(ply_refusal(binary_points("2", two + number(6))),
            "m: byte " + std::to_string(header.size() + 40) + ": vertex 1: y is nan, not a finite number");
  EXPECT_EQ(ply_refusal(binary_points("2", two)), "m: byte " + std::to_string(header.size() + 40) +
                                                      ": vertex 1: the file ends too early, after " +
                                                      std::to_string(header.size() + 40) + " bytes");
  const MeshFile surplus = parse_ply(binary_points("0", "xy"), "m");
  EXPECT_EQ(surplus.warnings, std::vector<std::string>{"m: byte " + std::to_string(header.size()) +
                                                       ": 2 more bytes than the header promises: not read"});
}

TEST(PlyFile, PromisesTakeNoMemory) {
  EXPECT_EQ(ply_refusal(binary_points("4294967296", "")),
            "m:7: promises 4294967296 vertices, more than 32-bit indices can number");
  EXPECT_NE(ply_refusal(binary_points("2147483647", bytes_of(1.0))).find("vertex 0: the file ends too early"),
            std::string::npos);
  const std::string list = "ply\nformat binary_little_endian 1.0\nelement vertex 0\n" + kXyz +
                           "element face 4294967295\nproperty list uint int vertex_indices\nend_header\n";
  EXPECT_NE(ply_refusal(list + bytes_of(std::uint32_t{0xffffffff})).find("facet 0: the file ends too early"),
            std::string::npos);
}

TEST(PlyFile, RefusesTextNamingTheLine) {
  EXPECT_EQ(ply_refusal(kHead + "0 0 0\n1 0\n"), "m:12: vertex 1: expected a number for z, found the end of the file");
  EXPECT_EQ(ply_refusal(kHead + "0 0 0\n1 0 0 5\n"),
            "m:11: vertex 1: expected the end of the line after what the header names, found '5'");
  EXPECT_EQ(ply_refusal(kHead + "0 0 0\n1 nan 0\n"), "m:11: vertex 1: y is nan, not a finite number");
  EXPECT_EQ(ply_refusal(kHead + kPlyVertices + "3 0 1 4\n"),
            "m:14: facet 0: names vertex 4, counted from 0, but the file has 4 vertices");
  EXPECT_EQ(ply_refusal(kHead + kPlyVertices + "2 0 1\n"),
            "m:14: facet 0: has 2 of the 3 corners that a polygon needs");
  EXPECT_EQ(ply_refusal(kHead + kPlyVertices + "-1\n"), "m:14: facet 0: the list vertex_indices has -1 values");
  EXPECT_EQ(ply_refusal(kHead + kPlyVertices + "3 0 1 1.5\n"),
            "m:14: facet 0: expected an integer for vertex_indices, found '1.5'");
  EXPECT_EQ(ply_refusal(kHead + kPlyVertices + "3 0 1 2\n9\n"), "m:15: expected the end of the file, found '9'");
}

TEST(PlyFile, MessagesStayShortAndPrintable) {
  const std::string name = "\x90" + std::string(1000, 'n');
  const std::string message = ply_refusal(kPly + "element vertex 0\n" + kXyz + "element " + name + " 1\nproperty int " +
                                          name + "\nend_header\n");
  const std::string cut = "\\x90" + std::string(36, 'n') + "...";
  EXPECT_EQ(message, "m:10: " + cut + " 0: expected a value for " + cut + ", found the end of the file");
}

TEST(PlyFile, RefusesHeadersNamingTheLine) {
  EXPECT_EQ(ply_refusal("PLY\nformat ascii 1.0\nelement vertex 0\n" + kXyz + "end_header\n"), "accepted");
  EXPECT_EQ(ply_refusal("plyx\n"), "m:1: expected ply, found 'plyx'");
  EXPECT_EQ(ply_refusal("ply\nformat ascii 2.0\n"), "m:2: expected the version 1.0, found '2.0'");
  EXPECT_EQ(ply_refusal("ply\nformat utf8 1.0\n"),
            "m:2: expected ascii, binary_little_endian or binary_big_endian, found 'utf8'");
  EXPECT_EQ(ply_refusal(kPly + "element vertex -1\n"), "m:3: the number of elements is -1");
  EXPECT_EQ(ply_refusal(kPly + "element vertex many\n"), "m:3: expected the number of elements, found 'many'");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 1\nelement vertex 1\n"), "m:4: a second element 'vertex'");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 1\nproperty int x\nproperty int x\n"), "m:5: a second property 'x'");
  EXPECT_EQ(ply_refusal(kPly + "property int x\n"), "m:3: a property before the first element");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 1\nproperty half x\n"),
            "m:4: expected a type such as float or uchar, found 'half'");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 1\nproperty list float int x\n"),
            "m:4: the length of a list must be an integer");
  EXPECT_EQ(ply_refusal(kPly + "vertices 8\n"), "m:3: expected a line of the header, or end_header, found 'vertices'");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 1\n"), "m:4: the file ends before end_header");
  EXPECT_EQ(ply_refusal(kPly + "end_header\n"), "m:3: the header has no element vertex");
  EXPECT_EQ(ply_refusal("ply\nend_header\n"), "m:2: the header has no line 'format'");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 1\nproperty float x\nproperty float y\nend_header\n"),
            "m:6: the element vertex has no number z");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 0\n" + kXyz + "element face 1\nproperty int n\nend_header\n"),
            "m:9: the element face has 0 lists vertex_indices or vertex_index, one is needed");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 0\n" + kXyz + "element tristrips 1\nproperty int n\nend_header\n"),
            "m:9: the element tristrips has 0 lists vertex_indices or vertex_index, one is needed");
  EXPECT_EQ(ply_refusal(kPly + "element vertex 0\n" + kXyz + "element face 1\nproperty list uchar float " +
                        "vertex_indices\nend_header\n"),
            "m:9: vertex_indices of the element face is a list of float or double, not a list of integers");
}

}  // namespace
}  // namespace tact::scenes
