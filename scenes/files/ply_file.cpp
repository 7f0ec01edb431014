// Stanford PLY, text and binary.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <limits>
#include <string>
#include <vector>

#include "scenes/commands/counted.h"
#include "scenes/files/binary_reader.h"
#include "scenes/files/mesh_builder.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/ply_header.h"
#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

// The values of a text body.
class TextValues {
 public:
  explicit TextValues(TextReader& text) : text_(text) {}

  // An element may go on over several lines, but never shares its last with the next.
  double real(const PlyProperty& property) {
    text_.seek_token();
    return text_.number("a number", property.name);
  }
  std::int64_t integer(PlyType /*type*/, const PlyProperty& property) {
    text_.seek_token();
    return text_.integer("an integer", property.name);
  }
  void skip(PlyType /*type*/, std::int64_t count, const PlyProperty& property) {
    for (std::int64_t i = 0; i < count; ++i) {
      text_.seek_token();
      text_.expect_token("a value", property.name);
    }
  }
  void end_element() {
    if (const auto text = text_.token()) text_.fail_expected("the end of the line after what the header names", text);
  }
  void end_file() {
    if (text_.seek_token()) text_.fail_expected("the end of the file", text_.token());
  }
  Source& source() { return text_; }

 private:
  TextReader& text_;
};

// The values of a binary body.
class BinaryValues {
 public:
  explicit BinaryValues(BinaryReader& binary) : binary_(binary) {}

  double real(const PlyProperty& property) {
    if (property.type == PlyType::float64) return binary_.read<double>();
    if (property.type == PlyType::float32) return static_cast<double>(binary_.read<float>());
    if (property.type == PlyType::uint64) return static_cast<double>(binary_.read<std::uint64_t>());
    return static_cast<double>(integer(property.type, property));
  }
  std::int64_t integer(PlyType type, const PlyProperty& property) {
    switch (type) {
      case PlyType::int8: return binary_.read<std::int8_t>();
      case PlyType::uint8: return binary_.read<std::uint8_t>();
      case PlyType::int16: return binary_.read<std::int16_t>();
      case PlyType::uint16: return binary_.read<std::uint16_t>();
      case PlyType::int32: return binary_.read<std::int32_t>();
      case PlyType::uint32: return binary_.read<std::uint32_t>();
      case PlyType::int64: return binary_.read<std::int64_t>();
      case PlyType::uint64: return signed_of(binary_.read<std::uint64_t>(), property);
      case PlyType::float32:
      case PlyType::float64: break;  // the header lets no such integer pass
    }
    return 0;
  }
  void skip(PlyType type, std::int64_t count, const PlyProperty& /*property*/) {
    binary_.skip(static_cast<std::uint64_t>(count), ply_type_size(type));
  }
  void end_element() {}
  void end_file() {
    if (binary_.bytes_left() == 0) return;
    binary_.skip(0);
    binary_.warn(fmt::format("{} than the header promises: not read",
                             counted(static_cast<std::int64_t>(binary_.bytes_left()), "more byte")));
  }
  Source& source() { return binary_; }

 private:
  std::int64_t signed_of(std::uint64_t value, const PlyProperty& property) const {
    if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      binary_.fail(fmt::format("{} holds {}, too large for any file", printable(property.name), value));
    return static_cast<std::int64_t>(value);
  }

  BinaryReader& binary_;
};

template <class Values>
std::int64_t read_list_size(Values& values, const PlyProperty& property) {
  const std::int64_t size = values.integer(*property.size_type, property);
  if (size < 0) values.source().fail(fmt::format("the list {} has {} values", printable(property.name), size));
  return size;
}

template <class Values>
void skip_property(Values& values, const PlyProperty& property) {
  values.skip(property.type, property.size_type ? read_list_size(values, property) : 1, property);
}

template <class Values>
void read_vertex(Values& values, const PlyElement& element, MeshBuilder& builder) {
  std::array<double, 3> position{};
  for (const PlyProperty& property : element.properties) {
    if (const auto axis = ply_axis(property)) {
      position[*axis] = values.real(property);
    } else {
      skip_property(values, property);
    }
  }
  builder.add_vertex(position);
}

// Every second triangle of a strip has its first two corners the other way round. One with a vertex twice only leads on
// to the next.
void add_strip(const std::vector<int>& strip, MeshBuilder& builder) {
  if (strip.size() == 1 || strip.size() == 2) return builder.add_polygon(strip);  // which refuses it
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const std::size_t odd = i % 2;
    const int a = strip[i - 2 + odd], b = strip[i - 1 - odd], c = strip[i];
    if (a != b && b != c && c != a) builder.add_polygon({a, b, c});
  }
}

// What the corners of an element are: one polygon, or strips of triangles that -1 ends.
enum class PlyCorners { polygon, strips };

template <class Values>
void read_corners(Values& values, const PlyElement& element, std::int64_t vertices, PlyCorners kind,
                  std::vector<int>& corners, MeshBuilder& builder) {
  corners.clear();
  for (const PlyProperty& property : element.properties) {
    if (!is_ply_corner_list(property)) {
      skip_property(values, property);
      continue;
    }
    const std::int64_t size = read_list_size(values, property);
    for (std::int64_t i = 0; i < size; ++i) {
      const std::int64_t index = values.integer(property.type, property);
      if (kind == PlyCorners::strips && index == -1) {
        add_strip(corners, builder);
        corners.clear();
      } else {
        corners.push_back(builder.corner(index, vertices));
      }
    }
  }
  if (kind == PlyCorners::polygon) return builder.add_polygon(corners);
  add_strip(corners, builder);
}

template <class Values>
MeshFile read_body(Values values, const PlyHeader& header, Split split) {
  MeshBuilder builder(values.source(), split);
  std::vector<int> corners;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;  // takes no room, whatever the count
    const bool is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face", is_strip = element.name == "tristrips";
    for (std::int64_t i = 0; i < element.count; ++i) {
      values.source().set_item(is_face ? "facet" : std::string_view(element.name), is_face ? builder.facet_count() : i);
      if (is_vertex) {
        read_vertex(values, element, builder);
      } else if (is_face || is_strip) {
        const PlyCorners kind = is_face ? PlyCorners::polygon : PlyCorners::strips;
        read_corners(values, element, header.vertices, kind, corners, builder);
      } else {
        for (const PlyProperty& property : element.properties) skip_property(values, property);
      }
      values.end_element();
    }
  }
  values.source().clear_item();
  values.end_file();
  return builder.mesh();
}

}  // namespace

MeshFile parse_ply(std::string_view bytes, const std::string& file, Split split) {
  TextReader text(bytes, file, {});
  const PlyHeader header = read_ply_header(text, bytes);
  if (header.encoding == PlyEncoding::text) return read_body(TextValues(text), header, split);
  const std::endian order = header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little;
  BinaryReader binary(bytes, file, header.size, order);
  return read_body(BinaryValues(binary), header, split);
}

}  // namespace tact::scenes
