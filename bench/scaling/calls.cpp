#include "bench/scaling/calls.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/random.h"
#include "bench/table.h"
#include "bench/workloads/shapes.h"

namespace tact::bench {
namespace {

// A layer of boxes, each of which touches its neighbours.
class Layer {
 public:
  explicit Layer(int count) : side_(static_cast<int>(std::sqrt(count))), others_(Random(91).permutation(count)) {}

  void add(std::size_t i) {
    bodies_.resize(others_.size());
    bodies_[i] = world.add_body({.positions = place(i), .facets = box_.facets, .margin = 0.01});
  }
  void remove(std::size_t i) { world.remove_body(bodies_[i]); }
  BodyId body(std::size_t i) const { return bodies_[i]; }
  // Some other body.
  BodyId other(std::size_t i) const {
    return bodies_[static_cast<std::size_t>(others_[i]) == i ? (i + 1) % size() : others_[i]];
  }
  std::size_t size() const { return others_.size(); }
  Eigen::Matrix3Xd place(std::size_t i) const {
    const auto n = static_cast<int>(i);
    return box_.positions.colwise() + Eigen::Vector3d(n % side_, n / side_, 0.0);
  }
  const Shape& box() const { return box_; }

  World world{{.threads = 1, .outputs = {.points = true}}};

 private:
  int side_;
  Shape box_ = brick({0, 0, 0}, {1, 1, 1});
  std::vector<int> others_;
  std::vector<BodyId> bodies_;
};

struct Call {
  const char* name;
  void (*make)(Layer& layer, std::size_t i);
};

const std::array<std::uint32_t, 8> kLabels{1, 1, 1, 1, 2, 2, 2, 2};
const std::array<int, 8> kSameVertices{0, 1, 2, 3, 4, 5, 6, 7};

// In this order; a step follows each.
constexpr std::array kCalls{
    Call{"add_body", [](Layer& l, std::size_t i) { l.add(i); }},
    Call{"set_positions", [](Layer& l, std::size_t i) { l.world.set_positions(l.body(i), l.place(i)); }},
    Call{"set_margin", [](Layer& l, std::size_t i) { l.world.set_margin(l.body(i), 0.02); }},
    Call{"set_layers", [](Layer& l, std::size_t i) { l.world.set_layers(l.body(i), 2, 3); }},
    Call{"set_excluded", [](Layer& l, std::size_t i) { l.world.set_excluded(l.body(i), l.other(i), true); }},
    Call{"set_feature_settings",
         [](Layer& l, std::size_t i) { l.world.set_feature_settings(l.body(i), {.vertex_labels = kLabels}); }},
    Call{"set_excluded_labels",
         [](Layer& l, std::size_t i) {
           l.world.set_excluded_labels({l.body(i), 1, l.other(i), 2, LabelKind::vertex}, true);
         }},
    Call{"set_facets",
         [](Layer& l, std::size_t i) { l.world.set_facets(l.body(i), l.place(i), l.box().facets, kSameVertices); }},
    Call{"remove_body, add_body",
         [](Layer& l, std::size_t i) {
           l.remove(i);
           l.add(i);
         }},
    Call{"remove_body", [](Layer& l, std::size_t i) { l.remove(i); }},
};

}  // namespace

int run_calls(const BenchOptions& options) {
  std::vector<double> sizes;
  std::vector<std::string> header{"microseconds of a call"};
  for (const int side : {20, 40, 80, 160}) {
    if (options.quick && side > 40) break;
    sizes.push_back(side * side);
    header.push_back(fmt::format("{} bodies", side * side));
  }
  header.emplace_back("exponent");
  std::array<std::vector<double>, kCalls.size()> us;
  for (const double size : sizes) {
    Layer layer(static_cast<int>(size));
    for (std::size_t k = 0; k < kCalls.size(); ++k) {
      const double ms = time_ms(1, 1.0, [&] {
        for (std::size_t i = 0; i < layer.size(); ++i) kCalls[k].make(layer, i);
      });
      us[k].push_back(1e3 * ms / size);
      layer.world.detect();
    }
  }
  Table table(header);
  for (std::size_t k = 0; k < kCalls.size(); ++k) {
    std::vector<std::string> row{kCalls[k].name};
    for (const double one : us[k]) row.push_back(three_digits(one));
    row.push_back(fmt::format("{:.2f}", fitted_exponent(sizes, us[k])));
    table.add(row);
  }
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "calls.csv");
  return 0;
}

}  // namespace tact::bench
