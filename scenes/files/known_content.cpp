#include "scenes/files/known_content.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tact::scenes {
namespace {

using namespace std::string_view_literals;

struct Kind {
  std::string_view begin;
  const char* what;
};

// By bytes that nothing else begins with.
constexpr std::array kBinaryKinds = {
    Kind{"\x1f\x8b"sv, "a gzip archive: unpack it"},
    Kind{"PK\x03\x04"sv, "a zip archive, as 3MF files are, too: unpack it, or export another format"},
    Kind{"BZh"sv, "a bzip2 archive: unpack it"},
    Kind{"\xfd"
         "7zXZ\0"sv,
         "an xz archive: unpack it"},
    Kind{"\x28\xb5\x2f\xfd"sv, "a zstd archive: unpack it"},
    Kind{"7z\xbc\xaf\x27\x1c"sv, "a 7z archive: unpack it"},
    Kind{"Rar!\x1a\x07"sv, "a RAR archive: unpack it"},
    Kind{"\xff\xfe\0\0"sv, "text in UTF-32: save it as UTF-8"},
    Kind{"\0\0\xfe\xff"sv, "text in UTF-32: save it as UTF-8"},
    Kind{"\xff\xfe"sv, "text in UTF-16: save it as UTF-8"},
    Kind{"\xfe\xff"sv, "text in UTF-16: save it as UTF-8"},
    Kind{"glTF"sv, "a glTF file: export another format"},
    Kind{"Kaydara FBX Binary"sv, "an FBX file: export another format"},
    Kind{"BLENDER"sv, "a Blender file: export a mesh from it"},
    Kind{"%PDF-"sv, "a PDF document"},
    Kind{"\x89PNG\r\n"sv, "a PNG picture"},
    Kind{"\xff\xd8\xff"sv, "a JPEG picture"},
    Kind{"GIF8"sv, "a GIF picture"},
    Kind{"\x7f"
         "ELF"sv,
         "a program"},
    Kind{"\xd0\xcf\x11\xe0"sv, "an Office document"},
    Kind{"SQLite format 3\0"sv, "a SQLite database"},
    Kind{"\x89HDF\r\n"sv, "an HDF5 file"},
    Kind{"\0\x05\x16\x07"sv, "what macOS keeps beside a file, not the file itself"},
    Kind{"tactrec\n"sv, "a recording: see tact replay and tact view"},
    Kind{"version https://git-lfs"sv, "a Git LFS pointer in place of the file: git lfs pull fetches it"},
};

// By the words that a text begins with, in small letters, after blanks.
constexpr std::array kTextKinds = {
    Kind{"<!doctype html"sv, "an HTML page, such as a download that failed leaves"},
    Kind{"<html"sv, "an HTML page, such as a download that failed leaves"},
    Kind{"<?xml"sv, "an XML file"},
    Kind{"<vtkfile"sv, "an XML file"},
    Kind{"<error"sv, "an XML file"},
    Kind{"<collada"sv, "a COLLADA file: export another format"},
    Kind{"/annex/objects/"sv, "a git-annex pointer in place of the file: git annex get fetches it"},
    Kind{"404"sv, "a message of a server that did not find the file"},
    Kind{"not found"sv, "a message of a server that did not find the file"},
    Kind{"ply\n"sv, "a PLY file"},
    Kind{"ply\r"sv, "a PLY file"},
    Kind{"off\n"sv, "an OFF file"},
    Kind{"off\r"sv, "an OFF file"},
    Kind{"solid "sv, "an STL file"},
    Kind{"#vrml"sv, "a VRML file: export another format"},
    Kind{"# vtk datafile"sv, "a VTK file"},
    Kind{"$meshformat"sv, "a Gmsh file: export another format"},
    Kind{"meshversionformatted"sv, "a Medit file: export another format"},
    Kind{"iso-10303-21"sv, "a STEP file: export a mesh from it"},
};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

bool is_blank_or_end(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Text without a mark of its order: every second byte is 0.
bool is_unmarked_utf16(std::string_view begin) {
  const std::size_t size = begin.size() / 2 * 2;
  std::array<std::size_t, 2> zeros{};
  for (std::size_t i = 0; i < size; ++i) zeros[i % 2] += begin[i] == '\0' ? 1 : 0;
  return size >= 8 && ((zeros[0] == size / 2 && zeros[1] == 0) || (zeros[1] == size / 2 && zeros[0] == 0));
}

// From its first to its last bracket.
bool is_json(std::string_view bytes) {
  const auto first = std::find_if_not(bytes.begin(), bytes.end(), is_blank_or_end);
  const auto last = std::find_if_not(bytes.rbegin(), bytes.rend(), is_blank_or_end);
  return first != bytes.end() && ((*first == '{' && *last == '}') || (*first == '[' && *last == ']'));
}

}  // namespace

std::optional<std::string> known_content(std::string_view bytes) {
  constexpr std::size_t kLooksAt = 512;
  if (bytes.empty()) return std::nullopt;
  for (const Kind& kind : kBinaryKinds) {
    if (bytes.starts_with(kind.begin)) return kind.what;
  }
  std::string_view begin = bytes.substr(0, kLooksAt);
  if (is_unmarked_utf16(begin)) return "text in UTF-16: save it as UTF-8";
  if (bytes.size() >= 8 && begin.find_first_not_of('\0') == std::string_view::npos)
    return "bytes of zero, such as a download or a disk that failed leaves";
  if (begin.starts_with("\xef\xbb\xbf")) begin.remove_prefix(3);
  begin.remove_prefix(
      static_cast<std::size_t>(std::find_if_not(begin.begin(), begin.end(), is_blank_or_end) - begin.begin()));
  if (begin.empty() && bytes.size() <= kLooksAt) return "a file of blanks";
  const std::string text = lower_case(begin);
  for (const Kind& kind : kTextKinds) {
    if (text.starts_with(kind.begin)) return kind.what;
  }
  if (is_json(bytes)) return "JSON, such as the message of a server that failed";
  return std::nullopt;
}

}  // namespace tact::scenes
