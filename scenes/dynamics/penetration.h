// From the facet pairs that tact reports to the points of one body that lie inside another, how deep, and the way out.
#pragma once

#include <tact/report.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "scenes/dynamics/body.h"

namespace tact::scenes {

// A point of body x on the wrong side of the surface of body y: a vertex, or a point of an edge.
struct SurfacePoint {
  std::array<int, 2> x_vertices{};    // of x; both the same for a vertex
  std::array<double, 2> x_weights{};  // add up to 1
  std::array<int, 3> y_vertices{};    // of y: the facet that takes the counter-force
  std::array<double, 3> y_weights{};  // add up to 1
  Vec3 normal;                        // unit, out of y
  double depth = 0.0;                 // of the surfaces that tact saw, metres, positive
  double offset = 0.0;                // the way still to go; the solver's
};

// A body as tact saw it.
struct SeenBody {
  const Body& body;
  const std::vector<Vec3>& positions;  // moved out by its skin
};

// Finds points of one body in another. Holds scratch memory: one for each thread.
class PenetrationFinder {
 public:
  // The points of x, which is `contact.a` if x_is_a and `contact.b` otherwise, inside y, the other one.
  //
  // Edges of x that cross facets of y are found from the facet pairs. Their ends that lie inside get the mean normal of
  // the crossings, and hand it on inwards from neighbour to neighbour; each vertex is as deep as y's surface is far
  // along its normal, and no deeper than a crossing is away; where that line does not leave y, the inside ends.
  // An edge with both ends outside gives its middle inside. No point is deeper in y than the hulls in each other, so
  // the depth of the contact bounds all of them. Of a sheet y, the wrong side is the one that the closed body's own
  // normal points to or, between two sheets, the one that the contact direction tells; only ends of crossing edges are
  // looked at. After B. Heidelberger et al., Consistent Penetration Depth Estimation for Deformable Collision Response,
  // VMV 2004, whose depths, handed on like the normals, are too large under a curved surface.
  void find(const Contact& contact, bool x_is_a, const SeenBody& x, const SeenBody& y,
            std::vector<SurfacePoint>& points);

 private:
  struct Crossing {
    int edge = 0;    // of x
    double t = 0.0;  // 0 at edge.from, 1 at edge.to
    int facet = 0;   // of y
    std::array<double, 3> weights{};
    Vec3 point = {};
    Vec3 normal = {};  // unit, of the facet, out of y
  };
  struct Entry {
    int vertex = 0;  // of x, inside y
    int crossing = 0;
  };
  // A place on the surface of y.
  struct Place {
    int facet = -1;
    std::array<double, 3> weights{};
    double depth = 0.0;  // how far away, metres; of a place to start from, how far at most
  };
  struct Inside {
    int vertex = 0;  // of x
    Vec3 normal = {};
    Place place = {};
  };

  void find_crossings(const Contact& contact, bool x_is_a, const SeenBody& x, const SeenBody& y);
  void add_crossing(int edge, int facet, const SeenBody& x, const SeenBody& y);
  void turn_sheet_normals(const Contact& contact, bool x_is_a, const SeenBody& x);
  std::pair<int, int> crossings_of(int edge) const;
  void enter_closed(const SeenBody& x, const SeenBody& y, std::vector<SurfacePoint>& points);
  void add_edge_middle(const SeenBody& x, const SeenBody& y, const Crossing& enter, const Crossing& leave,
                       std::vector<SurfacePoint>& points);
  void enter_sheet(const SeenBody& x);
  void start_inside(const SeenBody& x, const SeenBody& y);
  void spread_inside(const SeenBody& x, const SeenBody& y);
  void add_inside(const Inside& inside);
  Inside from_neighbors(const SeenBody& x, const SeenBody& y, int vertex, int known) const;
  static std::optional<Place> locate(const SeenBody& y, Vec3 p, Vec3 normal, const Place& near);
  static Vec3 point_at(const SeenBody& y, const Place& place);
  static SurfacePoint contact_point(const SeenBody& y, int vertex, Vec3 normal, const Place& place);

  std::vector<Crossing> crossings_;  // sorted by (edge, t)
  std::vector<Entry> entries_;       // sorted by (vertex, crossing)
  std::vector<int> ring_, next_ring_;
  std::vector<int> state_;     // by vertex of x: kUnknown, kOutside, or its place in found_; between calls all kUnknown
  std::vector<int> visited_;   // the vertices whose state is not kUnknown
  std::vector<Inside> found_;  // in the order in which they were found
};

}  // namespace tact::scenes
