// VTK's XML files of polygons.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "scenes/files/mesh_builder.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/text_reader.h"
#include "scenes/files/vtk_array.h"

namespace tact::scenes {
namespace {

struct VtpPiece {
  std::int64_t points = 0;
  std::int64_t polygons = 0;
  std::int64_t strips = 0;
  std::int64_t line = 1;
  std::vector<VtkArray> arrays = {};
};

class VtpReader {
 public:
  VtpReader(std::string_view bytes, const std::string& file, Split split) : xml_(bytes, file), builder_(xml_, split) {}

  MeshFile read() {
    read_structure();
    for (const VtpPiece& piece : pieces_) add_piece(piece);
    xml_.clear_item();
    MeshFile mesh = builder_.mesh();
    mesh.body_of_vertex = std::move(body_of_vertex_);
    return mesh;
  }

 private:
  void read_structure() {
    const auto first = xml_.next();
    if (!first || first->name != "VTKFile") xml_.fail("expected <VTKFile>");
    const std::string& type = xml_.required(*first, "type");
    if (type != "PolyData") xml_.fail(in_quotes(type) + ": only files of PolyData are read");
    read_encoding(*first);
    while (const auto tag = xml_.next()) {
      if (tag->name == "AppendedData" && tag->kind == XmlTag::Kind::open) return read_appended(*tag);
      if (tag->name == "InformationKey" || tag->name == "Value") {
        read_text_after(*tag);
      } else if (tag->kind == XmlTag::Kind::close) {
        if (tag->name == "VTKFile") return;
        if (tag->name == section_) section_.clear();
      } else if (tag->name == "Piece") {
        pieces_.push_back({.points = xml_.count(*tag, "NumberOfPoints"),
                           .polygons = tag->attribute("NumberOfPolys") ? xml_.count(*tag, "NumberOfPolys") : 0,
                           .strips = tag->attribute("NumberOfStrips") ? xml_.count(*tag, "NumberOfStrips") : 0,
                           .line = tag->line});
      } else if (tag->name == "DataArray") {
        if (!pieces_.empty()) add_array(*tag);
      } else if (tag->kind == XmlTag::Kind::open) {
        section_ = tag->name;
      }
    }
    xml_.fail("expected </VTKFile>, found the end of the file");
  }

  // ParaView writes ranges and the like before the numbers of an array.
  void read_text_after(const XmlTag& tag) {
    if (tag.kind == XmlTag::Kind::open || pieces_.empty() || pieces_.back().arrays.empty()) return;
    std::string_view& text = pieces_.back().arrays.back().text;
    if (tag.name == "InformationKey" && text.find_first_not_of(" \t\r\n") == std::string_view::npos) text = xml_.text();
  }

  void read_encoding(const XmlTag& tag) {
    if (const std::string* order = tag.attribute("byte_order"); order != nullptr && *order == "BigEndian")
      encoding_.order = std::endian::big;
    if (const std::string* header = tag.attribute("header_type"); header != nullptr && *header == "UInt64")
      encoding_.header_bytes = 8;
    const std::string* const compressor = tag.attribute("compressor");
    encoding_.deflated = compressor != nullptr && !compressor->empty();
    if (encoding_.deflated && *compressor != "vtkZLibDataCompressor")
      xml_.fail(fmt::format("{}: of compressors only vtkZLibDataCompressor is read", in_quotes(*compressor)));
  }

  // Raw bytes may look like anything: nothing after them is read.
  void read_appended(const XmlTag& tag) {
    const std::string& encoding = xml_.required(tag, "encoding");
    if (encoding != "raw" && encoding != "base64") xml_.fail(in_quotes(encoding) + " is no encoding of appended data");
    encoding_.appended_in_base64 = encoding == "base64";
    const std::size_t mark = xml_.rest().find('_');
    if (mark == std::string_view::npos) xml_.fail("the appended data do not begin with _");
    encoding_.appended = xml_.rest().substr(mark + 1);
    if (encoding_.appended_in_base64) encoding_.appended = encoding_.appended.substr(0, encoding_.appended.find('<'));
  }

  void add_array(const XmlTag& tag) {
    VtkArray array{.section = std::string(section_), .type = xml_.required(tag, "type"), .line = tag.line};
    if (const std::string* name = tag.attribute("Name")) array.name = *name;
    if (const std::string* format = tag.attribute("format")) array.format = *format;
    if (tag.attribute("NumberOfComponents")) array.components = xml_.count(tag, "NumberOfComponents");
    if (array.format == "appended") array.offset = offset_of(tag);
    if (tag.kind == XmlTag::Kind::open) array.text = xml_.text();
    pieces_.back().arrays.push_back(std::move(array));
  }

