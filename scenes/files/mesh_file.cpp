#include "scenes/files/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "scenes/files/known_content.h"
#include "scenes/files/mapped_file.h"

namespace tact::scenes {
namespace {

void check_is_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw FileError(path.string() + ": no such file or folder");
  if (error) throw FileError(fmt::format("{}: {}", path.string(), error.message()));
  if (std::filesystem::is_directory(status)) throw FileError(path.string() + ": a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw FileError(path.string() + ": not a file");
}

MeshFile parse_as(MeshFormat format, std::string_view bytes, const std::string& file, Split split) {
  switch (format) {
    case MeshFormat::obj: return parse_obj(bytes, file, split);
    case MeshFormat::off: return parse_off(bytes, file, split);
    case MeshFormat::ply: return parse_ply(bytes, file, split);
    case MeshFormat::stl: return parse_stl(bytes, file);
    case MeshFormat::vtp: return parse_vtp(bytes, file, split);
    case MeshFormat::vtk: return parse_vtk(bytes, file, split);
  }
  throw FileError(file + ": no such format");
}

// In the words of known_content().
const char* own_content(MeshFormat format) {
  switch (format) {
    case MeshFormat::obj: return "an OBJ file";
    case MeshFormat::off: return "an OFF file";
    case MeshFormat::ply: return "a PLY file";
    case MeshFormat::stl: return "an STL file";
    case MeshFormat::vtp: return "an XML file";
    case MeshFormat::vtk: return "a VTK file";
  }
  return "a mesh";
}

}  // namespace

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".off") return MeshFormat::off;
  if (ending == ".ply") return MeshFormat::ply;
  if (ending == ".stl") return MeshFormat::stl;
  if (ending == ".vtp") return MeshFormat::vtp;
  if (ending == ".vtk") return MeshFormat::vtk;
  return std::nullopt;
}

MeshFile read_mesh_file(const std::filesystem::path& path, Split split) {
  check_is_file(path);
  const auto format = mesh_format(path);
  if (!format)
    throw FileError(fmt::format("{}: not a mesh file: its name ends in none of {}", path.string(), kMeshEndings));
  const MappedFile file(path);  // so that of a file that is none no more is read than shows it
  try {
    return parse_mesh(*format, file.bytes(), path.string(), split);
  } catch (const std::bad_alloc&) {
    throw FileError(path.string() + ": there is not enough memory for it");
  }
}

MeshFile parse_mesh(MeshFormat format, std::string_view bytes, const std::string& file, Split split) {
  if (bytes.empty()) throw FileError(file + ": the file is empty");
  try {
    return parse_as(format, bytes, file, split);
  } catch (const FileError&) {
    // The first bytes of a good file may be those of anything; those of a bad one may tell more than its first fault.
    const std::optional<std::string> content = known_content(bytes);
    if (!content || content == own_content(format)) throw;
    throw FileError(fmt::format("{}: not {} but {}", file, own_content(format), *content));
  }
}

}  // namespace tact::scenes
