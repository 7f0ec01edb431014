// How the dynamics of scenes go.
#pragma once

#include "scenes/dynamics/contact_settings.h"
#include "scenes/dynamics/sleep.h"

namespace tact::scenes {

struct DynamicsSettings {
  double gravity = 9.81;           // metres a second², towards -z
  double time_step = 1.0 / 120.0;  // seconds
  int substeps = 4;                // of the motion, a step
  // How far ahead of a body contact points are known: its margin is its thickness and this reach. As much as it moves
  // in a step, within these limits. A body that moves farther than its reach is detected again within the step.
  double least_reach = 0.001;  // metres
  double most_reach = 0.008;   // metres
  // Nothing goes farther than its reach between two detections: what is faster is slowed down. Nor does a body go
  // farther than nearly half of its smallest gap; of all of it where the other one stands still. Contact points hold
  // the nearest places apart; as bodies slide and turn, others become the nearest, which have no points yet. But no
  // two places are nearer than the smallest gap.
  bool stay_within_reach = true;
  ContactSettings contact = {};
  SleepSettings sleep = {};
  // Stop bodies before they meet, by World::detect_motion(), rather than keep contact points apart. Rigid bodies are
  // soft then, as impacts move vertices one by one.
  bool continuous = false;
  // Keep contact points apart, and stop what they did not keep apart before it meets: before each detection, by
  // World::detect_motion(). For cloth in folds: where a surface bends as sharply as its thickness, its nearest places
  // are neighbours, which have no points, or change between two detections. Bodies are not rigid then, either.
  bool guarded = false;
  double margin = 0.001;  // of every body where impacts are found, metres: two surfaces stay two of these apart
};

// How far a body of `reach` metres may move until the next detection, metres: as far as it will in a step, if it goes
// on as in the last substep, in which it went `last_way` metres. In powers of two, so that a body at rest keeps its
// margin.
double next_reach(double reach, double last_way, const DynamicsSettings& settings);

}  // namespace tact::scenes