  std::int64_t offset_of(const XmlTag& tag) const {
    const std::string& text = xml_.required(tag, "offset");
    const auto offset = parse_integer(text);
    if (!offset || *offset < 0) xml_.fail(fmt::format("the offset is {}, not a number from 0", in_quotes(text)));
    return *offset;
  }

  const VtkArray* find(const VtpPiece& piece, std::string_view section, std::string_view name) const {
    const auto found = std::find_if(piece.arrays.begin(), piece.arrays.end(), [&](const VtkArray& array) {
      return array.section == section && (name.empty() || array.name == name);
    });
    return found != piece.arrays.end() ? &*found : nullptr;
  }

  void add_piece(const VtpPiece& piece) {
    const int first = builder_.vertex_count();
    add_vertices(piece);
    add_bodies(piece, first);
    const auto add_polygon = [&](const std::vector<int>& corners) { builder_.add_polygon(corners); };
    read_cells(piece, "Polys", piece.polygons, first, add_polygon);
    read_cells(piece, "Strips", piece.strips, first, [&](const std::vector<int>& corners) {
      for (std::size_t i = 0; i + 2 < corners.size(); ++i)
        builder_.add_polygon({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    });
  }

  void add_vertices(const VtpPiece& piece) {
    const VtkArray* const array = find(piece, "Points", "");
    if (array == nullptr) {
      xml_.set_place(piece.line);
      if (piece.points > 0) xml_.fail("the piece has no array of points");
      return;
    }
    if (array->components != 3) xml_.fail_at(array->line, "points have three components");
    const std::vector<double> numbers = numbers_of(*array, encoding_, xml_);
    check_size(numbers.size(), 3 * piece.points, "coordinates");
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      xml_.set_item("vertex", builder_.vertex_count());
      builder_.add_vertex({numbers[i], numbers[i + 1], numbers[i + 2]});
    }
    xml_.clear_item();
  }

  // As the program writes it: `body`, an integer a point.
  void add_bodies(const VtpPiece& piece, int first) {
    const VtkArray* const array = find(piece, "PointData", "body");
    if (array == nullptr || array->components != 1 || array->type.starts_with("Float")) {
      if (!body_of_vertex_.empty()) xml_.fail_at(piece.line, "the pieces before have an array body, and this one not");
      return;
    }
    const std::vector<std::int64_t> bodies = integers_of(*array, encoding_, xml_);
    check_size(bodies.size(), piece.points, "numbers of bodies");
    if (static_cast<std::size_t>(first) != body_of_vertex_.size()) xml_.fail("the pieces before have no array body");
    for (const std::int64_t body : bodies) {
      if (body < 0 || body > std::numeric_limits<int>::max())
        xml_.fail(fmt::format("a vertex is of body {}, not 0 to 2147483647", body));
      body_of_vertex_.push_back(static_cast<int>(body));
    }
  }

  template <class Add>
  void read_cells(const VtpPiece& piece, std::string_view section, std::int64_t count, int first, const Add& add) {
    if (count == 0) return;
    const VtkArray* const connectivity = find(piece, section, "connectivity");
    const VtkArray* const offsets = find(piece, section, "offsets");
    xml_.set_place(piece.line);
    if (connectivity == nullptr || offsets == nullptr)
      xml_.fail(fmt::format("{} have no arrays connectivity and offsets", section));
    const std::vector<std::int64_t> corners = integers_of(*connectivity, encoding_, xml_);
    const std::vector<std::int64_t> ends = integers_of(*offsets, encoding_, xml_);
    check_size(ends.size(), count, "offsets");
    std::vector<int> of_cell;
    std::int64_t begin = 0;
    for (const std::int64_t end : ends) {
      xml_.set_item("facet", builder_.facet_count());
      xml_.set_place(offsets->line);
      if (end < begin || end > static_cast<std::int64_t>(corners.size()))
        xml_.fail(fmt::format("it ends at {} of {} corners, and began at {}", end, corners.size(), begin));
      xml_.set_place(connectivity->line);
      of_cell.clear();
      for (; begin < end; ++begin)
        of_cell.push_back(first + builder_.corner(corners[static_cast<std::size_t>(begin)], piece.points));
      add(of_cell);
    }
    xml_.clear_item();
  }

  void check_size(std::size_t size, std::int64_t wanted, std::string_view what) const {
    if (static_cast<std::int64_t>(size) != wanted)
      xml_.fail(fmt::format("the array has {} {}, and the piece says {}", size, what, wanted));
  }

  XmlReader xml_;
  MeshBuilder builder_;
  VtkEncoding encoding_;
  std::string section_;
  std::vector<VtpPiece> pieces_;
  std::vector<int> body_of_vertex_;
};

}  // namespace

MeshFile parse_vtp(std::string_view bytes, const std::string& file, Split split) {
  return VtpReader(bytes, file, split).read();
}

}  // namespace tact::scenes
