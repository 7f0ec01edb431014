// Three soft cubes, a thin cloth over them, a rigid box on top: played by Bullet with its own contacts of soft bodies,
// and with tact's in their place. Prints what came of it.
//
//   example_bullet [--steps N] [--pictures FOLDER]
//
// Leaves with status 0 if with tact all bodies stack and rest, 1 if not, 2 if it was called wrongly.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "film.h"
#include "measure.h"
#include "scene.h"

namespace {

using example::Contacts;
using example::Measured;

struct Options {
  int steps = 480;
  std::string pictures;  // empty: none
};

struct Way {
  Contacts contacts;
  const char* name;
};

constexpr Way kWays[] = {{Contacts::bullet_vertices, "Bullet, vertices"},
                         {Contacts::bullet_clusters, "Bullet, clusters"},
                         {Contacts::tact, "tact"}};

Measured play(const Way& way, const Options& options, example::Film& film) {
  using Clock = std::chrono::steady_clock;
  example::Scene scene(way.contacts);
  example::Measure measure(scene);
  film.begin(way.name);
  for (int i = 0; i < options.steps; ++i) {
    film.look(scene, i);
    const Clock::time_point start = Clock::now();
    scene.step();
    measure.look(scene, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  film.look(scene, options.steps);
  return measure.result(scene);
}

void print(const char* name, const Measured& m) {
  std::printf("%-18s %9.1f %9lld %9.3f %9.3f %12.2e %11.2f %8.2f\n", name, 1e3 * m.deepest,
              static_cast<long long>(m.crossings), m.box_height, m.cloth_height, m.moving, m.gained, m.step_ms);
}

// Is everything where a stack has it: nothing crosses, the box lies on the cloth on three cubes, and all is at rest?
bool rests(const Measured& m) {
  const double height = example::kCubes * example::kCubeSide + example::kBoxSide / 2;
  return m.deepest == 0.0 && m.crossings == 0 && std::abs(m.box_height - height) < 0.1 * height && m.moving < 1e-2;
}

}  // namespace

int main(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const bool last = i + 1 == count;
    if (!last && std::strcmp(words[i], "--steps") == 0 && std::atoi(words[i + 1]) > 0) {
      options.steps = std::atoi(words[++i]);
    } else if (!last && std::strcmp(words[i], "--pictures") == 0) {
      options.pictures = words[++i];
    } else {
      std::fprintf(stderr, "usage: example_bullet [--steps N] [--pictures FOLDER]\n");
      return 2;
    }
  }
  example::Film film(options.pictures);
  std::printf("%d steps of %.4f s\n", options.steps, example::kStep);
  std::printf("%-18s %9s %9s %9s %9s %12s %11s %8s\n", "contacts", "deepest", "crossing", "box", "cloth", "kinetic",
              "energy", "a step");
  std::printf("%-18s %9s %9s %9s %9s %12s %11s %8s\n", "of soft bodies", "mm", "facets", "m", "m", "J", "gained, J",
              "ms");
  bool good = false;
  for (const Way& way : kWays) {
    const Measured measured = play(way, options, film);
    print(way.name, measured);
    good = way.contacts == Contacts::tact && rests(measured);
  }
  film.end();
  return good ? 0 : 1;
}
