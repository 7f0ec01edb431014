#include <gtest/gtest.h>
#include <tact/recording.h>

#include <string>
#include <utility>
#include <vector>

#include "scenes/files/known_content.h"
#include "scenes/files/of_recording.h"
#include "tests/scenes/mesh_bytes.h"

namespace tact::scenes {
namespace {

using namespace std::string_literals;

std::string in_utf16(std::string_view text, bool big) {
  std::string bytes;
  for (const char c : text) bytes += big ? "\0"s + c : c + "\0"s;
  return bytes;
}

const std::string kKnownTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kGitLfs =
    "version https://git-lfs.github.com/spec/v1\n"
    "oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\nsize 12345\n";

// What comes in place of a file, and a part of what is said of it.
std::vector<std::pair<std::string, std::string>> replacements() {
  return {{kGitLfs, "a Git LFS pointer"},
          {"\xff\xfe" + in_utf16(kKnownTriangle, false), "text in UTF-16"},
          {"\xfe\xff" + in_utf16(kKnownTriangle, true), "text in UTF-16"},
          {in_utf16(kKnownTriangle, false), "text in UTF-16"},
          {in_utf16(kKnownTriangle, true), "text in UTF-16"},
          {"\x1f\x8b\x08\0\0\0\0\0rest"s, "a gzip archive"},
          {"PK\x03\x04rest", "a zip archive"},
          {"BZh91AY&SY", "a bzip2 archive"},
          {"\xfd\x37zXZ\0\0"s, "an xz archive"},
          {"<!DOCTYPE html>\n<html><body>Sign in</body></html>\n", "an HTML page"},
          {"\n\n  <HTML>\n", "an HTML page"},
          {"\xef\xbb\xbf<?xml version=\"1.0\"?><Error><Code>AccessDenied</Code></Error>", "an XML file"},
          {"{\"message\": \"Not Found\", \"status\": 404}\n", "JSON"},
          {"[\n 1, 2\n]\n", "JSON"},
          {"404: Not Found", "a message of a server"},
          {"/annex/objects/SHA256E-s100--abc.ply\n", "a git-annex pointer"},
          {std::string(100, '\0'), "bytes of zero"},
          {" \n\t\n", "a file of blanks"},
          {"glTF\2\0\0\0"s, "a glTF file"},
          {"%PDF-1.4", "a PDF document"},
          {"\x89PNG\r\n\x1a\n", "a PNG picture"},
          {"\0\x05\x16\x07\0\2\0\0Mac OS X"s, "what macOS keeps"},
          {"tactrec\n\1\0\0\0", "a recording"}};
}

TEST(KnownContent, EveryReaderSaysWhatComesInPlaceOfAMesh) {
  for (const auto& [bytes, what] : replacements()) {
    for (const auto& [format, name] :
         {std::pair{MeshFormat::obj, "an OBJ file"}, std::pair{MeshFormat::off, "an OFF file"},
          std::pair{MeshFormat::ply, "a PLY file"}, std::pair{MeshFormat::stl, "an STL file"}}) {
      const std::string message = tests::refusal(format, bytes);
      EXPECT_TRUE(message.starts_with("m: not " + std::string(name) + " but " + what)) << message;
    }
  }
}

TEST(KnownContent, SoDoRecordings) {
  for (const auto& [bytes, what] : replacements()) {
    if (bytes.starts_with("tactrec")) continue;
    try {
      open_recording(bytes, "r", {});
      FAIL() << what;
    } catch (const FileError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("r: not a recording but " + what)) << error.what();
    }
  }
  EXPECT_THROW(open_recording("", "r", {}), FileError);
  try {
    open_recording("tactrec\nxxxx", "r", {});
    FAIL();
  } catch (const FileError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("r: byte 8: ")) << error.what();
  }
}

TEST(KnownContent, AMeshOfAnotherFormatIsNamed) {
  EXPECT_EQ(tests::refusal(MeshFormat::obj, "ply\nformat ascii 1.0\n"), "m: not an OBJ file but a PLY file");
  EXPECT_EQ(tests::refusal(MeshFormat::ply, "solid a\nfacet normal 0 0 1\n"), "m: not a PLY file but an STL file");
  EXPECT_EQ(tests::refusal(MeshFormat::stl, "OFF\n3 1 0\n"), "m: not an STL file but an OFF file");
  EXPECT_EQ(tests::refusal(MeshFormat::off, "OFF\n3 1\n"),
            "m:3: vertex 0: expected a number for x, found the end of the file");
}

// What a good file begins with does not matter.
TEST(KnownContent, GoodFilesMayBeginLikeOthers) {
  std::string stl = "PK\x03\x04";
  stl.resize(80, '\0');
  stl += tests::bytes_of(std::uint32_t{0});
  EXPECT_EQ(tests::refusal(MeshFormat::stl, stl), "accepted");
  EXPECT_EQ(tests::refusal(MeshFormat::obj, "<html>\n" + kKnownTriangle), "accepted");
  EXPECT_FALSE(known_content(kKnownTriangle));
  EXPECT_FALSE(known_content("{ but no JSON"));
  EXPECT_FALSE(known_content(""));
}

}  // namespace
}  // namespace tact::scenes
