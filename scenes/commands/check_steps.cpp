#include "scenes/commands/check_steps.h"

#include <fmt/format.h>
#include <tact/error.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "scenes/commands/usage_error.h"

namespace tact::scenes {
namespace {

template <class Bodies>
std::string listed_names(const Bodies& bodies) {
  std::string names;
  for (const BodyFrames& body : bodies) names += (names.empty() ? "" : ", ") + body.name;
  return names;
}

// The body that an option names, with its ending or without.
BodyFrames& body_named(const char* option, const std::string& name, std::vector<BodyFrames>& bodies) {
  const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const BodyFrames& b) { return b.name == name; });
  if (found != bodies.end()) return *found;
  std::vector<std::reference_wrapper<BodyFrames>> fitting;
  std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(fitting),
               [&](const BodyFrames& b) { return b.short_name == name; });
  if (fitting.size() == 1) return fitting.front();
  if (fitting.empty()) {
    throw UsageError(
        fmt::format("{} {}: no body has this name; the bodies are: {}", option, name, listed_names(bodies)));
  }
  throw UsageError(
      fmt::format("{} {}: the name without its ending of several bodies: {}", option, name, listed_names(fitting)));
}

// The engine's message names the body; the file tells which frame it is.
[[noreturn]] void rethrow_for_file(const BodyFrames& body, std::size_t frame, const Error& error) {
  if (body.files.empty()) throw FileError(fmt::format("{}, frame {}: {}", body.name, frame, error.what()));
  throw FileError(fmt::format("{}: {}", body.files[frame].string(), error.what()));
}

}  // namespace

std::string names_of(const std::vector<BodyFrames>& bodies) { return listed_names(bodies); }

std::vector<ExcludedPair> apply_body_options(const BodyOptions& options, std::vector<BodyFrames>& bodies,
                                             const BodyOptionNames& names) {
  for (const std::string& sheet : options.sheets) body_named(names.sheet, sheet, bodies).surface = Surface::sheet;
  for (const std::string& self : options.selves) {
    if (self != "all") {
      body_named(names.self, self, bodies).self_contact = true;
      continue;
    }
    for (BodyFrames& body : bodies) body.self_contact = true;
  }
  for (BodyFrames& body : bodies) body.margin = options.margin.value_or(body.margin);
  for (const auto& [name, margin] : options.margins) body_named(names.margin, name, bodies).margin = margin;
  std::vector<ExcludedPair> excluded;
  for (const auto& [a, b] : options.excluded) {
    const auto place = [&](const std::string& name) {
      return static_cast<std::size_t>(&body_named(names.exclude, name, bodies) - bodies.data());
    };
    excluded.emplace_back(place(a), place(b));
    if (excluded.back().first == excluded.back().second) {
      throw UsageError(fmt::format("{} {} {}: these are one body; without {} it is not held against itself",
                                   names.exclude, a, b, names.self));
    }
  }
  return excluded;
}

// Bodies that stand still are moving ones that do not move: two of them must still be tested.
CheckSteps::CheckSteps(std::vector<BodyFrames> bodies, const std::vector<ExcludedPair>& excluded, World& world)
    : bodies_(std::move(bodies)), world_(world) {
  for (const BodyFrames& body : bodies_) {
    try {
      ids_.push_back(world_.add_body({.positions = body.positions.front(),
                                      .facets = body.facets,
                                      .surface = body.surface,
                                      .name = body.name,
                                      .margin = body.margin,
                                      .self_contact = body.self_contact}));
    } catch (const Error& error) {
      rethrow_for_file(body, 0, error);
    }
  }
  for (const auto& [a, b] : excluded) world_.set_excluded(ids_[a], ids_[b], true);
}

void CheckSteps::set_frame(int frame) {
  std::vector<PositionsUpdate> updates;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].moves) updates.push_back({ids_[i], bodies_[i].positions[static_cast<std::size_t>(frame)]});
  }
  try {
    world_.set_positions(updates);
  } catch (const Error& error) {  // which names the body
    throw FileError(fmt::format("frame {}: {}", frame, error.what()));
  }
}

CheckedFrame CheckSteps::step(int frame, bool impacts) {
  if (frame > 0) set_frame(frame);
  const MotionReport* const motion = impacts && frame > 0 ? &world_.detect_motion() : nullptr;
  return {world_.detect(), motion};
}

std::vector<std::string> CheckSteps::files_of(int frame) const {
  std::vector<std::string> files;
  if (frame_count(bodies_) == 0) return files;
  for (const BodyFrames& body : bodies_) {
    if (!body.files.empty()) files.push_back(body.files[body.moves ? static_cast<std::size_t>(frame) : 0].string());
  }
  return files;
}

std::vector<Weld> CheckSteps::welds() const {
  std::vector<Weld> welds;
  for (const BodyFrames& body : bodies_) welds.push_back(body.weld);
  return welds;
}

}  // namespace tact::scenes
