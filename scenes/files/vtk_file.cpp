// VTK's legacy files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "scenes/files/binary_reader.h"
#include "scenes/files/mesh_builder.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

std::string capitals(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return result;
}

// Of UNSTRUCTURED_GRID.
enum CellType {
  kVertexCell = 1,
  kPolyVertexCell,
  kLineCell,
  kPolyLineCell,
  kTriangle,
  kStrip,
  kPolygon,
  kPixel,
  kQuad
};

class VtkReader {
 public:
  VtkReader(std::string_view bytes, const std::string& file, Split split)
      : bytes_(bytes), file_(file), text_(bytes, file, {}), builder_(text_, split) {}

  MeshFile read() {
    read_head();
    while (text_.seek_token()) {
      const std::string keyword = capitals(*text_.token());
      if (keyword == "POINT_DATA" || keyword == "CELL_DATA") break;
      read_section(keyword);
    }
    text_.clear_item();
    if (is_grid_) add_grid();
    if (builder_.vertex_count() == 0) text_.fail("the file has no POINTS");
    return builder_.mesh();
  }

 private:
  struct Cells {
    std::vector<std::int64_t> corners = {};
    std::vector<std::int64_t> ends = {};  // in `corners`
    std::int64_t line = 1;
  };

  void read_head() {
    const std::string_view first = text_.expect_token("# vtk DataFile Version", "");
    if (first != "#") text_.fail_expected("# vtk DataFile Version", first);
    text_.skip_line();
    if (!text_.seek_token()) text_.fail_expected("a title", std::nullopt);
    text_.skip_line();
    text_.seek_token();
    const std::string format = capitals(text_.expect_token("ASCII or BINARY"));
    if (format != "ASCII" && format != "BINARY") text_.fail_expected("ASCII or BINARY", format);
    binary_ = format == "BINARY";
    text_.seek_token();
    if (const std::string_view word = text_.expect_token("DATASET"); capitals(word) != "DATASET")
      text_.fail_expected("DATASET", word);
    const std::string kind = capitals(text_.expect_token("the kind of data"));
    is_grid_ = kind == "UNSTRUCTURED_GRID";
    if (kind != "POLYDATA" && !is_grid_) text_.fail(in_quotes(kind) + ": only POLYDATA and UNSTRUCTURED_GRID are read");
  }

  void read_section(const std::string& keyword) {
    if (keyword == "POINTS") return read_points();
    if (keyword == "POLYGONS") return add_polygons(read_cells());
    if (keyword == "TRIANGLE_STRIPS") return add_strips(read_cells());
    if (keyword == "VERTICES" || keyword == "LINES") return static_cast<void>(read_cells());
    if (keyword == "CELLS" && is_grid_) return static_cast<void>(grid_ = read_cells());
    if (keyword == "CELL_TYPES" && is_grid_) {
      const std::int64_t count = read_count("the number of cells");
      types_ = values<std::int64_t>(count, "INT");
      return;
    }
    if (keyword == "METADATA") return skip_metadata();
    if (keyword == "FIELD") return skip_field();
    text_.fail_expected("POINTS or POLYGONS", keyword);
  }

  std::int64_t read_count(std::string_view what) {
    const std::int64_t count = text_.integer(what);
    if (count < 0 || count > std::numeric_limits<int>::max())
      text_.fail(fmt::format("{} is {}, not 0 to 2147483647", what, count));
    return count;
  }

  void read_points() {
    if (builder_.vertex_count() > 0) text_.fail("POINTS for a second time");
    const std::int64_t count = read_count("the number of points");
    const std::string type = capitals(text_.expect_token("the type of the coordinates"));
    for_each<double>(3 * count, type, [&, axis = 0, place = std::array<double, 3>{}](double value) mutable {
      place[static_cast<std::size_t>(axis)] = value;
      axis = (axis + 1) % 3;
      if (axis != 0) return;
      text_.set_item("vertex", builder_.vertex_count());
      builder_.add_vertex(place);
    });
    text_.clear_item();
  }

