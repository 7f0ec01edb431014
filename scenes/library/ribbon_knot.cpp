#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"
#include "scenes/library/smooth_step.h"

namespace tact::scenes {
namespace {

struct RibbonKnot {
  double width = 0.028;          // metres: the curve comes as near to itself as 0.056
  int across = 4;                // vertices across
  double end = 2.05;             // the curve runs from -end to end
  Vec3 scale{0.045, 0.1, 0.16};  // of the curve, metres
  double height = 1.0;           // of the ends, metres
  double begin = 0.2;            // of the pull, seconds
  double pull_time = 8.0;        // seconds
  double pull = 1.3;             // of either end, metres
  double weight = 0.02;          // share of gravity: else the knot slides down while the ribbon is slack
  ClothMaterial ribbon{.density = 0.3,
                       .stretch_stiffness = 3000.0,
                       .bend_stiffness = 0.3,
                       .friction = 0.25,
                       .drag = 2.0,
                       .thickness = 0.0015};
  DynamicsSettings dynamics{.time_step = 1.0 / 120.0,
                            .substeps = 8,
                            .least_reach = 0.0005,
                            .most_reach = 0.002,
                            .guarded = true,
                            .margin = 0.0002};
};

// A trefoil knot whose ends run to infinity, here along x. Source: A. R. Shastri, Polynomial representations of knots,
// Tôhoku Mathematical Journal 44, 1992.
Vec3 knot(const RibbonKnot& p, double t) {
  const double square = t * t;
  return {p.scale.x * t * (square * square - 10.0), p.scale.y * square * (square - 4.0),
          p.scale.z * t * (square - 3.0)};
}

// `count` places along the knot, one as far from the next as all.
std::vector<Vec3> places_along(const RibbonKnot& p, int count) {
  constexpr int kParts = 20000;
  std::vector<double> lengths{0.0};
  for (int i = 1; i <= kParts; ++i) {
    const double t = p.end * (2.0 * i / kParts - 1.0), last = p.end * (2.0 * (i - 1) / kParts - 1.0);
    lengths.push_back(lengths.back() + norm(knot(p, t) - knot(p, last)));
  }
  std::vector<Vec3> places;
  for (int k = 0; k < count; ++k) {
    const double wanted = lengths.back() * k / (count - 1);
    const auto at = std::lower_bound(lengths.begin(), lengths.end(), wanted) - lengths.begin();
    places.push_back(knot(p, p.end * (2.0 * static_cast<double>(at) / kParts - 1.0)));
  }
  return places;
}

// The row of each vertex of a flat strip of length 1 along y, 0 to along - 1.
std::vector<std::size_t> rows_of(const Mesh& strip, int along) {
  std::vector<std::size_t> rows;
  for (const Vec3& q : strip.positions)
    rows.push_back(static_cast<std::size_t>(std::lround((q.y + 0.5) * (along - 1))));
  return rows;
}

// A strip around the curve whose width turns as little as can be: it is carried along from place to place.
void lay_along(const RibbonKnot& p, const std::vector<std::size_t>& rows, int along, Mesh& strip) {
  const std::vector<Vec3> places = places_along(p, along);
  std::vector<Vec3> wide;
  Vec3 last{0.0, 1.0, 0.0};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vec3 way = normalized(places[std::min(k + 1, places.size() - 1)] - places[k > 0 ? k - 1 : 0]);
    wide.push_back(last = normalized(last - dot(last, way) * way));
  }
  for (std::size_t v = 0; v < rows.size(); ++v)
    strip.positions[v] = places[rows[v]] + strip.positions[v].x * wide[rows[v]] + Vec3{0.0, 0.0, p.height};
}

}  // namespace

// A loose overhand knot in a ribbon is pulled tight by its ends.
Scene make_ribbon_knot(int size) {
  const RibbonKnot p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.view = {.azimuth = 20.0, .elevation = 15.0};
  scene.shown = base::Box{{-0.8, -0.4, 0.55}, {0.8, 0.1, 1.4}};
  Mesh strip = grid_sheet(p.across, size, p.width, 1.0);
  const std::vector<std::size_t> rows = rows_of(strip, size);
  lay_along(p, rows, size, strip);
  Body body = make_cloth("ribbon", strip, p.ribbon);
  body.self_contact = true;
  body.weight = p.weight;
  const std::vector<Vec3> rest = body.positions;
  // Two rows at either end are held: -1 goes against x, 1 along it.
  std::vector<std::pair<std::size_t, double>> held;
  for (std::size_t v = 0; v < rows.size(); ++v) {
    const bool first = rows[v] < 2, last = rows[v] + 2 >= static_cast<std::size_t>(size);
    if (!first && !last) continue;
    held.emplace_back(v, rest[v].x < 0.0 ? -1.0 : 1.0);
    body.inverse_masses[v] = 0.0;
  }
  scene.add(std::move(body));
  scene.script = [p, rest, held](double time, std::vector<Body>& bodies) {
    if (time <= p.begin + p.pull_time) bodies[0].asleep = false;
    const Vec3 way{p.pull * smooth_step((time - p.begin) / p.pull_time), 0.0, 0.0};
    for (const auto& [v, side] : held) bodies[0].positions[v] = rest[v] + side * way;
  };
  return scene;
}

}  // namespace tact::scenes
