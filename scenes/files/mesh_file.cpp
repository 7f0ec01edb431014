#include "scenes/files/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace tact::scenes {
namespace {

void check_is_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw FileError(path.string() + ": no such file or folder");
  if (error) throw FileError(fmt::format("{}: {}", path.string(), error.message()));
  if (!std::filesystem::is_regular_file(status)) throw FileError(path.string() + ": not a file");
}

std::string read_bytes(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0) {
    bytes.append(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw FileError(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  return bytes;
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
  return std::nullopt;
}

MeshFile read_mesh_file(const std::filesystem::path& path) {
  check_is_file(path);
  const auto format = mesh_format(path);
  if (!format) throw FileError(path.string() + ": not a mesh file: its name does not end in .obj, .off, .ply or .stl");
  return parse_mesh(*format, read_bytes(path), path.string());
}

MeshFile parse_mesh(MeshFormat format, std::string_view bytes, const std::string& file) {
  if (bytes.empty()) throw FileError(file + ": the file is empty");
  switch (format) {
    case MeshFormat::obj: return parse_obj(bytes, file);
    case MeshFormat::off: return parse_off(bytes, file);
    case MeshFormat::ply: return parse_ply(bytes, file);
    case MeshFormat::stl: return parse_stl(bytes, file);
  }
  throw FileError(file + ": no such format");
}

}  // namespace tact::scenes