  // Counts before corners; since version 5 of the format, offsets and corners apart.
  Cells read_cells() {
    Cells cells{.line = text_.place()};
    const std::int64_t first = read_count("the number of cells"), second = read_count("the number of corners");
    const TextReader::Mark mark = text_.mark();
    if (text_.seek_token()) {
      if (const auto word = text_.token(); word && capitals(*word) == "OFFSETS") {
        read_offsets(first, second, cells);
        return cells;
      }
    }
    text_.go_back(mark);
    const std::vector<std::int64_t> numbers = values<std::int64_t>(second, "INT");
    std::size_t at = 0;
    for (std::int64_t cell = 0; cell < first; ++cell) {
      if (at >= numbers.size() || numbers[at] < 0 || numbers[at] > static_cast<std::int64_t>(numbers.size() - at - 1))
        text_.fail_at(cells.line, fmt::format("cell {}: its corners go beyond the {} numbers", cell, numbers.size()));
      const auto end = at + 1 + static_cast<std::size_t>(numbers[at]);
      for (++at; at < end; ++at) cells.corners.push_back(numbers[at]);
      cells.ends.push_back(static_cast<std::int64_t>(cells.corners.size()));
    }
    if (at != numbers.size())
      text_.fail_at(cells.line, fmt::format("{} numbers more than the cells have corners", numbers.size() - at));
    return cells;
  }

  void read_offsets(std::int64_t offsets, std::int64_t corners, Cells& cells) {
    cells.ends = values<std::int64_t>(offsets, capitals(text_.expect_token("the type of the offsets")));
    text_.seek_token();
    if (const std::string_view word = text_.expect_token("CONNECTIVITY"); capitals(word) != "CONNECTIVITY")
      text_.fail_expected("CONNECTIVITY", word);
    cells.corners = values<std::int64_t>(corners, capitals(text_.expect_token("the type of the corners")));
    std::int64_t before = 0;
    for (const std::int64_t end : cells.ends) {
      if (end < before || end > corners)
        text_.fail_at(cells.line, fmt::format("an offset is {}, after {}, of {} corners", end, before, corners));
      before = end;
    }
    if (!cells.ends.empty() && cells.ends.front() == 0) cells.ends.erase(cells.ends.begin());  // where the first begins
  }

