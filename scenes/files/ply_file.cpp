// Stanford PLY, text and binary.
#include <fmt/format.h>

#include <bit>
#include <optional>
#include <string>
#include <vector>

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
  void end_element() { text_.expect_line_end(); }
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
    return static_cast<double>(integer(property.type, property));
  }
  std::int64_t integer(PlyType type, const PlyProperty& /*property*/) {
    switch (type) {
      case PlyType::int8: return binary_.read<std::int8_t>();
      case PlyType::uint8: return binary_.read<std::uint8_t>();
      case PlyType::int16: return binary_.read<std::int16_t>();
      case PlyType::uint16: return binary_.read<std::uint16_t>();
      case PlyType::int32: return binary_.read<std::int32_t>();
      case PlyType::uint32: return binary_.read<std::uint32_t>();
      case PlyType::float32:
      case PlyType::float64: break;  // the header lets no such integer pass
    }
    return 0;
  }
  void skip(PlyType type, std::int64_t count, const PlyProperty& /*property*/) {
    binary_.skip(static_cast<std::uint64_t>(count) * ply_type_size(type));
  }
  void end_element() {}
  void end_file() {
    if (binary_.bytes_left() > 0) {
      binary_.skip(0);
      binary_.fail(fmt::format("{} more bytes than the header promises", binary_.bytes_left()));
    }
  }
  Source& source() { return binary_; }

 private:
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

template <class Values>
void read_polygon(Values& values, const PlyElement& element, std::int64_t vertices, std::vector<int>& corners,
                  MeshBuilder& builder) {
  corners.clear();
  for (const PlyProperty& property : element.properties) {
    if (!is_ply_corner_list(property)) {
      skip_property(values, property);
      continue;
    }
    const std::int64_t size = read_list_size(values, property);
    for (std::int64_t i = 0; i < size; ++i) {
      corners.push_back(builder.corner(values.integer(property.type, property), vertices));
    }
  }
  builder.add_polygon(corners);
}

template <class Values>
MeshFile read_body(Values values, const PlyHeader& header) {
  MeshBuilder builder(values.source());
  std::vector<int> corners;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;  // takes no room, whatever the count
    const bool is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face";
    for (std::int64_t i = 0; i < element.count; ++i) {
      values.source().set_item(is_face ? "facet" : std::string_view(element.name), is_face ? builder.facet_count() : i);
      if (is_vertex) {
        read_vertex(values, element, builder);
      } else if (is_face) {
        read_polygon(values, element, header.vertices, corners, builder);
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

MeshFile parse_ply(std::string_view bytes, const std::string& file) {
  TextReader text(bytes, file, {});
  const PlyHeader header = read_ply_header(text, bytes);
  if (header.encoding == PlyEncoding::text) return read_body(TextValues(text), header);
  const std::endian order = header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little;
  BinaryReader binary(bytes, file, header.size, order);
  return read_body(BinaryValues(binary), header);
}

}  // namespace tact::scenes
