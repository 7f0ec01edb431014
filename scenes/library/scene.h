// A scene: bodies, how they move, and how a picture shows them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/box.h"
#include "scenes/dynamics/simulation.h"
#include "scenes/pictures/camera.h"
#include "scenes/pictures/contact_marks.h"

namespace tact::scenes {

// How pictures show a body.
struct Look {
  bool visible = true;
  bool marked = true;  // show where it meets others
  double opacity = 1.0;
  Shading shading = Shading::smooth;
};

struct Scene {
  std::vector<Body> bodies;
  std::vector<Look> looks;  // a body each
  Script script;            // may be empty
  DynamicsSettings dynamics;
  View view;
  ContactMarks marks;              // of many bodies, directions and what is hidden are left out
  std::optional<base::Box> shown;  // what pictures show, metres; else the bodies as they are at the start
  std::optional<double> ground;    // height of a floor in pictures, metres
  // What the paper says of this scene, to stand beside our figures; empty: it does not have it.
  std::string paper;

  void add(Body body, const Look& look = {}) {
    bodies.push_back(std::move(body));
    looks.push_back(look);
  }
};

}  // namespace tact::scenes
