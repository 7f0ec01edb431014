#include "scenes/commands/report_table.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <tact/version.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "scenes/commands/counted.h"
#include "scenes/commands/report_json.h"

namespace tact::scenes {
namespace {

constexpr int kMostPairLines = 40;  // a frame, and in the summary

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  constexpr double kDegrees = 57.295779513082320877;
  return kDegrees * std::atan2(a.cross(b).norm(), a.dot(b));
}

// A name from a file may hold anything; a line of a table must stay one.
std::string printable_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return text;
}

}  // namespace

TableReport::TableReport(std::ostream& out, const World& world)
    : out_(out), has_facets_(world.settings().accuracy != Accuracy::hulls) {
  std::size_t width = 4;
  for (const BodyId body : world.bodies()) {
    names_.push_back(printable_name(world.name(body)));
    width = std::max(width, names_.back().size());
  }
  name_width_ = static_cast<int>(width);
  fmt::print(out_, "tact {}, accuracy {}, {}\n\n", TACT_VERSION, accuracy_name(world.settings().accuracy),
             counted(world.settings().threads, "thread"));
  fmt::print(out_, "{:>5}  {:<{}}  {:>10}  {:>10}  surface\n", "body", "name", name_width_, "vertices", "facets");
  for (const BodyId body : world.bodies()) {
    fmt::print(out_, "{:>5}  {:<{}}  {:>10}  {:>10}  {}\n", body.index, names_[body.index], name_width_,
               world.vertex_count(body), world.facet_count(body), surface_name(world.surface(body)));
  }
}

std::string TableReport::body_text(std::uint32_t index) const {
  return fmt::format("{:>4}  {:<{}}", index, names_[index], name_width_);
}

void TableReport::add_frame(int frame, const Report& report, const MotionReport* motion) {
  const StepStats& stats = report.stats();
  fmt::print(out_, "{}frame {}: {}", frames_ == 0 ? "\n" : "", frame, counted(stats.candidate_pairs, "candidate pair"));
  if (stats.candidate_pairs > 0) fmt::print(out_, ", {} in contact", stats.contacts);
  if (stats.contacts > 0 && has_facets_) {
    fmt::print(out_, ", {} touching, {}", stats.touching_contacts, counted(stats.facet_pairs, "facet pair"));
  }
  fmt::print(out_, "; {:.3f} ms\n", stats.total_ms);
  if (motion != nullptr) print_motion(*motion);
  int lines = 0;
  for (const Contact& contact : report.contacts()) {
    if (contact.a == contact.b && ++lines <= kMostPairLines) print_self(contact);
  }
  for (const CandidatePair& pair : report.candidate_pairs()) {
    const Contact* found = report.find_contact(pair.a, pair.b);
    History& history = histories_[{pair.a.index, pair.b.index}];
    ++history.candidate_frames;
    if (pair.hulls_overlap) note_contact(frame, *found, history);
    if (++lines <= kMostPairLines) print_pair(pair, found);
  }
  if (lines > kMostPairLines) fmt::print(out_, "      and {} more pairs (--json has all)\n", lines - kMostPairLines);
  ++frames_;
  total_ms_ += stats.total_ms;
}

void TableReport::print_motion(const MotionReport& motion) {
  int lines = 0;
  for (const ImpactPair& pair : motion.pairs()) {
    if (++lines > kMostPairLines) break;
    fmt::print(out_, "  {}  {}  on the way: {}, {}\n", body_text(pair.a.index), body_text(pair.b.index),
               counted(static_cast<std::int64_t>(pair.impacts.size()), "impact"),
               pair.first_time <= 1.0 ? fmt::format("first at {:.6f}", pair.first_time) : "none of which stops");
  }
}

void TableReport::print_self(const Contact& contact) {
  fmt::print(out_, "  {}  with itself: {}, {}\n", body_text(contact.a.index),
             counted(static_cast<std::int64_t>(contact.facet_pairs().size()), "facet pair"),
             counted(static_cast<std::int64_t>(contact.points().size()), "contact point"));
}

void TableReport::print_pair(const CandidatePair& pair, const Contact* contact) {
  fmt::print(out_, "  {}  {}  ", body_text(pair.a.index), body_text(pair.b.index));
  if (contact == nullptr) {
    fmt::print(out_, "hulls apart\n");
    return;
  }
  const Eigen::Vector3d& n = contact->direction;
  fmt::print(out_, "hulls {} by {:<11.5g}  direction ({:8.5f}, {:8.5f}, {:8.5f})",
             pair.hulls_overlap ? "overlap" : "apart", std::abs(contact->depth), n.x(), n.y(), n.z());
  if (has_facets_) {
    fmt::print(out_, "  kept {:>6} + {:<6}  {}", contact->kept_facets_a, contact->kept_facets_b,
               counted(static_cast<std::int64_t>(contact->facet_pairs().size()), "facet pair"));
  }
  if (!contact->points().empty()) {
    fmt::print(out_, "  {}", counted(static_cast<std::int64_t>(contact->points().size()), "contact point"));
  }
  fmt::print(out_, "{}\n", contact->limit_reached ? "  (iteration limit reached)" : "");
}

void TableReport::note_contact(int frame, const Contact& contact, History& history) {
  if (history.last_overlap == frame - 1 && history.overlap_frames > 0) {
    history.largest_turn = std::max(history.largest_turn, degrees_between(history.last_direction, contact.direction));
  }
  if (history.first_overlap < 0) history.first_overlap = frame;
  ++history.overlap_frames;
  history.last_overlap = frame;
  history.last_direction = contact.direction;
  if (contact.touching()) {
    if (history.first_touching < 0) history.first_touching = frame;
    ++history.touching_frames;
  }
  if (history.deepest_frame < 0 || contact.depth > history.deepest) {
    history.deepest = contact.depth;
    history.deepest_frame = frame;
  }
}

void TableReport::print_history(const Pair& pair, const History& history) {
  fmt::print(out_, "  {}  {}  ", body_text(pair.first), body_text(pair.second));
  if (history.overlap_frames == 0) {
    fmt::print(out_, "hulls apart in all {}\n", counted(history.candidate_frames, "candidate frame"));
    return;
  }
  fmt::print(out_,
             "hulls overlap in {} from frame {}, deepest {:.5g} in frame {}, direction turns by up to {:.3g} degrees",
             counted(history.overlap_frames, "frame"), history.first_overlap, history.deepest, history.deepest_frame,
             history.largest_turn);
  if (has_facets_ && history.touching_frames == 0) fmt::print(out_, "; no facets meet");
  if (has_facets_ && history.touching_frames > 0) {
    fmt::print(out_, "; facets meet in {} from frame {}", counted(history.touching_frames, "frame"),
               history.first_touching);
  }
  fmt::print(out_, "\n");
}

void TableReport::finish() {
  if (frames_ > 1) {
    fmt::print(out_, "\nover {}: {}, {:.3f} ms a step\n", counted(frames_, "frame"),
               counted(static_cast<std::int64_t>(histories_.size()), "candidate pair"), total_ms_ / frames_);
    int lines = 0;
    for (const auto& [pair, history] : histories_) {
      if (++lines <= kMostPairLines) print_history(pair, history);
    }
    if (lines > kMostPairLines) fmt::print(out_, "      and {} more pairs (--json has all)\n", lines - kMostPairLines);
  }
  fmt::print(out_, "\nLengths are in metres; a direction points from the first body to the second.\n");
}

}  // namespace tact::scenes
