#include "scenes/view/view_page.h"

#include <fmt/format.h>
#include <tact/report_arrays.h>
#include <tact/version.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/facet_outcomes.h"
#include "scenes/commands/json_text.h"
#include "scenes/commands/report_json.h"
#include "scenes/commands/skipped_work.h"
#include "scenes/dynamics/stats_sum.h"
#include "scenes/files/file_error.h"
#include "scenes/view/page_section.h"
#include "scenes/view/page_template.h"
#include "scenes/view/view_contacts.h"

namespace tact::scenes {
namespace {

// A chunk is what the page unpacks at a time: large enough to compress well, and done in some hundredths of a second.
constexpr std::size_t kChunkBytes = std::size_t{2} << 20;
constexpr int kFormat = 5;
constexpr double kMegabyte = 1e6;

Json settings_json(const Settings& settings, bool few_points) {
  return {{"accuracy", accuracy_name(settings.accuracy)},
          {"direction", settings.direction == DirectionPolicy::carried ? "carried" : "smallest"},
          {"threads", settings.threads},
          {"zones", settings.outputs.zones || settings.accuracy == Accuracy::paper},
          {"patches", settings.outputs.patches},
          {"points", settings.outputs.points},
          {"curves", settings.outputs.curves},
          {"few_points", few_points},
          {"outcomes", settings.accuracy != Accuracy::hulls}};
}

Json bodies_json(const std::vector<ViewedBody>& bodies, int frames) {
  Json list = Json::array();
  for (const ViewedBody& body : bodies) {
    Json& one = list.emplace_back(Json{{"name", body.name},
                                       {"vertices", body.vertex_count()},
                                       {"facets", body.facets.cols()},
                                       {"surface", surface_name(body.surface)},
                                       {"fixed", body.motion == Motion::fixed},
                                       {"opacity", body.opacity},
                                       {"step", body.step()},
                                       {"origin", body.origin()},
                                       {"first", body.first_frame},
                                       {"end", std::min(body.end_frame, frames)},
                                       {"cut_off", body.cut_off}});
    const ThinParts& thin = body.thin;
    if (thin.edges.cols() > 0) {
      for (const int end : thin.edges.reshaped()) one["edges"].push_back(end);
    }
    if (!thin.points.empty()) one["points"] = thin.points;
    if (thin.plane) {
      const Eigen::Vector3d& n = thin.plane->normal;
      one["plane"] = {n.x(), n.y(), n.z(), thin.plane->offset};
    }
  }
  return list;
}

// Every count and time: its name, what it says, and its value in each frame.
Json statistics_json(const std::vector<StepStats>& stats) {
  Json counts = Json::array(), times = Json::array();
  const auto column = [](const char* name, const char* text) {
    return Json{{"name", name}, {"text", text}, {"values", Json::array()}};
  };
  for_each_count(StepStats{}, [&](const char* name, const char* text, auto) { counts.push_back(column(name, text)); });
  for_each_time(StepStats{}, [&](const char* name, const char* text, auto) { times.push_back(column(name, text)); });
  for (const StepStats& one : stats) {
    std::size_t i = 0, k = 0;
    for_each_count(one, [&](const char*, const char*, std::int64_t n) { counts[i++]["values"].push_back(n); });
    for_each_time(one, [&](const char*, const char*, double ms) { times[k++]["values"].push_back(ms); });
  }
  return {{"counts", counts}, {"times", times}};
}

Json ledger_json(const StepStats& sums, const Settings& settings) {
  Json lines = Json::array();
  for (const SkippedWork& line : skipped_work(sums, settings)) {
    const std::optional<double> ms = line.ms();
    lines.push_back({{"what", line.what},
                     {"count", line.count},
                     {"why", line.why},
                     {"ms", ms ? Json(*ms) : Json(nullptr)},
                     {"measured_on", line.measured_on}});
  }
  return lines;
}

Json column_json(const std::vector<std::optional<double>>& values) {
  Json column = Json::array();
  for (const std::optional<double>& value : values) column.push_back(value ? Json(*value) : Json(nullptr));
  return column;
}

Eigen::Matrix3Xi facets_of(const World& world, BodyId id) {
  Eigen::Matrix3Xi facets(3, static_cast<Eigen::Index>(world.facet_count(id)));
  world.copy_facets(id, {facets.data(), static_cast<std::size_t>(facets.size())});
  return facets;
}

ThinParts thin_parts_of(const World& world, BodyId id) {
  ThinParts thin{.edges = Eigen::Matrix2Xi(2, static_cast<Eigen::Index>(world.edge_count(id))),
                 .points = std::vector<int>(world.point_count(id)),
                 .plane = world.plane(id)};
  world.copy_edges(id, {thin.edges.data(), static_cast<std::size_t>(thin.edges.size())});
  world.copy_points(id, thin.points);
  return thin;
}

bool has_thin_parts_of(const World& world, const ViewedBody& body) {
  const auto& [edges, points, plane] = body.thin;
  if (edges.cols() != static_cast<Eigen::Index>(world.edge_count(body.id)) ||
      points.size() != world.point_count(body.id))
    return false;
  const ThinParts now = thin_parts_of(world, body.id);
  return edges == now.edges && points == now.points;
}

bool has_facets_of(const World& world, const ViewedBody& body) {
  return body.vertex_count() == world.vertex_count(body.id) &&
         static_cast<std::size_t>(body.facets.cols()) == world.facet_count(body.id) &&
         body.facets == facets_of(world, body.id) && has_thin_parts_of(world, body);
}

std::optional<double> least_gap(const Report& report) {
  std::optional<double> least;
  for (const Contact& contact : report.contacts()) {
    for (const ContactPoint& point : contact.points()) least = std::min(least.value_or(point.gap), point.gap);
  }
  return least;
}

}  // namespace

ViewPage::ViewPage(const ViewOptions& options, ViewTitle title, std::ostream& standard_output)
    : options_(options), title_(std::move(title)), file_(options.file, standard_output) {
  const std::string_view before = page_template().before;
  file_.stream() << before;
  written_ = static_cast<std::int64_t>(before.size() + page_template().after.size());
}

void ViewPage::add_body(const World& world, BodyId id, double opacity) {
  const Eigen::Matrix3Xi facets = facets_of(world, id);
  if (place_of_slot_.size() <= id.index) place_of_slot_.resize(id.index + 1);
  place_of_slot_[id.index] = bodies_.size();
  bodies_.emplace_back(id,
                       BodyForView{.name = world.name(id),
                                   .surface = world.surface(id),
                                   .motion = world.motion(id),
                                   .opacity = opacity,
                                   .positions = positions_,
                                   .facets = facets,
                                   .thin = thin_parts_of(world, id)},
                       frames());
}

// Bodies that were added and removed, and the positions of all, before a frame. One whose facets changed is another
// body from there on.
void ViewPage::follow_bodies(const World& world) {
  for (ViewedBody& body : bodies_) {
    if (body.end_frame > frames() && !world.contains(body.id)) body.end_frame = frames();
  }
  for (const BodyId id : world.bodies()) {
    positions_.resize(3, static_cast<Eigen::Index>(world.vertex_count(id)));
    world.copy_positions(id, {positions_.data(), static_cast<std::size_t>(positions_.size())});
    positions_ = positions_.unaryExpr([](double x) { return std::isnan(x) ? 0.0 : x; });  // vertices that no facet uses
    const bool known = id.index < place_of_slot_.size() && !bodies_.empty() && bodies_[place_of(id)].id == id;
    ViewedBody* const last = known ? &bodies_[place_of(id)] : nullptr;
    if (last != nullptr && has_facets_of(world, *last)) {
      last->set_positions(positions_);
    } else if (last != nullptr) {
      last->end_frame = frames();
      add_body(world, id, last->opacity);
    } else {
      add_body(world, id, bodies_.size() < opacities_.size() ? opacities_[bodies_.size()] : 1.0);
    }
  }
}

bool ViewPage::shows(int step) const {
  return step >= options_.from && step <= options_.to && (step - options_.from) % options_.every == 0;
}

void ViewPage::add_step(int step, std::optional<double> time, const World& world, const Report& report) {
  settings_ = world.settings();
  add_to(sums_, report.stats());
  ++steps_;
  if (!shows(step)) return;
  follow_bodies(world);
  note_clusters(report, report.stats().regrouped_bodies > 0);
  columns_.step.push_back(step);
  columns_.time.push_back(time);
  columns_.hash.push_back(hash_text(report));
  columns_.points.push_back(static_cast<std::int64_t>(point_count(report)));
  columns_.least_gap.push_back(least_gap(report));
  columns_.stats.push_back(report.stats());
  write_frame(report);
}

// Of new bodies, and where facets were grouped anew; of all bodies also after steps that were left out.
void ViewPage::note_clusters(const Report& report, bool all) {
  const FacetOutcomeFinder finder(report);
  all = all || options_.every > 1;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    ViewedBody& body = bodies_[i];
    if (body.end_frame <= frames() || (!all && !body.clusters.empty())) continue;
    std::vector<int> clusters = finder.clusters(body.id);
    if (clusters == body.clusters) continue;
    body.clusters = clusters;
    groupings_.push_back({i, frames(), std::move(clusters)});
  }
}

