// Keeps surfaces apart by the sum of their thicknesses, as far as the contact points of the last detection tell.
#pragma once

#include <tact/report.h>

#include <array>
#include <vector>

#include "scenes/dynamics/body.h"
#include "scenes/dynamics/contact_settings.h"

namespace tact::scenes {

// One constraint a contact point: the two places that it names stay apart along its normal,
//
//     n · (p_b - p_a) >= t_a + t_b,
//
// with friction. Solved as positions, one after the other, masses shared (XPBD without compliance; M. Macklin et al.,
// Small Steps in Physics Simulation, SCA 2019). Whether a gap is positive or negative makes no difference: a point
// whose surfaces have crossed is one that is farther from where it should be.
//
// Contacts stand in groups of which no two move the same body; those of a group are solved in parallel, and give the
// same bits for any number of threads.
class ContactSolver {
 public:
  // Takes the points of a report; body i has index i in it. Contacts of which no body can be moved are left out.
  void take(const Report& report, const std::vector<Body>& bodies, int threads);
  // For a substep of `h` seconds that began at the positions `before`, by body. Friction takes back what a point slid
  // since then, by up to the friction coefficient times the impulse along the normal (Coulomb's cone).
  void push(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before, const ContactSettings& settings,
            double h, int threads);
  // What is nearer than it may be (ContactSettings::least_share) goes back towards `before`. The last word of a
  // substep.
  void retreat(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before, const ContactSettings& settings,
               int threads);

 private:
  // A place on a surface.
  struct Place {
    std::array<int, 3> vertices{};  // the last is repeated with weight 0
    std::array<double, 3> weights{};
    Vec3 local;  // of a rigid body: RigidMotion::local(); of a plane: a place on it, from which heights are counted
  };
  struct Point {
    Place a, b;
    Vec3 normal;          // unit, from a to b
    double wanted = 0.0;  // metres, both thicknesses
    double found = 0.0;   // metres, the gap, but not more than is wanted
    double apart = 0.0;   // metres, what is asked for in this substep
  };
  // How the points of a contact are treated.
  struct Sweep {
    enum class Kind { push, retreat } kind = Kind::push;
    double spare = 0.0;        // metres that a point may miss
    double least_share = 0.0;  // of its gap, for a retreat,
    double least_gap = 0.0;    // and of both thicknesses
  };
  struct BodyContact {
    std::size_t a = 0, b = 0;        // places in the list of bodies
    std::size_t begin = 0, end = 0;  // of its points
  };
  class Carrier;

  static Place place_of(const Body& body, const std::array<int, 3>& vertices, const std::array<double, 3>& weights);
  void group_contacts(const std::vector<Body>& bodies);
  // These tell whether there was anything to do.
  bool sweep(const Sweep& sweep, std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before, int threads);
  bool sweep_contact(const BodyContact& contact, const Sweep& sweep, std::vector<Body>& bodies,
                     const std::vector<std::vector<Vec3>>& before) const;
  static bool push_point(const Point& point, double missing, Carrier& a, Carrier& b, double friction);

  std::vector<Point> points_;
  std::vector<BodyContact> contacts_;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<std::size_t> rest_;  // those that fit no group: one after the other
};

}  // namespace tact::scenes
