#include "bench/error/meshes.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <Eigen/LU>
#include <algorithm>

#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::bench {
namespace {

Mesh mesh_of(const WorkloadBody& body, int frame) { return {body.positions(frame), body.facets}; }

// Thinner than 1e-6 of its size in some direction.
bool is_flat(const Mesh& mesh) {
  const Eigen::Matrix3Xd centered = mesh.positions.colwise() - mesh.positions.rowwise().mean();
  const Eigen::Matrix3d moments = centered * centered.transpose();
  return moments.determinant() <= 1e-12 * std::pow(moments.trace(), 3.0);
}

MeshRow row_of(std::string name, Workload workload) {
  MeshRow row{std::move(name), std::move(workload), {}, {}};
  for (int frame = 0; frame < row.workload.frames; ++frame) {
    const Mesh a = mesh_of(row.workload.bodies[0], frame), b = mesh_of(row.workload.bodies[1], frame);
    row.meetings.emplace_back();
    for (const FacetPair& pair : facet_pairs_by_oracle(a, b)) row.meetings.back().push_back({0, 1, pair.a, pair.b});
    row.hulls.emplace_back();
    if (!is_flat(a) && !is_flat(b)) row.hulls.back() = {height_of(a, b), MinkowskiFaces(a, b)};
  }
  return row;
}

class TactMeshes : public HullRival {
 public:
  TactMeshes(const Workload& workload, const Settings& settings) : workload_(workload), world_(settings) {
    for (const WorkloadBody& body : workload.bodies) {
      ids_.push_back(world_.add_body({.positions = body.positions(0),
                                      .facets = body.facets,
                                      .surface = body.surface,
                                      .motion = body.fixed() ? Motion::fixed : Motion::deformable}));
    }
  }

  void step(int frame) override {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const WorkloadBody& body = workload_.bodies[i];
      if (!body.fixed()) world_.set_positions(ids_[i], body.positions(frame));
    }
    report_ = &world_.detect();
  }

  std::vector<FacetMeeting> meetings() const override {
    std::vector<FacetMeeting> all;
    for (const Contact& contact : report_->contacts()) {
      for (const FacetPair& pair : contact.facet_pairs()) all.push_back({0, 1, pair.a, pair.b});
    }
    return all;
  }

  HullAnswer hulls() const override {
    if (report_->contacts().empty()) return {};
    const Contact& contact = report_->contacts().front();
    return {true, contact.depth, contact.direction, contact.limit_reached};
  }

 private:
  const Workload& workload_;
  World world_;
  std::vector<BodyId> ids_;
  const Report* report_ = nullptr;
};

// CGAL alone: its boxes, its triangles, its exact predicates.
class CgalExact : public Rival {
 public:
  explicit CgalExact(const Workload& workload) : workload_(workload) {}

  void step(int frame) override {
    found_ = facet_pairs_by_oracle(mesh_of(workload_.bodies[0], frame), mesh_of(workload_.bodies[1], frame));
  }

  std::vector<FacetMeeting> meetings() const override {
    std::vector<FacetMeeting> all;
    for (const FacetPair& pair : found_) all.push_back({0, 1, pair.a, pair.b});
    return all;
  }

 private:
  const Workload& workload_;
  std::vector<FacetPair> found_;
};

const char* name(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::hulls: return "hulls";
    case Accuracy::paper: return "paper";
    case Accuracy::exact: break;
  }
  return "exact";
}

}  // namespace

std::vector<MeshRow> mesh_rows(bool quick) {
  const int frames = quick ? 6 : 40;
  std::vector<MeshRow> rows{
      row_of("organ and tool, 500 and 100 facets", organ_and_tool(frames)),
      row_of("cloth and sphere", cloth(quick ? 16 : 32, frames)),
      row_of("blobs of 1280 facets", large_pair(8, frames)),
  };
  return rows;
}

std::vector<MeshMethodKind> mesh_methods() {
  std::vector<MeshMethodKind> kinds;
  for (const Accuracy accuracy : {Accuracy::hulls, Accuracy::paper, Accuracy::exact}) {
    for (const DirectionPolicy policy : {DirectionPolicy::carried, DirectionPolicy::smallest}) {
      for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
        const bool carried = policy == DirectionPolicy::carried;
        const Settings settings{.threads = 1, .accuracy = accuracy, .direction = policy, .gjk_tolerance = tolerance};
        kinds.push_back(
            {"tact", fmt::format("{}, {}, {:.0e}", name(accuracy), carried ? "carried" : "smallest", tolerance),
             carried ? Minimum::local : Minimum::smallest, accuracy != Accuracy::hulls, true,
             [settings](const Workload& workload) { return std::make_unique<TactMeshes>(workload, settings); }});
      }
    }
  }
  kinds.push_back({"CGAL", "exact predicates", Minimum::smallest, true, false,
                   [](const Workload& workload) { return std::make_unique<CgalExact>(workload); }});
  for (const RivalKind& rival : all_rivals()) {
    const std::size_t comma = std::min(rival.name.find(", "), rival.name.size());
    const std::string setting = comma < rival.name.size() ? rival.name.substr(comma + 2) : "";
    kinds.push_back({rival.name.substr(0, comma), setting, Minimum::smallest, true, false,
                     [make = rival.make](const Workload& workload) { return make(workload, 1); }});
  }
  return kinds;
}

ErrorResult judge(const MeshRow& row, const MeshMethodKind& kind) {
  ErrorResult result{.row = row.name, .library = kind.library, .setting = kind.setting, .minimum = kind.minimum};
  HullErrors errors;
  const std::unique_ptr<Rival> method = kind.make(row.workload);
  const auto* hulls = dynamic_cast<const HullRival*>(method.get());
  for (int step = 0; step < steps_there_and_back(row.workload.frames); ++step) {
    const int frame = frame_of_step(step, row.workload.frames);
    method->step(frame);
    const auto at = static_cast<std::size_t>(frame);
    if (kind.pairs) {
      const std::vector<FacetMeeting> found = method->meetings(), &expected = row.meetings[at];
      std::vector<FacetMeeting> both;
      std::ranges::set_intersection(expected, found, std::back_inserter(both));
      result.missed += static_cast<int>(expected.size() - both.size());
      result.wrong += static_cast<int>(found.size() - both.size());
      result.queries += static_cast<int>(expected.size());
    }
    if (kind.depth && row.hulls[at]) {
      ErrorResult of_hulls;
      errors.judge(hulls->hulls(), kind.minimum, row.hulls[at]->faces, row.hulls[at]->height, Eigen::Vector3d::Zero(),
                   of_hulls);
      result.failed += of_hulls.failed + of_hulls.missed + of_hulls.wrong;
    }
  }
  errors.summarize(result);
  return result;
}

std::vector<double> measure(const MeshRow& row, const std::vector<MeshMethodKind>& kinds, double seconds) {
  std::vector<std::unique_ptr<Rival>> methods;
  for (const MeshMethodKind& kind : kinds) methods.push_back(kind.make(row.workload));
  return median_step_times(methods, row.workload.frames, seconds);
}

}  // namespace tact::bench
