// Geomview OFF.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "scenes/files/mesh_builder.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

struct OffCounts {
  std::int64_t vertices = 0;
  std::int64_t polygons = 0;
};

// [ST][C][N][4][n]OFF, as Geomview has it.
void check_keyword(const TextReader& text, std::string_view keyword) {
  std::string_view prefix = keyword.substr(0, keyword.size() - 3);
  for (const std::string_view part : {"ST", "C", "N"}) {
    if (prefix.starts_with(part)) prefix.remove_prefix(part.size());
  }
  if (prefix.empty()) return;
  if (prefix == "4" || prefix == "n" || prefix == "4n")
    text.fail(in_quotes(keyword) + ": only three coordinates are read");
  text.fail_expected("OFF, or the numbers of vertices and polygons", keyword);
}

std::int64_t parse_count(const TextReader& text, std::string_view number, std::string_view what) {
  const auto count = parse_integer(number);
  if (!count) text.fail_expected(what, number);
  if (*count < 0 || *count > std::numeric_limits<int>::max()) {
    text.fail(fmt::format("{} is {}, not 0 to 2147483647", what, *count));
  }
  return *count;
}

// The first line may be missing, and some known collections leave out the space after OFF.
OffCounts read_head(TextReader& text) {
  constexpr std::string_view kVertices = "the number of vertices";
  constexpr std::string_view kPolygons = "the number of polygons";
  if (!text.seek_token()) text.fail_expected("OFF", std::nullopt);
  const std::string_view first = *text.token();
  std::string_view number = first.starts_with("OFF") ? first.substr(3) : first;
  if (!parse_integer(number)) {
    if (!first.ends_with("OFF")) text.fail_expected("OFF, or the number of vertices", first);
    check_keyword(text, first);
    text.seek_token();
    number = text.expect_token(kVertices);
    if (number == "BINARY") text.fail("binary OFF is not read");
  }
  OffCounts counts;
  counts.vertices = parse_count(text, number, kVertices);
  counts.polygons = parse_count(text, text.expect_token(kPolygons), kPolygons);
  text.skip_numbers();  // the number of edges
  return counts;
}

void read_vertices(TextReader& text, MeshBuilder& builder, const OffCounts& counts) {
  for (std::int64_t i = 0; i < counts.vertices; ++i) {
    text.set_item("vertex", i);
    text.seek_token();
    const double x = text.number("a number", "x");
    const double y = text.number("a number", "y");
    const double z = text.number("a number", "z");
    builder.add_vertex({x, y, z});
    text.skip_numbers();  // a normal, a colour, texture coordinates
  }
}

void read_polygons(TextReader& text, MeshBuilder& builder, const OffCounts& counts) {
  std::vector<int> corners;
  for (std::int64_t i = 0; i < counts.polygons; ++i) {
    text.set_item("facet", builder.facet_count());
    corners.clear();
    text.seek_token();
    const std::int64_t size = text.integer("the number of corners");
    for (std::int64_t k = 0; k < size; ++k) {
      corners.push_back(builder.corner(text.integer("the index of a vertex"), counts.vertices));
    }
    builder.add_polygon(corners);
    text.skip_numbers();  // a colour
  }
}

}  // namespace

MeshFile parse_off(std::string_view bytes, const std::string& file) {
  TextReader text(bytes, file, {.comment = '#'});
  MeshBuilder builder(text);
  const OffCounts counts = read_head(text);
  read_vertices(text, builder, counts);
  read_polygons(text, builder, counts);
  text.clear_item();
  if (text.seek_token()) text.fail_expected("the end of the file", text.token());
  return builder.mesh();
}

}  // namespace tact::scenes
