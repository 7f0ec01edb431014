#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"
#include "scenes/library/smooth_step.h"

namespace tact::scenes {
namespace {

// A membrane between two jaws is cut along a moving blade and tears under its weight; its flaps come to rest on the
// organ below, and a thread is pulled down through the cut.
struct Surgery {
  double side = 1.0, height = 0.5;           // of the membrane; above the organ's middle, metres
  double radius = 0.36;                      // of the organ, metres
  double first_cut = 0.2;                    // seconds
  double cut_time = 0.9;                     // from the first cut to the last, seconds
  double cut_share = 0.8;                    // of the vertices of the middle row; the rest tears
  double tears = 1.01;                       // an edge at the tip breaks where it is so many times as long
  double pull_begin = 1.2, pull_time = 1.0;  // of the thread, seconds
  int thread_vertices = 24;
  double thread_length = 0.5, thread_y = -0.44;  // metres
  double thread_height = 0.1;                    // of its lower end above the membrane at first, metres
  ClothMaterial membrane{.density = 0.4, .bend_stiffness = 0.2, .friction = 0.4, .drag = 1.5, .thickness = 0.003};
  RopeMaterial thread{.density = 0.01, .stretch_stiffness = 500.0, .friction = 0.2, .thickness = 0.002};
  RigidMaterial organ{.friction = 0.4, .thickness = 0.003};
  DynamicsSettings dynamics{.time_step = 1.0 / 120.0, .substeps = 8, .guarded = true, .margin = 0.0005};
};

// What the script remembers of the membrane: each vertex that was doubled stands where its twin was made.
struct Cut {
  Surgery p;
  int across;  // vertices along a side
  Mesh rest;
  std::vector<int> origin = {};     // of each vertex the place in the grid that it was made at, row by row
  std::vector<int> vertex_at = {};  // of each place the first vertex
  int made = 0;                     // vertices of the middle column that have doubles, from the first on

  Cut(const Surgery& surgery, int size, Mesh sheet)
      : p(surgery), across(size), rest(std::move(sheet)), vertex_at(rest.positions.size()) {
    const auto step = [&](double x) { return static_cast<int>(std::lround((x / p.side + 0.5) * (across - 1))); };
    for (const Vec3& at : rest.positions) {
      origin.push_back(step(at.y) * across + step(at.x));
      vertex_at[static_cast<std::size_t>(origin.back())] = static_cast<int>(origin.size()) - 1;
    }
  }

  int middle() const { return across / 2; }
  bool is_held(int v) const { return origin[static_cast<std::size_t>(v)] % across % (across - 1) == 0; }
  int tip() const { return vertex_at[static_cast<std::size_t>(made * across + middle())]; }

  // Springs and masses are those of a cloth of the facets that there are now.
  void renew(Body& body) const {
    Body cut = make_cloth(body.name, rest, p.membrane);
    body.facets = rest.facets;
    body.surface_edges = std::move(cut.surface_edges);
    body.springs = std::move(cut.springs);
    body.inverse_masses = std::move(cut.inverse_masses);
    for (int v = 0; v < static_cast<int>(origin.size()); ++v) {
      if (is_held(v)) body.inverse_masses[static_cast<std::size_t>(v)] = 0.0;
    }
  }

  // The next vertex of the middle column has a double, which the facets on its right take.
  void cut_once(Body& body) {
    const auto at = static_cast<std::size_t>(tip());
    const auto twin = static_cast<int>(origin.size());
    body.vertex_map.resize(origin.size());
    for (std::size_t v = 0; v < origin.size(); ++v) body.vertex_map[v] = static_cast<int>(v);
    body.vertex_map.push_back(static_cast<int>(at));
    origin.push_back(origin[at]);
    rest.positions.push_back(rest.positions[at]);
    body.positions.push_back(Vec3(body.positions[at]));
    body.velocities.push_back(Vec3(body.velocities[at]));
    for (auto facet : rest.facets.colwise()) {
      const bool is_right =
          std::ranges::any_of(facet, [&](int v) { return origin[static_cast<std::size_t>(v)] % across > middle(); });
      for (int& v : facet) v = is_right && v == static_cast<int>(at) ? twin : v;
    }
    ++made;
    renew(body);
    body.asleep = false;
  }

  // Whether an edge at the tip of the cut is stretched too far.
  bool is_torn(const Body& body) const {
    for (const Edge& edge : body.surface_edges) {
      if (edge.from != tip() && edge.to != tip()) continue;
      const auto length = [&](const std::vector<Vec3>& at) { return norm(at[edge.to] - at[edge.from]); };
      if (length(body.positions) > p.tears * length(rest.positions)) return true;
    }
    return false;
  }

  void move(double time, Body& body) {
    const int by_blade = static_cast<int>(p.cut_share * across);
    if (!body.vertex_map.empty() || made >= across) return;
    const bool blade = made < by_blade && time >= p.first_cut + p.cut_time * made / by_blade;
    if (blade || (made >= by_blade && is_torn(body))) cut_once(body);
  }
};

}  // namespace

Scene make_surgery(int size) {
  const Surgery p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.dynamics.substeps = std::max(p.dynamics.substeps, size / 3);
  scene.view = {.azimuth = 55.0, .elevation = 24.0};
  scene.shown = base::Box{{-0.6, -0.6, -0.3}, {0.6, 0.6, 0.7}};
  Mesh sheet = moved(grid_sheet(size, size, p.side, p.side), {0.0, 0.0, p.height});
  const auto cut = std::make_shared<Cut>(p, size, sheet);
  Body membrane = make_cloth("membrane", sheet, p.membrane);
  membrane.self_contact = true;
  cut->renew(membrane);
  scene.add(std::move(membrane));
  scene.add(make_rigid("organ", sphere(4, p.radius), p.organ, Motion::fixed));
  for (const double side : {-1.0, 1.0}) {
    const double inner = side * (0.5 * p.side + 0.01), outer = side * (0.5 * p.side + 0.06);
    const Mesh jaw = box({std::min(inner, outer), -0.5 * p.side, p.height - 0.02},
                         {std::max(inner, outer), 0.5 * p.side, p.height + 0.02}, 0.2);
    scene.add(make_rigid(side < 0.0 ? "left jaw" : "right jaw", jaw, p.organ, Motion::fixed));
  }
  std::vector<Vec3> line;
  Eigen::Matrix2Xi edges(2, p.thread_vertices - 1);
  for (int k = 0; k < p.thread_vertices; ++k) {
    line.push_back({0.0, p.thread_y, p.height + p.thread_height + p.thread_length * k / (p.thread_vertices - 1)});
    if (k > 0) edges.col(k - 1) << k - 1, k;
  }
  const Vec3 end = line.front();
  Body thread = make_ropes("thread", std::move(line), edges, p.thread);
  thread.inverse_masses.front() = thread.inverse_masses.back() = 0.0;
  scene.add(std::move(thread));
  scene.script = [p, cut, end](double time, std::vector<Body>& bodies) {
    cut->move(time, bodies[0]);
    Body& rope = bodies[4];
    if (time < p.pull_begin + p.pull_time) rope.asleep = false;
    const double way = (p.thread_height + 0.75 * p.thread_length) * smooth_step((time - p.pull_begin) / p.pull_time);
    if (way > 0.0) rope.inverse_masses.back() = 1.0 / (p.thread.density * p.thread_length / p.thread_vertices);
    rope.positions.front() = end - Vec3{0.0, 0.0, way};
  };
  return scene;
}

}  // namespace tact::scenes
