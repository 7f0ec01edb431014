// A recording: everything that entered a world, and the hash of what it answered, to run it again later.
//
// The file, version 3. Numbers are little-endian, doubles as IEEE 754 has them, without padding between them:
//
//   head      "tactrec\n", u32 version, text: the version of tact that wrote it
//   settings  u8 1, i32 threads, u8 accuracy, u8 direction policy, f64 gjk_tolerance, i32 iteration_limit, u8 zones,
//             u8 patches; the first record, and wherever the settings changed
//   add       u8 2, u8 surface, u8 motion, u32 layer, u32 mask, text name, u64 vertices, u64 facets,
//             3 f64 a vertex, 3 i32 a facet
//   remove    u8 3, body
//   positions u8 4, u64 bodies, and for each: body, u64 vertices, 3 f64 a vertex
//   detect    u8 5
//   hash      u8 6, u64 Report::hash(); after every detect
//   layers    u8 7, body, u32 layer, u32 mask; this and the next not in version 1, which had no such calls
//   motion    u8 8, body, u8 motion
//   margin    u8 9, body, f64 metres; this and the next two not in versions 1 and 2. After the body is added, if it is
//             not 0, and wherever it changed
//   self      u8 10, body, u8: is it held against itself? Likewise
//   points    u8 11; after settings whose Outputs::points is set, which a record of settings alone unsets
//
// A text is u32 bytes and these; a body is u32 index and u32 generation of its BodyId; enumerations are numbered in the
// order of their values. Outputs::trace is left out: it changes no answer. The records stand in the order of the calls;
// a call that was refused is not there. There is no end mark: a program that dies leaves what it did, and one that dies
// in a step leaves a detect without its hash.
#pragma once

#include <tact/tact.h>

#include <cstdint>
#include <ostream>
#include <span>
#include <string_view>

namespace tact::scenes {

inline constexpr std::string_view kRecordingMagic = "tactrec\n";
inline constexpr std::uint32_t kRecordingVersion = 3;

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
  points = 11
};

// A world whose calls are written to a stream, if there is one.
class RecordedWorld {
 public:
  // `recording` may be null, and must outlive the world; whether it took all is for its owner to ask at the end.
  // Errors: bad_settings.
  RecordedWorld(const Settings& settings, std::ostream* recording);

  const World& world() const { return world_; }

  // These are the world's, with its errors. What detect() works on is written out before it begins.
  void set_settings(const Settings& settings);
  BodyId add_body(const BodyDefinition& definition);
  void remove_body(BodyId body);
  void set_positions(BodyId body, const Positions& positions);
  void set_positions(std::span<const PositionsUpdate> updates);
  void set_layers(BodyId body, std::uint32_t layer, std::uint32_t mask);
  void set_motion(BodyId body, Motion motion);
  void set_margin(BodyId body, double margin);
  void set_self_contact(BodyId body, bool wanted);
  const Report& detect();
  // Changes nothing, and is not recorded.
  const MotionReport& detect_motion(Impacts wanted = Impacts::all) { return world_.detect_motion(wanted); }

  // What writing took in all, milliseconds.
  double writing_ms() const { return writing_ms_; }

 private:
  // Calls write(stream) and counts its time, if there is a stream.
  template <class Write>
  void record(const Write& write);

  World world_;
  std::ostream* recording_;
  double writing_ms_ = 0.0;
};

}  // namespace tact::scenes
