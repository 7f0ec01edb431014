// Wavefront OBJ.
#include <fmt/format.h>

#include <vector>

#include "scenes/files/mesh_builder.h"
#include "scenes/files/mesh_file.h"
#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

// A corner that names a vertex further down in the file.
struct ForwardReference {
  std::int64_t place;
  int facet;
  std::int64_t vertex;  // from 0
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& file, Split split)
      : text_(bytes, file, {.comment = '#', .backslash_joins_lines = true}), builder_(text_, split) {}

  MeshFile read() {
    while (text_.seek_token()) {
      const std::string_view keyword = *text_.token();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f" || keyword == "fo") {  // fo: the face of old files
        read_polygon();
      } else {
        text_.skip_line();
      }
    }
    if (builder_.vertex_count() == 0) text_.fail("the file ends without a vertex");
    for (const ForwardReference& reference : forward_references_) {
      if (reference.vertex >= builder_.vertex_count()) fail_corner(reference);
    }
    return builder_.mesh();
  }

 private:
  void read_vertex() {
    text_.set_item("vertex", builder_.vertex_count());
    const double x = text_.number("a number", "x");
    const double y = text_.number("a number", "y");
    const double z = text_.number("a number", "z");
    builder_.add_vertex({x, y, z});
    text_.skip_numbers();  // a weight, or a colour
    text_.clear_item();
  }

  void read_polygon() {
    corners_.clear();
    text_.set_item("facet", builder_.facet_count());
    while (const auto token = text_.token()) corners_.push_back(read_corner(*token));
    if (corners_.empty()) {
      text_.warn("a face without corners is left out");
    } else {
      builder_.add_polygon(corners_);
    }
    text_.clear_item();
  }

  // v, v/vt, v/vt/vn or v//vn.
  int read_corner(std::string_view token) {
    const std::size_t slash = token.find('/');
    const auto index = parse_integer(token.substr(0, slash));
    if (!index) fail_token(token);
    if (slash != std::string_view::npos) check_attributes(token.substr(slash + 1), token);
    return vertex_of(*index);
  }

  // vt, vt/vn or /vn; a lone slash at the end is let pass.
  void check_attributes(std::string_view attributes, std::string_view token) const {
    const std::size_t slash = attributes.find('/');
    const std::string_view first = attributes.substr(0, slash);
    if (!first.empty() && !parse_integer(first)) fail_token(token);
    if (slash == std::string_view::npos) return;
    const std::string_view second = attributes.substr(slash + 1);
    if (!second.empty() && !parse_integer(second)) fail_token(token);
  }

  int vertex_of(std::int64_t index) {
    if (index == 0) text_.fail("names vertex 0, but the format counts from 1");
    if (index < 0) {
      const std::int64_t vertex = index + builder_.vertex_count();
      if (vertex < 0) {
        text_.fail(
            fmt::format("names vertex {}, but there are {} above it", index, vertices_text(builder_.vertex_count())));
      }
      return static_cast<int>(vertex);
    }
    const std::int64_t vertex = index - 1;
    if (vertex >= builder_.vertex_count())
      forward_references_.push_back({text_.place(), builder_.facet_count(), vertex});
    return static_cast<int>(vertex);
  }

  [[noreturn]] void fail_token(std::string_view token) const {
    text_.fail_expected("a corner such as 7, 7/1, 7/1/2 or 7//2", token);
  }

  [[noreturn]] void fail_corner(const ForwardReference& reference) {
    text_.set_item("facet", reference.facet);
    text_.fail_at(reference.place, fmt::format("names vertex {}, counted from 1, but the file has {}",
                                               reference.vertex + 1, vertices_text(builder_.vertex_count())));
  }

  TextReader text_;
  MeshBuilder builder_;
  std::vector<int> corners_;
  std::vector<ForwardReference> forward_references_;
};

}  // namespace

MeshFile parse_obj(std::string_view bytes, const std::string& file, Split split) {
  return ObjReader(bytes, file, split).read();
}

}  // namespace tact::scenes