void ViewPage::write_frame(const Report& report) {
  if (chunks_.empty() || chunk_.size() == 0) {
    chunks_.push_back({.first = frames() - 1});
    for (ViewedBody& body : bodies_) body.begin_chunk();
  }
  for (ViewedBody& body : bodies_) {
    if (body.end_frame > frames() - 1) body.write(chunk_);
  }
  ViewBytes contacts;
  write_contacts(
      report, [this](BodyId id) { return place_of(id); },
      options_.few_points ? PointsInView::spanning : PointsInView::all, contacts);
  chunk_.add_part(contacts);
  ++chunks_.back().count;
  if (chunk_.size() >= kChunkBytes) end_chunk();
}

void ViewPage::end_chunk() {
  if (chunk_.size() == 0) return;
  chunks_.back().bytes = static_cast<std::int64_t>(chunk_.size());
  written_ += write_packed_section(file_.stream(), fmt::format("tact-chunk-{}", chunks_.size() - 1), chunk_.bytes());
  chunk_.clear();
  check_size();
}

void ViewPage::check_size() const {
  if (static_cast<double>(written_) <= options_.largest * kMegabyte) return;
  throw FileError(
      fmt::format("{}: the page would be larger than {} MB after {} of the steps it shows: leave steps out with "
                  "--every, --from and --to, contact points with --few-points, or allow more with --largest",
                  options_.file, options_.largest, frames()));
}