  template <class Add>
  void for_each_cell(const Cells& cells, const Add& add) {
    std::vector<int> corners;
    std::int64_t begin = 0;
    for (std::size_t cell = 0; cell < cells.ends.size(); ++cell) {
      text_.set_item("facet", builder_.facet_count());
      corners.clear();
      for (; begin < cells.ends[cell]; ++begin)
        corners.push_back(builder_.corner(cells.corners[static_cast<std::size_t>(begin)], builder_.vertex_count()));
      add(cell, corners);
    }
    text_.clear_item();
  }
  void add_polygons(const Cells& cells) {
    for_each_cell(cells, [&](std::size_t, const std::vector<int>& corners) { builder_.add_polygon(corners); });
  }
  void add_strip(const std::vector<int>& corners) {
    for (std::size_t i = 0; i + 2 < corners.size(); ++i)
      builder_.add_polygon({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
  }
  void add_strips(const Cells& cells) {
    for_each_cell(cells, [&](std::size_t, const std::vector<int>& corners) { add_strip(corners); });
  }

  void add_grid() {
    if (types_.size() != grid_.ends.size())
      text_.fail(fmt::format("{} types of {} cells", types_.size(), grid_.ends.size()));
    for_each_cell(grid_, [&](std::size_t cell, const std::vector<int>& corners) {
      const std::int64_t type = types_[cell];
      if (type == kTriangle || type == kPolygon || type == kQuad) {
        builder_.add_polygon(corners);
      } else if (type == kPixel && corners.size() == 4) {
        builder_.add_polygon({corners[0], corners[1], corners[3], corners[2]});
      } else if (type == kStrip) {
        add_strip(corners);
      } else if (type < kVertexCell || type > kPolyLineCell) {
        text_.set_item("cell", static_cast<std::int64_t>(cell));
        text_.fail_at(grid_.line, fmt::format("type {} is no facet; in Python tact.read() gives the surface of cells "
                                              "that have a volume",
                                              type));
      }
    });
  }

  // A key, a value a line, up to an empty line.
  void skip_metadata() {
    text_.skip_line();
    for (;;) {
      skip_line_end();
      const std::size_t begin = text_.offset();
      text_.skip_line();
      if (text_.offset() == begin) return;
    }
  }
  void skip_line_end() {
    const TextReader::Mark mark = text_.mark();
    if (mark.offset >= bytes_.size()) return;
    const std::size_t length = bytes_.substr(mark.offset).starts_with("\r\n") ? 2 : 1;
    text_.go_back({mark.offset + length, mark.line + 1});
  }
  void skip_field() {
    text_.expect_token("the name of the field");
    const std::int64_t arrays = read_count("the number of arrays");
    for (std::int64_t i = 0; i < arrays; ++i) {
      if (!text_.seek_token()) text_.fail_expected("the name of an array", std::nullopt);
      const std::string_view name = *text_.token();
      if (capitals(name) == "METADATA") {
        skip_metadata();
        --i;
        continue;
      }
      const std::int64_t components = read_count("the number of components"), rows = read_count("the number of rows");
      if (components > 0 && rows > std::numeric_limits<int>::max() / components) text_.fail("an array is too large");
      for_each<double>(components * rows, capitals(text_.expect_token("the type of the array")), [](double) {});
    }
  }

  template <class Wanted>
  std::vector<Wanted> values(std::int64_t count, const std::string& type) {
    std::vector<Wanted> numbers;
    for_each<Wanted>(count, type, [&](Wanted value) { numbers.push_back(value); });
    return numbers;
  }

  template <class Wanted, class Use>
  void for_each(std::int64_t count, const std::string& type, Use use) {
    if (binary_) return for_each_binary<Wanted>(count, type, use);
    for (std::int64_t i = 0; i < count; ++i) {
      text_.seek_token();
      if constexpr (std::is_floating_point_v<Wanted>) {
        use(text_.number("a number"));
      } else {
        use(text_.integer("an integer"));
      }
    }
  }

  template <class Wanted, class Use>
  void for_each_binary(std::int64_t count, const std::string& type, Use& use) {
    const std::string_view rest = bytes_.substr(text_.offset());
    const std::size_t line_end = std::min(rest.find('\n'), rest.size());
    if (line_end == rest.size() && count > 0) text_.fail("the file ends before its numbers");
    BinaryReader reader(bytes_, file_, text_.offset() + std::min(line_end + 1, rest.size()), std::endian::big);
    const auto with = [&](auto number) {
      using Number = decltype(number);
      if constexpr (std::is_floating_point_v<Number> && !std::is_floating_point_v<Wanted>) {
        text_.fail(in_quotes(type) + " where integers are wanted");
      } else {
        for (std::int64_t i = 0; i < count; ++i) use(static_cast<Wanted>(reader.read<Number>()));
      }
    };
    if (type == "DOUBLE") {
      with(double{});
    } else if (type == "FLOAT") {
      with(float{});
    } else if (type == "INT" || type == "UNSIGNED_INT") {
      with(std::int32_t{});
    } else if (type == "LONG" || type == "VTKTYPEINT64" || type == "VTKIDTYPE") {
      with(std::int64_t{});
    } else if (type == "SHORT") {
      with(std::int16_t{});
    } else if (type == "CHAR" || type == "UNSIGNED_CHAR") {
      with(std::int8_t{});
    } else {
      text_.fail(in_quotes(type) + " is no type of numbers that is read");
    }
    text_.go_back({bytes_.size() - reader.bytes_left(), text_.place() + 1});
  }

  std::string_view bytes_;
  std::string file_;
  TextReader text_;
  MeshBuilder builder_;
  bool binary_ = false;
  bool is_grid_ = false;
  Cells grid_;
  std::vector<std::int64_t> types_;
};

}  // namespace

MeshFile parse_vtk(std::string_view bytes, const std::string& file, Split split) {
  return VtkReader(bytes, file, split).read();
}

}  // namespace tact::scenes
