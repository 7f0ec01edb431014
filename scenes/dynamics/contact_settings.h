// How surfaces are kept apart.
#pragma once

namespace tact::scenes {

struct ContactSettings {
  // Sweeps over all points a substep. From the second one on only points are solved that have lost more than `spare` of
  // what they ask for, and there is none if there are none: in a heap or a tight fold one point presses on the next.
  int most_sweeps = 6;
  double spare = 0.3;
  // What is nearer than this share of its gap when the sweeps are done goes back towards where the substep began, by
  // half as often as it takes: there it was not. So nothing crosses, whatever the points ask of each other. A gap below
  // this share of both thicknesses does not shrink at all: in a heap it would go on shrinking, step by step, to zero.
  double least_share = 0.2;
  double least_gap = 0.1;
  // How fast surfaces that are nearer than their thicknesses part, metres a second at most, and which share of what is
  // missing a substep gives back. All at once would throw the bodies.
  double parting_speed = 0.25;
  double parting_share = 0.1;
};

}  // namespace tact::scenes
