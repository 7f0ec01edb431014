/* A part of tact_c.h: drawing what was found. */
#ifndef TACT_C_DEBUG_DRAW_H
#define TACT_C_DEBUG_DRAW_H

#include <tact/tact_c_queries.h>
#include <tact/tact_c_report.h>
#include <tact/tact_c_solver.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Drawing what a step found: see tact/debug_draw.h. */

/** A colour; an alpha of 1 covers what is behind. */
typedef struct tact_debug_color {
  float red;   /**< 0 to 1 */
  float green; /**< 0 to 1 */
  float blue;  /**< 0 to 1 */
  float alpha; /**< 0 to 1 */
} tact_debug_color;

/** Takes the drawing, on the thread of tact_world_debug_draw(), which passes exceptions on. */
typedef struct tact_debug_drawer {
  void (*line)(void* user, const double* from, const double* to, tact_debug_color color);
  void (*triangle)(void* user, const double* p, const double* q, const double* r, tact_debug_color color);
  void (*text)(void* user, const double* at, const char* words, tact_debug_color color);
  void* user;
} tact_debug_drawer;

/** What is drawn, and in which colour. */
typedef struct tact_debug_draw_options {
  uint32_t struct_size;
  bool surfaces;        /**< every facet of every body, as lines */
  bool boxes;           /**< the box of each body with its margin */
  bool candidate_pairs; /**< a line between the centres of two bodies whose boxes overlap */
  bool directions;      /**< the direction of each contact, as long as its depth, and the depth */
  bool planes;          /**< the contact planes, as squares as wide as the bodies */
  bool zones;           /**< the disks around impact zones */
  bool kept_facets;     /**< the facets that the criteria kept, found once more */
  bool facet_pairs;
  bool patches; /**< the direction of each patch, as long as its depth */
  bool points;  /**< each contact point, as a line from a to b, and its normal; faint if no minimum */
  bool names;   /**< the name of each body, at the top of its box */
  tact_debug_color surface;
  tact_debug_color box;
  tact_debug_color moved_box; /**< the box of a body with a candidate pair */
  tact_debug_color candidate;
  tact_debug_color direction;
  tact_debug_color plane;
  tact_debug_color zone;
  tact_debug_color kept;
  tact_debug_color meeting;
  tact_debug_color patch;
  tact_debug_color point;
  tact_debug_color word;
  bool curves; /**< the curves in which surfaces cross */
  tact_debug_color curve;
  bool within_reach; /**< each pair of features within reach, as a line from a to b */
  tact_debug_color reach;
  tact_debug_color distance;
  tact_debug_color sum;
  tact_debug_color force;
} tact_debug_draw_options;

/** Fills in the defaults of all fields of version 1.0, struct_size included; later versions write no others. */
TACT_C_API tact_error tact_debug_draw_defaults(tact_debug_draw_options* options);
/** Draws what the last step found; `options` may be null: the default. */
TACT_C_API tact_error tact_world_debug_draw(tact_world world, const tact_debug_drawer* drawer,
                                            const tact_debug_draw_options* options);
/** Draws distances of bodies of `world`: a line between the two places, and its length. Those of bodies that are
 * farther apart than requested are left out. `options` may be null: the default. */
TACT_C_API tact_error tact_world_debug_draw_distances(tact_world world, const tact_body_distance* distances,
                                                      size_t count, const tact_debug_drawer* drawer,
                                                      const tact_debug_draw_options* options);
/** Draws each patch of the last step's tact_report_sum_contacts() as a circle of its area across its normal, and forces
 * as arrows, the largest half as long as all bodies. Forces of a contact with patches are drawn at these. `options` may
 * be null: the default. */
TACT_C_API tact_error tact_world_debug_draw_sums(tact_world world, const tact_point_impulse* impulses, size_t count,
                                                 const tact_debug_drawer* drawer,
                                                 const tact_debug_draw_options* options);
/** Draws stencils where `positions` has their vertices: the edges of both features, a line from a to b, and the normal,
 * half as long as the features are wide. */
TACT_C_API tact_error tact_stencil_debug_draw(const tact_stencil* stencils, size_t count, const double* positions,
                                              size_t vertex_count, const tact_debug_drawer* drawer,
                                              tact_debug_color color);

#ifdef __cplusplus
}
#endif

#endif
