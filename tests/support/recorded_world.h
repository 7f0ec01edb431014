// The world that the engine's tests use: it keeps what entered it, and where a test fails its input is a file that
// `tact replay` runs again.
#pragma once

#include <tact/tact.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/files/recording.h"

namespace tact::tests {

// As tact::World, whose calls it passes on. When the first assertion of a test fails, the recordings of the few worlds
// that made the test's last steps are written to the folder failed_tests of the build, and their paths printed.
class RecordedWorld {
 public:
  explicit RecordedWorld(const Settings& settings = {});

  const Settings& settings() const { return world().settings(); }
  void set_settings(const Settings& settings);
  BodyId add_body(const BodyDefinition& definition);
  void remove_body(BodyId body);
  void set_positions(BodyId body, const Positions& positions);
  void set_positions(std::span<const PositionsUpdate> updates);
  void set_layers(BodyId body, std::uint32_t layer, std::uint32_t mask) { recorded_.set_layers(body, layer, mask); }
  void set_motion(BodyId body, Motion motion) { recorded_.set_motion(body, motion); }
  void set_margin(BodyId body, double margin) { recorded_.set_margin(body, margin); }
  void set_self_contact(BodyId body, bool wanted) { recorded_.set_self_contact(body, wanted); }
  const Report& detect();

  bool contains(BodyId body) const noexcept { return world().contains(body); }
  std::size_t body_count() const noexcept { return world().body_count(); }
  std::vector<BodyId> bodies() const { return world().bodies(); }
  const std::string& name(BodyId body) const { return world().name(body); }
  Surface surface(BodyId body) const { return world().surface(body); }
  Motion motion(BodyId body) const { return world().motion(body); }
  std::uint32_t layer(BodyId body) const { return world().layer(body); }
  std::uint32_t mask(BodyId body) const { return world().mask(body); }
  double margin(BodyId body) const { return world().margin(body); }
  bool self_contact(BodyId body) const { return world().self_contact(body); }
  std::size_t vertex_count(BodyId body) const { return world().vertex_count(body); }
  std::size_t facet_count(BodyId body) const { return world().facet_count(body); }

  // The recording so far, as in scenes/files/recording.h; empty if it grew too long.
  std::string recording() const { return recording_->str(); }

 private:
  const tact::World& world() const { return recorded_.world(); }
  // Gives the recording up if it is longer than a file for looking at a failure should be.
  void limit_length();

  std::shared_ptr<std::ostringstream> recording_;
  scenes::RecordedWorld recorded_;
};

// Writes the recordings of the worlds that made the last steps of this test, named after it, and returns the paths.
// A test that fails does it by itself.
std::vector<std::filesystem::path> write_recordings(const std::filesystem::path& folder);

}  // namespace tact::tests
