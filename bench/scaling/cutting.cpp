#include "bench/scaling/cutting.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "bench/measure.h"
#include "bench/workloads/shapes.h"

namespace tact::bench {
namespace {

enum class Numbering { kept, backwards };

// A sheet that is cut along columns of vertices.
class CutSheet {
 public:
  explicit CutSheet(int cells) : shape_(square_sheet(cells, 1.0)) {
    was_.resize(static_cast<std::size_t>(shape_.positions.cols()));
    std::iota(was_.begin(), was_.end(), 0);
    column_ = was_;
    for (int& vertex : column_) vertex %= cells + 1;
  }

  const Shape& shape() const { return shape_; }
  // Of the last cut, as World::set_facets() takes it.
  const std::vector<int>& vertex_map() const { return was_; }

  // Doubles vertices of a column; facets that also have one of the next column take the doubles.
  void cut(int column, int vertices, Numbering numbering) {
    const auto count = static_cast<int>(shape_.positions.cols());
    was_.resize(static_cast<std::size_t>(count));
    std::iota(was_.begin(), was_.end(), 0);
    std::vector<int> doubles(static_cast<std::size_t>(count), -1);
    for (int v = 0; v < count && vertices > 0; ++v) {
      if (column_[v] != column) continue;
      doubles[v] = static_cast<int>(was_.size());
      was_.push_back(v);
      --vertices;
    }
    shape_.positions.conservativeResize(3, static_cast<Eigen::Index>(was_.size()));
    for (std::size_t v = static_cast<std::size_t>(count); v < was_.size(); ++v) {
      shape_.positions.col(static_cast<Eigen::Index>(v)) = shape_.positions.col(was_[v]);
      column_.push_back(column);
    }
    for (auto facet : shape_.facets.colwise()) {
      const bool beyond = std::any_of(facet.begin(), facet.end(), [&](int v) { return column_[v] == column + 1; });
      for (int& v : facet) v = beyond && doubles[v] >= 0 ? doubles[v] : v;
    }
    if (numbering == Numbering::backwards) turn_round();
  }

 private:
  void turn_round() {
    const auto last = static_cast<int>(was_.size()) - 1;
    std::ranges::reverse(was_);
    std::ranges::reverse(column_);
    shape_.positions = shape_.positions.rowwise().reverse().eval();
    shape_.facets = (last - shape_.facets.rowwise().reverse().array()).matrix().eval();
  }

  Shape shape_;
  std::vector<int> was_, column_;
};

struct Times {
  std::vector<double> positions, facets, step, step_after;
};

Times measure(int cells, Numbering numbering, int cuts) {
  CutSheet sheet(cells);
  const Shape ground = square_sheet(2, 2.0);
  Settings settings{.threads = 1};
  settings.outputs.points = true;
  World world(settings);
  const auto lifted = [&](int step) {
    Eigen::Matrix3Xd positions = sheet.shape().positions;
    positions.row(2).array() += 0.001 + 1e-6 * step;
    return positions;
  };
  const BodyId body = world.add_body(
      {.positions = lifted(0), .facets = sheet.shape().facets, .surface = Surface::sheet, .margin = 0.001});
  world.add_body({.positions = ground.positions,
                  .facets = ground.facets,
                  .surface = Surface::sheet,
                  .motion = Motion::fixed,
                  .margin = 0.001});
  Times times;
  world.detect();
  const auto add = [](std::vector<double>& to, const auto& work) { to.push_back(time_ms(1, 1.0, work)); };
  for (int cut = 0; cut < cuts; ++cut) {
    for (int step = 1; step < 4; ++step) {
      const Eigen::Matrix3Xd positions = lifted(step);
      add(times.positions, [&] { world.set_positions(body, positions); });
      add(times.step, [&] { world.detect(); });
    }
    // Three facets a vertex take its double.
    sheet.cut(1 + cut * (cells - 2) / cuts, 2 * cells * cells / 300, numbering);
    const Eigen::Matrix3Xd positions = lifted(0);
    add(times.facets, [&] { world.set_facets(body, positions, sheet.shape().facets, sheet.vertex_map()); });
    add(times.step_after, [&] { world.detect(); });
  }
  return times;
}

}  // namespace

Table measure_cutting(bool quick) {
  Table table({"cut", "set_positions", "set_facets", "to set_positions", "step", "step after", "to step"});
  const int cells = quick ? 50 : 224;
  for (const Numbering numbering : {Numbering::kept, Numbering::backwards}) {
    const Times times = measure(cells, numbering, quick ? 3 : 12);
    const double positions = median(times.positions), facets = median(times.facets), step = median(times.step),
                 after = median(times.step_after);
    table.add({fmt::format("up to 1 % of a sheet of {} facets, {}", 2 * cells * cells,
                           numbering == Numbering::kept ? "numbers kept" : "numbered backwards"),
               three_digits(positions), three_digits(facets), fmt::format("{:.1f}", facets / positions),
               three_digits(step), three_digits(after), fmt::format("{:.2f}", after / step)});
  }
  return table;
}

}  // namespace tact::bench
