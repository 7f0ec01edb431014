// Keeps the bodies of the simulation out of each other, as far as the contact points of the last step tell.
#pragma once

#include <limits>
#include <vector>

#include "scenes/dynamics/body.h"
#include "scenes/dynamics/penetration.h"

namespace tact::scenes {

// The contact points between two bodies.
struct BodyContact {
  int a = 0;  // places in the list of bodies
  int b = 0;
  std::vector<SurfacePoint> a_in_b;
  std::vector<SurfacePoint> b_in_a;
  double deepest = 0.0;  // of all points, metres
};

// How much of its way out a point is moved in one sweep.
struct WayOut {
  double share = 1.0;                                     // of the way
  double most = std::numeric_limits<double>::infinity();  // shares of the smaller body's size
};

// Contacts in groups of which no two move the same body; those of a group are solved in parallel, and give the same
// bits for any number of threads.
class ContactSolver {
 public:
  // Takes the contact points and where their bodies are now: from here each has to move out by its depth, except for
  // `slop` metres, which keep the contact alive until the next step. `contacts` must stay alive.
  void start(std::vector<BodyContact>& contacts, const std::vector<Body>& bodies, double slop);

  // Moves the points that are still inside out along their normals, masses shared: one sweep over all contacts.
  // Friction then takes back what a point slid since `before`, positions by body, by up to the friction coefficient
  // times the way out (Coulomb's cone, as in M. Müller et al., Detailed Rigid Body Simulation with Extended Position
  // Based Dynamics, SCA 2020).
  void solve(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before, int threads);
  // The same without friction, and only part of the way.
  void push_out(std::vector<Body>& bodies, const WayOut& part, int threads);
  // Points that are still inside need no longer move out from here, only not farther in.
  void hold(const std::vector<Body>& bodies);

 private:
  void solve_contacts(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>* before, const WayOut& part,
                      int threads);
  void solve_contact(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>* before, const WayOut& part,
                     BodyContact& contact) const;

  std::vector<BodyContact>* contacts_ = nullptr;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<std::size_t> rest_;  // those that fit no group: one after the other
};

}  // namespace tact::scenes
