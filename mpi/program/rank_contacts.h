// Keeps surfaces apart by the sum of their thicknesses, over all ranks, with the same bits for any number of them.
#pragma once

#include <mpi.h>
#include <tact/contact_point.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "scenes/dynamics/body.h"
#include "scenes/dynamics/contact_settings.h"

namespace tact::mpi::program {

using scenes::Body;
using scenes::Vec3;

// What a body is to those that have a contact with it.
struct Partner {
  double thickness = 0.0;     // metres
  double friction = 0.0;      // see Body::friction
  double square_speed = 0.0;  // see mean_square_speed()
  bool dynamic = false;       // do forces move it?
  bool moves = false;         // is it neither fixed nor asleep?
};

// A contact of which this rank owns a body. The ranks of both bodies give it the same points.
struct SharedContact {
  static constexpr int kElsewhere = -1;
  std::array<int, 2> body{kElsewhere, kElsewhere};  // places in this rank's list of bodies, a and b
  int rank = kElsewhere;                            // of the body that is elsewhere
  std::span<const ContactPoint> points;             // as long as the report lives
};

// The constraints of scenes::ContactSolver, but solved as sums: each sweep sees all bodies as the last one left them,
// and a body adds up what its contacts ask for in the order of their keys. A vertex that several points push is split
// among them (R. Tonge et al., Mass Splitting for Jitter-Free Parallel Rigid Body Simulation, SIGGRAPH 2012), so that
// their sum does not push too far. Both owners of a contact compute the same impulses from the same numbers: where a
// point's two places are and how easily they give. These are what ranks send each other, a message to each neighbour
// and sweep.
//
// Deformable bodies only. All ranks call every function but the constructor together.
class RankContacts {
 public:
  RankContacts(MPI_Comm communicator, int threads) : communicator_(communicator), threads_(threads) {}

  // Takes the contacts, sorted by keys, and makes both sides of each known: see partner(). Points between bodies that
  // do not move are left out.
  void take(std::vector<SharedContact> contacts, const std::vector<Body>& bodies);
  // Makes both sides known as they are now.
  void share_partners(const std::vector<Body>& bodies);
  std::span<const SharedContact> contacts() const { return contacts_; }
  // Side 0 or 1 of a contact, as it was when it was last shared.
  const Partner& partner(std::size_t contact, int side) const { return partners_[2 * contact + side]; }

  // As ContactSolver::push() and retreat(). The number of sweeps is fixed, so that no rank has to ask all others
  // whether they are done; retreats end when all ranks have nothing to take back.
  void push(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before,
            const scenes::ContactSettings& settings, double h);
  void retreat(std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before,
               const scenes::ContactSettings& settings);

 private:
  // One side of a point: a place on a surface, what it is now and how easily it gives.
  struct Place {
    Vec3 now, before;   // metres
    double give = 0.0;  // how far a unit impulse moves it, all that push its vertices taken into account
  };
  // A contact's side that a body of this rank is.
  struct OwnSide {
    std::size_t contact = 0;
    int side = 0;
  };
  // What goes to a rank and comes from it: the contacts shared with it, in their order.
  struct Neighbor {
    int rank = 0;
    std::vector<OwnSide> sides = {};
    std::vector<double> sent = {}, received = {};
  };

  std::span<const OwnSide> sides_of(std::size_t body) const;
  Place& place(std::size_t point, int side) { return places_[2 * point + side]; }
  const Place& place(std::size_t point, int side) const { return places_[2 * point + side]; }
  void sort_sides(const std::vector<Body>& bodies);
  void find_neighbors();
  void count_pushes(const std::vector<Body>& bodies);
  enum class Items { contacts, points };
  // Calls give(item, side, out) for `width` doubles of each of this rank's sides, and take(item, side, in) for those of
  // the other ranks.
  template <class Give, class Take>
  void exchange(Items items, int width, const Give& give, const Take& take);
  enum class Known { before, nothing };  // what all ranks know already of each place
  void share_places(const std::vector<Body>& bodies, const std::vector<std::vector<Vec3>>& before, Known known);
  double thickness(std::size_t contact) const { return partner(contact, 0).thickness + partner(contact, 1).thickness; }
  Vec3 impulse(std::size_t contact, std::size_t point, double spare) const;
  void push_body(std::size_t body, Body& moved, double spare);
  bool take_back_body(std::size_t body, Body& moved, const std::vector<Vec3>& before,
                      const scenes::ContactSettings& settings, double kept);

  MPI_Comm communicator_;
  int threads_;
  std::vector<SharedContact> contacts_;
  std::vector<Partner> partners_;          // two a contact
  std::vector<std::size_t> first_point_;   // by contact
  std::vector<Place> places_;              // two a point
  std::vector<double> apart_;              // by point: what is asked for in this substep, metres
  std::vector<OwnSide> sides_;             // by body, then in the order of contacts
  std::vector<std::size_t> first_side_;    // by body
  std::vector<std::vector<int>> pushes_;   // by body and vertex: how many points pushed it in the last sweep
  std::vector<std::vector<Vec3>> shifts_;  // by body and vertex: the sum of what they asked for, metres
  std::vector<Neighbor> neighbors_;        // in the order of ranks
};

}  // namespace tact::mpi::program
