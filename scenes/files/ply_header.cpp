#include "scenes/files/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace tact::scenes {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array<TypeName, 18> kTypeNames = {{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"int64", PlyType::int64},
    {"uint64", PlyType::uint64},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

PlyType type_of(const TextReader& text, std::string_view name) {
  const auto found =
      std::find_if(kTypeNames.begin(), kTypeNames.end(), [&](const TypeName& t) { return t.name == name; });
  if (found == kTypeNames.end()) text.fail_expected("a type such as float or uchar", name);
  return found->type;
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

PlyEncoding read_encoding(TextReader& text) {
  const std::string_view name = text.expect_token("an encoding");
  const std::string_view version = text.expect_token("the version 1.0");
  if (version != "1.0") text.fail_expected("the version 1.0", version);
  if (name == "ascii") return PlyEncoding::text;
  if (name == "binary_little_endian") return PlyEncoding::little_endian;
  if (name == "binary_big_endian") return PlyEncoding::big_endian;
  text.fail_expected("ascii, binary_little_endian or binary_big_endian", name);
}

PlyElement read_element(TextReader& text, const PlyHeader& header) {
  PlyElement element;
  element.name = text.expect_token("the name of an element");
  element.count = text.integer("the number of elements");
  if (element.count < 0) text.fail(fmt::format("the number of elements is {}", element.count));
  for (const PlyElement& other : header.elements) {
    if (other.name == element.name) text.fail("a second element " + in_quotes(element.name));
  }
  return element;
}

PlyProperty read_property(TextReader& text, const PlyElement& element) {
  PlyProperty property;
  std::string_view type = text.expect_token("a type, or list");
  if (type == "list") {
    property.size_type = type_of(text, text.expect_token("the type of a length"));
    if (!is_integer(*property.size_type)) text.fail("the length of a list must be an integer");
    type = text.expect_token("the type of a value");
  }
  property.type = type_of(text, type);
  property.name = text.expect_token("the name of a property");
  for (const PlyProperty& other : element.properties) {
    if (other.name == property.name) text.fail("a second property " + in_quotes(property.name));
  }
  return property;
}

void check_vertex(const TextReader& text, const PlyElement& element) {
  if (element.count > std::numeric_limits<int>::max()) {
    text.fail(fmt::format("promises {} vertices, more than 32-bit indices can number", element.count));
  }
  for (const std::string_view axis : {"x", "y", "z"}) {
    const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                    [&](const PlyProperty& p) { return p.name == axis && !p.size_type; });
    if (found == element.properties.end()) text.fail(fmt::format("the element vertex has no number {}", axis));
  }
}

bool has_corner_name(const PlyProperty& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

// Of faces, or of strips.
void check_corners(const TextReader& text, const PlyElement& element) {
  const auto lists = std::count_if(element.properties.begin(), element.properties.end(), is_ply_corner_list);
  if (lists == 1) return;
  for (const PlyProperty& property : element.properties) {
    if (!has_corner_name(property) || is_ply_corner_list(property)) continue;
    text.fail(fmt::format("{} of the element {} is {}, not a list of integers", property.name, element.name,
                          property.size_type ? "a list of float or double" : "one number"));
  }
  text.fail(
      fmt::format("the element {} has {} lists vertex_indices or vertex_index, one is needed", element.name, lists));
}

void check_header(const TextReader& text, PlyHeader& header, bool has_encoding) {
  if (!has_encoding) text.fail("the header has no line 'format'");
  bool has_vertex = false;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      check_vertex(text, element);
      header.vertices = element.count;
      has_vertex = true;
    } else if (element.name == "face" || element.name == "tristrips") {
      check_corners(text, element);
    }
  }
  if (!has_vertex) text.fail("the header has no element vertex");
}

// A binary body may begin with any byte. So \r\n after end_header ends its line, but where the first line ends with \r
// alone.
std::size_t body_offset(const TextReader& text, std::string_view bytes) {
  const std::string_view first_end = bytes.substr(std::min(bytes.find_first_of("\r\n"), bytes.size()));
  const bool lone_returns = first_end.starts_with('\r') && !first_end.starts_with("\r\n");
  if (text.offset() == bytes.size()) text.fail("the file ends with end_header, without an end of its line");
  return text.offset() + (bytes.substr(text.offset()).starts_with("\r\n") && !lone_returns ? 2 : 1);
}

}  // namespace

std::size_t ply_type_size(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32: return 4;
    case PlyType::int64:
    case PlyType::uint64:
    case PlyType::float64: return 8;
  }
  return 0;
}

std::optional<std::size_t> ply_axis(const PlyProperty& property) {
  const std::size_t axis = std::string_view("xyz").find(property.name);
  if (property.name.size() != 1 || axis == std::string_view::npos) return std::nullopt;
  return axis;
}

bool is_ply_corner_list(const PlyProperty& property) {
  return property.size_type && is_integer(property.type) && has_corner_name(property);
}

PlyHeader read_ply_header(TextReader& text, std::string_view bytes) {
  PlyHeader header;
  bool has_encoding = false;
  const std::string_view magic = text.expect_token("ply");
  if (magic != "ply" && magic != "PLY") text.fail_expected("ply", magic);
  text.expect_line_end();
  while (text.seek_token()) {
    const std::string_view keyword = *text.token();
    if (keyword == "comment" || keyword == "obj_info") {
      text.skip_line();
    } else if (keyword == "format") {
      header.encoding = read_encoding(text);
      has_encoding = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(text, header));
    } else if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property before the first element");
      PlyElement& element = header.elements.back();
      element.properties.push_back(read_property(text, element));
    } else if (keyword == "end_header") {
      text.expect_line_end();
      check_header(text, header, has_encoding);
      header.size = body_offset(text, bytes);
      return header;
    } else {
      text.fail_expected("a line of the header, or end_header", keyword);
    }
    text.expect_line_end();
  }
  text.fail("the file ends before end_header");
}

}  // namespace tact::scenes
