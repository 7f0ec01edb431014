// Mesh files: OBJ, OFF, PLY, STL, and polygons of VTK.
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
#include <vector>

#include "scenes/files/file_error.h"

namespace tact::scenes {

// Vertices in the order of the file. Facets in the order of the file after each polygon is split into triangles, two
// fewer than it has corners. Every index is that of a vertex, every coordinate finite and no larger than
// kLargestCoordinate.
struct MeshFile {
  Eigen::Matrix3Xd positions;              // 3 x V
  Eigen::Matrix3Xi facets;                 // 3 x F
  Eigen::Matrix3Xi fans = {};              // 3 x F, each polygon as a fan; empty if these are the facets
  std::vector<int> body_of_vertex = {};    // where the file says of which body each vertex is; else empty
  std::vector<std::string> warnings = {};  // what was read all the same, a line each that begins with the file
};

// How polygons of more than three corners are split.
enum class Split {
  // Into a fan from the first vertex where that is right, else by ears, seen along the normal. A polygon that is not
  // simple is refused.
  by_shape,
  fans,  // into fans in any case: for later frames of a body, whose facets are those of the first
};

enum class MeshFormat { obj, off, ply, stl, vtp, vtk };

// The endings of their names, for messages.
constexpr const char* kMeshEndings = ".obj, .off, .ply, .stl, .vtp, .vtk";

// The format that the ending of the file's name tells, in capitals or not; nothing for another ending.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);

// Errors: FileError, for a file that cannot be read, is of no known format, is empty or broken.
MeshFile read_mesh_file(const std::filesystem::path& path, Split split = Split::by_shape);

// The mesh in `bytes`; `file` is the name for messages. Bytes that are no mesh of the format but something known, such
// as an archive or a page of the web, are refused as that. Errors: FileError.
MeshFile parse_mesh(MeshFormat format, std::string_view bytes, const std::string& file, Split split = Split::by_shape);

// Wavefront OBJ: `v` and `f`, indices from 1 or, negative, from the last vertex; what follows a coordinate triple or a
// slash must be numbers and is not used. All other keywords are skipped. A backslash joins lines of `v` and `f`. A face
// without corners is left out with a warning; a file without a vertex is refused.
MeshFile parse_obj(std::string_view bytes, const std::string& file, Split split = Split::by_shape);

// Geomview OFF in text, with or without its first line, and its variants with normals, colours or texture coordinates.
// One vertex or polygon a line; or, where that cannot be, vertices and polygons over any lines, of which the first
// vertex and each polygon begins one. Edge counts and colours are not used.
MeshFile parse_off(std::string_view bytes, const std::string& file, Split split = Split::by_shape);

// Stanford PLY, text or binary of either byte order: x, y, z of `vertex` and the list `vertex_indices` or
// `vertex_index` of `face`, and of `tristrips`, where -1 ends a strip and triangles with a vertex twice, which join
// strips, are left out. Other elements and properties are skipped. Bytes after the last element are a warning.
MeshFile parse_ply(std::string_view bytes, const std::string& file, Split split = Split::by_shape);

// STL, text or binary, welded: corners with equal coordinates are one vertex, numbered as it first comes up. Normals
// and colours are not used and may be missing. Of a binary file the facets may not be counted (0 or 2^32 - 1, as
// streaming programs leave it), and bytes after the last facet are a warning; so is a text without its last endsolid.
MeshFile parse_stl(std::string_view bytes, const std::string& file);

// VTK's XML file of polygons and strips; its arrays may be text, base64 or raw bytes, of either byte order, deflated by
// zlib. Vertices, lines and other data are not used, but an array `body` of integers over the points.
MeshFile parse_vtp(std::string_view bytes, const std::string& file, Split split = Split::by_shape);

// VTK's legacy file, text or binary, up to version 5.1: POLYDATA, and UNSTRUCTURED_GRID of facets; vertices and lines
// are not used, nor is what follows POINT_DATA or CELL_DATA.
MeshFile parse_vtk(std::string_view bytes, const std::string& file, Split split = Split::by_shape);

}  // namespace tact::scenes
