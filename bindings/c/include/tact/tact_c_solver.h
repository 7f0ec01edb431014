/* A part of tact_c.h: for solvers. */
#ifndef TACT_C_SOLVER_H
#define TACT_C_SOLVER_H

#include <tact/tact_c_world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* For solvers: see tact/solver.h. Positions are 3 numbers a vertex, of all vertices of the program's system. Of the
 * arrays that are filled, null ones are left out: 1 number a stencil for values, 12 for gradients, 144 for Hessians. */

/** The features that a stencil joins, in the order of its vertices. */
typedef enum tact_stencil_kind {
  TACT_STENCIL_POINT_POINT = 0, /**< two vertices */
  TACT_STENCIL_POINT_EDGE = 1,  /**< a vertex, then two of an edge */
  TACT_STENCIL_POINT_FACET = 2, /**< a vertex, then three of a facet */
  TACT_STENCIL_EDGE_EDGE = 3    /**< two of an edge of a, then two of an edge of b */
} tact_stencil_kind;

/** The vertices of a contact point and how it depends on them. */
typedef struct tact_stencil {
  int32_t kind;        /**< tact_stencil_kind */
  bool b_first;        /**< whether its first vertex is of body b, not of a */
  int32_t vertices[4]; /**< rows of the program's system; -1 fills up */
  double weights[4]; /**< weights of the vertices, those of body a negative: the weighted sum of positions leads from a
                        to b */
  double normal[3];  /**< unit vector from a to b */
  double gap;        /**< metres; negative where the surfaces have crossed */
  uint64_t id;       /**< that of the contact point */
} tact_stencil;

/** What the functions of many stencils fill. */
typedef struct tact_terms {
  double* values;    /**< a number a stencil */
  double* gradients; /**< 12 numbers a stencil, three a vertex */
  double* hessians;  /**< 144 numbers a stencil; those of barriers, penalties and friction are positive semidefinite */
} tact_terms;

/** Gives the stencils of all points of the last step but those with planes, in its order; vertex v of the body of index
 * i is row first_rows[i] + v. Writes up to `capacity` of them, and how many there are. */
TACT_C_API tact_error tact_report_stencils(tact_world world, const int32_t* first_rows, size_t body_count,
                                           tact_stencil* stencils, size_t capacity, size_t* count);
/** Gives the stencils of all pairs within reach of the last step, in its order: in `whole` with all vertices of both
 * features, in `closest` with those of the closest features alone. Writes up to `capacity` of each, and how many there
 * are. */
TACT_C_API tact_error tact_report_stencils_within_reach(tact_world world, const int32_t* first_rows, size_t body_count,
                                                        tact_stencil* whole, tact_stencil* closest, size_t capacity,
                                                        size_t* count);
/** Gives the barriers of pairs within reach whose distance is below `reach` metres, as terms of their `whole` stencils;
 * `rest` is as for tact_stencil_barriers(). */
TACT_C_API tact_error tact_stencil_reach_barriers(const tact_stencil* whole, const tact_stencil* closest, size_t count,
                                                  const double* positions, const double* rest, size_t vertex_count,
                                                  double reach, tact_terms terms);
/** Gives the stencils of all impacts that stop, but those with planes, in their order. `begin` are the
 * vertices of all bodies where the way begins, `end` where it leads; `first_rows` is as for tact_report_stencils().
 * Writes up to `capacity` of them, and how many there are. */
TACT_C_API tact_error tact_motion_stencils(tact_world world, const int32_t* first_rows, size_t body_count,
                                           const double* begin, const double* end, size_t vertex_count,
                                           tact_stencil* stencils, size_t capacity, size_t* count);
/** Gives how fast the gap of each stencil grows if its vertices have such velocities; where they are ways, by how much
 * it grows. */
TACT_C_API tact_error tact_stencil_gap_rates(const tact_stencil* stencils, size_t count, const double* velocities,
                                             size_t vertex_count, double* rates);
/** Gives the gaps of stencils at positions of `vertex_count` vertices, metres. */
TACT_C_API tact_error tact_stencil_gaps(const tact_stencil* stencils, size_t count, const double* positions,
                                        size_t vertex_count, tact_terms terms);
/** Gives the barriers of the gaps below `reach` metres, to be multiplied by a stiffness. `rest` are positions at rest
 * for the mollifier of nearly parallel edges, or null for none. */
TACT_C_API tact_error tact_stencil_barriers(const tact_stencil* stencils, size_t count, const double* positions,
                                            const double* rest, size_t vertex_count, double reach, tact_terms terms);
/** Gives the penalties of the gaps below `reach` metres, to be multiplied by a stiffness. */
TACT_C_API tact_error tact_stencil_penalties(const tact_stencil* stencils, size_t count, const double* positions,
                                             size_t vertex_count, double reach, tact_terms terms);
/** Gives the potentials of friction for the ways `moved` of the vertices since the step began, with the largest force
 * of each stencil in `limits`, newtons. Below `smoothing` metres, which are positive, the force grows smoothly. */
TACT_C_API tact_error tact_stencil_friction(const tact_stencil* stencils, size_t count, const double* moved,
                                            size_t vertex_count, const double* limits, double smoothing,
                                            tact_terms terms);
/** Gives a colour to each stencil; two of one colour share no vertex below `moving`. */
TACT_C_API tact_error tact_stencil_colors(const tact_stencil* stencils, size_t count, size_t moving, int32_t* colors);

#ifdef __cplusplus
}
#endif

#endif