// The facets of all bodies, then the clusters wherever they changed: neighbours in the list have near numbers.
void ViewPage::write_meshes() {
  ViewBytes out;
  for (const ViewedBody& body : bodies_) {
    int last = 0;
    for (const int corner : body.facets.reshaped()) {
      out.add_signed(corner - last);
      last = corner;
    }
  }
  out.add_count(groupings_.size());
  for (const Grouping& grouping : groupings_) {
    out.add_count(grouping.body);
    out.add_count(static_cast<std::uint64_t>(grouping.frame));
    int last = 0;
    for (const int cluster : grouping.clusters) {
      out.add_signed(cluster - last);
      last = cluster;
    }
  }
  written_ += write_packed_section(file_.stream(), "tact-meshes", out.bytes());
}

void ViewPage::write_head(Ending ending) {
  Json chunks = Json::array();
  for (const Chunk& chunk : chunks_)
    chunks.push_back({{"first", chunk.first}, {"count", chunk.count}, {"bytes", chunk.bytes}});
  const Json head = {{"format", kFormat},
                     {"tact", TACT_VERSION},
                     {"title", title_.name},
                     {"kind", title_.kind},
                     {"settings", settings_json(settings_, options_.few_points)},
                     {"steps", steps_},
                     {"interrupted", ending == Ending::interrupted},
                     {"bodies", bodies_json(bodies_, frames())},
                     {"frames",
                      {{"step", columns_.step},
                       {"time", column_json(columns_.time)},
                       {"hash", columns_.hash},
                       {"points", columns_.points},
                       {"least_gap", column_json(columns_.least_gap)}}},
                     {"statistics", statistics_json(columns_.stats)},
                     {"ledger", ledger_json(sums_, settings_)},
                     {"chunks", chunks}};
  written_ += write_json_section(file_.stream(), "tact-head", json_text(head));
}

void ViewPage::finish(Ending ending) {
  if (frames() == 0) throw FileError(fmt::format("{}: the page would show no step, of {}", options_.file, steps_));
  end_chunk();
  write_meshes();
  write_head(ending);
  check_size();
  file_.stream() << page_template().after;
  file_.finish();
}

std::string ViewPage::summary() const {
  return fmt::format("{}: {} step{}, {:.1f} MB", options_.file, frames(), frames() == 1 ? "" : "s",
                     static_cast<double>(written_) / kMegabyte);
}

}  // namespace tact::scenes
