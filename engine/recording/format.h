// What a recording is made of.
//
// The file, version 8. Numbers are little-endian, doubles as IEEE 754 has them, without padding between them:
//
//   head      "tactrec\n", u32 version, text: the version of tact that wrote it
//   settings  u8 1, i32 threads, u8 accuracy, u8 direction policy, f64 gjk_tolerance, i32 iteration_limit, u8 zones,
//             u8 patches; the first record, and wherever the settings changed
//   add       u8 2, u8 surface, u8 motion, u32 layer, u32 mask, u64 external id (since version 4), text name,
//             u64 vertices, u64 facets, 3 f64 a vertex, 3 i32 a facet
//   remove    u8 3, body
//   positions u8 4, u64 bodies, and for each: body, u64 vertices, 3 f64 a vertex
//   detect    u8 5
//   hash      u8 6, u64 Report::hash(); after every detect that had an answer
//   layers    u8 7, body, u32 layer, u32 mask; this and the next since version 2
//   motion    u8 8, body, u8 motion
//   margin    u8 9, body, f64 metres; this and the next two since version 3. After the body is added, if it is not 0,
//             and wherever it changed
//   self      u8 10, body, u8: whether it is tested against itself. Likewise
//   points    u8 11; after settings whose Outputs::points is set, which a record of settings alone unsets
//   group     u8 12, body, u32 group; this and the next since version 4. After the body is added, if it is in one, and
//             wherever it changed
//   excluded  u8 13, body, body, u8: whether they are
//   poses     u8 14, u64 bodies, and for each: body, 9 f64 of the rotation, row by row, 3 f64 of the translation; since
//             version 5, as is the motion `rigid`
//   failed    u8 15; after a detect that threw, since version 6
//   key       u8 16, u64: the key of the body that is added next, if one was given; this and the next since version 6
//   restore   u8 17, u64 bytes, and these: those of World::restore()
//   curves    u8 18; after settings whose Outputs::curves is set, which a record of settings alone unsets; since
//             version 7
//   facets    u8 19, body, u64 vertices, u64 facets, 3 f64 a vertex, 3 i32 a facet, i32 a vertex: that which it was, or
//             -1; since version 7
//   bare      u8 20, u64 edges, u64 points, 2 i32 an edge, i32 a point: those of the body that is added, or whose
//             facets are set, next, if it has any; this and the next since version 7
//   plane     u8 21, 3 f64 of the normal, f64 offset, u32 layer, u32 mask, u64 external id, text name; then as after
//   add
//   reach     u8 22; after settings whose Outputs::within_reach is set, likewise; since version 7
//   rest      u8 23, body, f64 metres, or -1: the margin; since version 7, as are the next two. After the body is
//   added,
//             if it is given, and wherever it changed
//   features  u8 24, body, eight u64: rest offsets, labels of vertices, labels of facets, layers and masks of vertices,
//             layers and masks of facets, margins of vertices, the last three since version 8; then these, f64 each
//             offset and margin, u32 each other
//   map       u8 25, u64 facets, i32 each: the facet that it was, or -1; of the body whose facets are set next
//   neighbors u8 26, body, i32 rings, f64 distance at rest, u64 vertices, 3 f64 a vertex: where they are at rest, or
//             none: where they are; this and the next since version 8
//   labels    u8 27, body, u32 label, body, u32 label, u8 kind, u8: whether they are excluded
//
// A text is u32 bytes and these; a body is u32 index and u32 generation of its BodyId; enumerations are numbered in the
// order of their values. Outputs::trace is left out: it changes no answer. The records stand in the order of the calls;
// a call that was refused is not there. There is no end mark: a program that dies leaves what it did.
#pragma once

#include <cstdint>
#include <string_view>

namespace tact::recording {

inline constexpr std::string_view kMagic = "tactrec\n";
inline constexpr std::uint32_t kVersion = 8;
inline constexpr double kAsMargin = -1.0;  // of a rest offset

enum class RecordKind : std::uint8_t {
  settings = 1,
  add = 2,
  remove = 3,
  positions = 4,
  detect = 5,
  hash = 6,
  layers = 7,
  motion = 8,
  margin = 9,
  self_contact = 10,
  points = 11,
  group = 12,
  excluded = 13,
  poses = 14,
  failed = 15,
  key = 16,
  restore = 17,
  curves = 18,
  facets = 19,
  bare = 20,
  plane = 21,
  within_reach = 22,
  rest_offset = 23,
  features = 24,
  facet_map = 25,
  neighbors = 26,
  excluded_labels = 27
};
inline constexpr RecordKind kLastRecordKind = RecordKind::excluded_labels;

}  // namespace tact::recording
