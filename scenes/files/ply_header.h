// The header of a PLY file: which elements follow, with which properties.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/files/text_reader.h"

namespace tact::scenes {

enum class PlyEncoding { text, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;   // of the value, or of each value of a list
  std::optional<PlyType> size_type;  // of the length of a list, always an integer; nothing: not a list
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;  // in the order of the file; no two of one name
  std::int64_t vertices = 0;         // the count of the element `vertex`
  std::size_t size = 0;              // bytes
};

// Reads the header at the front of `text`, which holds `bytes`. Fails unless it has a vertex with scalars x, y and z,
// and, if it has faces or strips, they have one list of integers that is_ply_corner_list.
PlyHeader read_ply_header(TextReader& text, std::string_view bytes);

std::size_t ply_type_size(PlyType type);
// Which coordinate is it, 0 to 2?
std::optional<std::size_t> ply_axis(const PlyProperty& property);
// vertex_indices or vertex_index.
bool is_ply_corner_list(const PlyProperty& property);

}  // namespace tact::scenes
