// Mesh files: OBJ, OFF, PLY and STL.
//
// The readers are our own: of the packaged ones, OpenMesh drops and reorders facets of meshes that are not manifold,
// tinyobjloader rounds doubles wrongly and reads past broken lines. These keep the order of the file, read every number
// to the nearest double, take memory only as data comes, and refuse what is broken with the place where it is.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "scenes/files/file_error.h"

namespace tact::scenes {

// Vertices in the order of the file. Facets in the order of the file after each polygon is split into a fan from its
// first vertex. Every index is that of a vertex, every coordinate finite and no larger than kLargestCoordinate.
struct MeshFile {
  Eigen::Matrix3Xd positions;  // 3 x V
  Eigen::Matrix3Xi facets;     // 3 x F
};

enum class MeshFormat { obj, off, ply, stl };

// The format that the ending of the file's name tells, in capitals or not; nothing for another ending.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);

// Errors: FileError, for a file that cannot be read, is of no known format, is empty or broken.
MeshFile read_mesh_file(const std::filesystem::path& path);

// The mesh in `bytes`; `file` is the name for messages. Errors: FileError.
MeshFile parse_mesh(MeshFormat format, std::string_view bytes, const std::string& file);

// Wavefront OBJ: `v` and `f`, indices from 1 or, negative, from the last vertex; what follows a coordinate triple or a
// slash must be numbers and is not used. All other keywords are skipped. A file without a vertex is refused.
MeshFile parse_obj(std::string_view bytes, const std::string& file);

// Geomview OFF in text, with or without its first line, and its variants with normals, colours or texture coordinates.
// One vertex or polygon a line. Edge counts and colours are not used.
MeshFile parse_off(std::string_view bytes, const std::string& file);

// Stanford PLY, text or binary of either byte order: x, y, z of `vertex` and the list `vertex_indices` or
// `vertex_index` of `face`; other elements and properties are skipped, triangle strips refused.
MeshFile parse_ply(std::string_view bytes, const std::string& file);

// STL, text or binary. Corners with equal bits are one vertex, numbered as it first comes up; normals are not used.
MeshFile parse_stl(std::string_view bytes, const std::string& file);

}  // namespace tact::scenes
