// The arrays of VTK's XML files: numbers of any type as text, as base64 or as raw bytes, deflated or not.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/files/xml_reader.h"

namespace tact::scenes {

// How a file writes its arrays.
struct VtkEncoding {
  std::endian order = std::endian::little;
  std::size_t header_bytes = 4;  // of the sizes before an array: 4 or 8
  bool deflated = false;
  bool appended_in_base64 = false;
  std::string_view appended = {};  // the block after all elements that arrays lie in
};

// An array as its element names it.
struct VtkArray {
  std::string section = {};  // of the piece: "Points", "Polys", "PointData", ...
  std::string name = {};
  std::string type = {};    // "Float64", say
  std::string format = {};  // "ascii", "binary", "appended"
  std::int64_t components = 1;
  std::int64_t offset = 0;     // in the appended block
  std::string_view text = {};  // in the element
  std::int64_t line = 1;
};

// The numbers of `array`, each exactly. Memory is taken only as bytes are there. Fails, through `source`, if the array
// is broken, if its numbers are no integers where those are wanted, or not one of 64 bits.
std::vector<double> numbers_of(const VtkArray& array, const VtkEncoding& encoding, XmlReader& source);
std::vector<std::int64_t> integers_of(const VtkArray& array, const VtkEncoding& encoding, XmlReader& source);

}  // namespace tact::scenes
