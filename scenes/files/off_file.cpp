// Geomview OFF.
#include <fmt/format.h>

#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "scenes/commands/counted.h"
#include "scenes/files/mesh_builder.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

// What the first line says of the file.
struct OffHead {
  std::int64_t vertices = 0;
  std::int64_t polygons = 0;
  int numbers_a_vertex = 3;  // where lines do not tell; 0: unknown, as colours may have three or four
};

// One vertex and one polygon a line, or free lines.
enum class OffLayout { lines, free };

// [ST][C][N][4][n]OFF, as Geomview has it. Returns how many numbers a vertex has, or 0.
int check_keyword(const TextReader& text, std::string_view keyword) {
  std::string_view prefix = keyword.substr(0, keyword.size() - 3);
  int numbers = 3;
  bool colours = false;
  for (const auto& [part, count] :
       std::initializer_list<std::pair<std::string_view, int>>{{"ST", 2}, {"C", 0}, {"N", 3}}) {
    if (!prefix.starts_with(part)) continue;
    prefix.remove_prefix(part.size());
    numbers += count;
    colours |= count == 0;
  }
  if (prefix.empty()) return colours ? 0 : numbers;
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
OffHead read_head(TextReader& text) {
  constexpr std::string_view kVertices = "the number of vertices";
  constexpr std::string_view kPolygons = "the number of polygons";
  if (!text.seek_token()) text.fail_expected("OFF", std::nullopt);
  const std::string_view first = *text.token();
  std::string_view number = first.starts_with("OFF") ? first.substr(3) : first;
  OffHead head;
  if (!parse_integer(number)) {
    if (!first.ends_with("OFF")) text.fail_expected("OFF, or the number of vertices", first);
    head.numbers_a_vertex = check_keyword(text, first);
    text.seek_token();
    number = text.expect_token(kVertices);
    if (number == "BINARY") text.fail("binary OFF is not read");
  }
  head.vertices = parse_count(text, number, kVertices);
  head.polygons = parse_count(text, text.expect_token(kPolygons), kPolygons);
  text.skip_numbers();  // the number of edges
  return head;
}

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& file, Split split, OffLayout layout)
      : text_(bytes, file, {.comment = '#'}), builder_(text_, split), layout_(layout) {}

  MeshFile read() {
    const OffHead head = read_head(text_);
    if (layout_ == OffLayout::free && head.numbers_a_vertex == 0)
      text_.fail("a vertex has an unknown count of numbers");
    for (std::int64_t i = 0; i < head.vertices; ++i) read_vertex(i, head.numbers_a_vertex);
    // A number too few among free vertices takes one of the polygons: it is then in the middle of a line.
    if (layout_ == OffLayout::free) text_.expect_line_end();
    for (std::int64_t i = 0; i < head.polygons; ++i) read_polygon(head.vertices);
    text_.clear_item();
    if (text_.seek_token()) {
      text_.fail_expected(fmt::format("the end of the file after the {}", counted(head.polygons, "polygon")),
                          text_.token());
    }
    return builder_.mesh();
  }

 private:
  // Where lines are free, a number may stand on the next one.
  void seek() {
    if (layout_ == OffLayout::free) text_.seek_token();
  }

  double coordinate(std::string_view axis) {
    seek();
    return text_.number("a number", axis);
  }

  // Coordinates, and a normal, a colour, texture coordinates.
  void read_vertex(std::int64_t index, int numbers) {
    text_.set_item("vertex", index);
    text_.seek_token();
    const double x = coordinate("x"), y = coordinate("y"), z = coordinate("z");
    builder_.add_vertex({x, y, z});
    if (layout_ == OffLayout::lines) return text_.skip_numbers();
    for (int i = 3; i < numbers; ++i) coordinate("what follows z");
  }

  // Of any layout it ends with its line, after its colour.
  void read_polygon(std::int64_t vertices) {
    text_.set_item("facet", builder_.facet_count());
    corners_.clear();
    text_.seek_token();
    const std::int64_t size = text_.integer("the number of corners");
    for (std::int64_t k = 0; k < size; ++k) {
      seek();
      corners_.push_back(builder_.corner(text_.integer("the index of a vertex"), vertices));
    }
    builder_.add_polygon(corners_);
    text_.skip_numbers();
  }

  TextReader text_;
  MeshBuilder builder_;
  OffLayout layout_;
  std::vector<int> corners_;
};

}  // namespace

// Geomview lets numbers stand on any lines, but nearly all files have a vertex and a polygon a line, many with numbers
// that their first line does not tell of. What can be read by lines is; the message about what is neither is of lines.
MeshFile parse_off(std::string_view bytes, const std::string& file, Split split) {
  try {
    return OffReader(bytes, file, split, OffLayout::lines).read();
  } catch (const FileError&) {
    try {
      return OffReader(bytes, file, split, OffLayout::free).read();
    } catch (const FileError&) {
    }
    throw;
  }
}

}  // namespace tact::scenes
