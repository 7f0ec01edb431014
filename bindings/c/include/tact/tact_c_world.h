/* A part of tact_c.h: worlds, bodies and recordings. */
#ifndef TACT_C_WORLD_H
#define TACT_C_WORLD_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(TACT_SHARED) && defined(TACT_BUILDS_LIBRARY)
#define TACT_C_API __declspec(dllexport)
#elif defined(_WIN32) && defined(TACT_SHARED)
#define TACT_C_API __declspec(dllimport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define TACT_C_API __attribute__((visibility("default")))
#else
#define TACT_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What was wrong with the data of a call. What a function returns: the numbers never change; new ones may come. */
typedef enum tact_error {
  TACT_OK = 0,
  TACT_ERROR_NON_FINITE_POSITION = 1,   /**< a coordinate is NaN or infinite */
  TACT_ERROR_POSITION_OUT_OF_RANGE = 2, /**< a coordinate has a magnitude above 2^300 */
  TACT_ERROR_FACET_OUT_OF_RANGE = 3,    /**< a facet names a vertex that the body does not have */
  TACT_ERROR_WRONG_SIZE = 4,            /**< a matrix or an array has the wrong size */
  TACT_ERROR_TOO_LARGE = 5,             /**< more than 2^29 - 1 vertices or facets, or 2^32 - 1 bodies */
  TACT_ERROR_STALE_BODY = 6,            /**< the body was removed, or never added */
  TACT_ERROR_FOREIGN_BODY = 7,          /**< the body is of another world */
  TACT_ERROR_FIXED_BODY = 8,            /**< positions or a pose were set on a body whose motion is fixed */
  TACT_ERROR_BAD_SETTINGS = 9,          /**< a setting is out of range; the message names it */
  TACT_ERROR_WRONG_ORDER = 10,          /**< a call came at the wrong time, or a batch names a body twice */
  TACT_ERROR_OUT_OF_MEMORY = 11,        /**< an allocation failed */
  TACT_ERROR_BACKEND_FAILURE = 12,      /**< Embree reported an error; the message holds its code */
  TACT_ERROR_BAD_RECORDING = 13,        /**< the bytes are no recording, or one that does not play */
  TACT_ERROR_WRONG_MOTION = 14,         /**< positions were set on a rigid body, or a pose on a deformable one */
  TACT_ERROR_NOT_A_ROTATION = 15,       /**< the matrix of a pose is not orthonormal to 1e-9, or mirrors */
  TACT_ERROR_INVALID_ARGUMENT = 16,     /**< an argument is out of range, such as a negative margin */
  TACT_ERROR_BAD_STATE = 17,            /**< the bytes are no saved state of a world, or damaged */
  TACT_ERROR_INVALID_HANDLE = 100,      /**< the handle names no world or player */
  TACT_ERROR_NULL_ARGUMENT = 101,       /**< a pointer is null that must not be */
  TACT_ERROR_WRONG_STRUCT_SIZE = 102,   /**< struct_size is not that of a version of this library */
  TACT_ERROR_BUSY = 103,                /**< another thread is in a function of the world */
  TACT_ERROR_INDEX_OUT_OF_RANGE = 104,  /**< an index is not below the count */
  TACT_ERROR_INTERNAL = 105,            /**< anything else; please report it */
  TACT_ERROR_FILE = 106                 /**< a file cannot be opened, read or written */
} tact_error;

/** The version of the library, such as "1.0.0". */
TACT_C_API const char* tact_version(void);
/** Gives the name of `code`, such as "stale_body". */
TACT_C_API const char* tact_error_code_name(int error);
/** What went wrong in the last call of this thread that failed: body, vertex, facet, setting. Never null; valid until
 *  the thread's next call that fails. */
TACT_C_API const char* tact_last_error_message(void);

/** A set of bodies and the contacts among them. {0}: none. */
typedef struct tact_world {
  uint64_t handle;
} tact_world;

/** Names a body of one world. {0, 0, 0}: none. */
typedef struct tact_body {
  uint32_t index;      /**< the place of the body in its world; that of a removed body is used again */
  uint32_t generation; /**< 0 in the id of no body */
  uint32_t world;      /**< the world that gave the id out */
} tact_body;

/** What a report promises of its pairs. */
typedef enum tact_accuracy {
  TACT_ACCURACY_HULLS = 0, /**< overlap, direction and depth of the convex hulls; neither zones nor facet pairs */
  TACT_ACCURACY_PAPER = 1, /**< the paper's three criteria, then confirmation; may miss facet pairs */
  TACT_ACCURACY_EXACT = 2  /**< every facet pair that meets and no other */
} tact_accuracy;
/** Where the contact direction of a pair comes from. */
typedef enum tact_direction_policy {
  TACT_DIRECTION_CARRIED = 0, /**< the direction of the last step, so that a body leaves the way it came in */
  TACT_DIRECTION_SMALLEST = 1 /**< the smallest separation of the hulls, from scratch in every step */
} tact_direction_policy;
/** What the facets of a body are. */
typedef enum tact_surface {
  TACT_SURFACE_CLOSED = 0, /**< a solid's surface, facets counter-clockwise seen from outside; taken
                               as a sheet if it has a border */
  TACT_SURFACE_SHEET = 1   /**< cloth: no inside, both sides count */
} tact_surface;
/** How a body moves. */
typedef enum tact_motion {
  TACT_MOTION_DEFORMABLE = 0, /**< tact_world_set_positions() moves its vertices */
  TACT_MOTION_FIXED = 1,      /**< nothing moves it; two fixed bodies are never tested against each other */
  TACT_MOTION_RIGID = 2       /**< tact_world_set_pose() turns and moves it, and its shape stays */
} tact_motion;
typedef enum tact_number_kind {
  TACT_FLOAT32 = 0,
  TACT_FLOAT64 = 1,
  TACT_INT32 = 2,
  TACT_UINT32 = 3,
  TACT_UINT16 = 4
} tact_number_kind;

/** `task(data, index)` is called once for each 0 <= index < count, on any threads; run() returns when all have
 * returned. See tact/executor.h. */
typedef void (*tact_task)(void* data, int index);
typedef struct tact_executor {
  void (*run)(void* user, int count, tact_task task, void* data); /**< null: OpenMP's threads */
  void* user;                                                     /**< outlives the world */
} tact_executor;

/** What a message is about. */
typedef enum tact_message_kind {
  TACT_MESSAGE_DIRECTION_LIMIT = 0, /**< the search for the direction of a contact stopped at a limit */
  TACT_MESSAGE_GJK_LIMIT = 1,       /**< GJK stopped at its limit for pairs that are taken to be apart */
  TACT_MESSAGE_POINT_LIMIT = 2,     /**< a body crosses itself deeper than its points are found */
  TACT_MESSAGE_OPEN_SURFACE = 3,    /**< a body was added as closed, and is taken as a sheet */
  TACT_MESSAGE_INSIDE_OUT = 4       /**< a closed body was added whose facets are clockwise seen from outside */
} tact_message_kind;

/** A limit that a step reached, or what is wrong with a body that was added. */
typedef struct tact_message {
  int32_t kind;     /**< tact_message_kind */
  tact_body a;      /**< the first body of the pair, or no body */
  tact_body b;      /**< the second body of the pair, or no body */
  const char* text; /**< a sentence with the names of the bodies; valid during the call, empty without memory */
} tact_message;

/** Called at the end of tact_world_detect() and tact_world_add_body(), by their thread; must not call the world. */
typedef void (*tact_message_function)(void* user, const tact_message* message);

/** How a world works. */
typedef struct tact_settings {
  uint32_t struct_size;
  int32_t threads;   /**< the number of threads, 0 to 1024. 0 uses as many as the machine offers; tact_world_settings()
                        returns the number */
  int32_t accuracy;  /**< tact_accuracy */
  int32_t direction; /**< tact_direction_policy */
  double gjk_tolerance;    /**< the relative gap at which GJK stops, 1e-15 to 0.1 */
  int32_t iteration_limit; /**< shifted calls of GJK a pair and step, at least 1 */
  bool zones;              /**< tact_contact.zone_a and zone_b */
  bool patches;            /**< tact_contact_patch() and tact_report_patch_events() */
  bool trace;              /**< tact_report_trace() */
  tact_executor executor;
  bool points;                      /**< tact_contact_points() */
  tact_message_function on_message; /**< called for each limit that a step reached, and for each body that was added as
                                       closed and is not. The report has limits as flags and counts. May be null */
  void* message_user;               /**< what it is called with */
  bool curves;                      /**< tact_contact_curve() */
  bool within_reach;                /**< tact_contact_within_reach() */
} tact_settings;
#define TACT_SETTINGS_INIT                                                                                            \
  {                                                                                                                   \
    (uint32_t)sizeof(tact_settings), 0, TACT_ACCURACY_EXACT, TACT_DIRECTION_CARRIED, 1e-12, 100, false, false, false, \
        {NULL, NULL}, false, NULL, NULL, false, false                                                                 \
  }

/** `count` vertices or facets, three numbers each, or edges of two, that begin every `stride_bytes` from `first` on.
 * Coordinates are float32 or float64, floats widen exactly; indices are int32, uint32 or uint16. Read where they are.
 */
typedef struct tact_columns {
  const void* first;
  size_t count;
  size_t stride_bytes;
  int32_t kind; /**< tact_number_kind */
} tact_columns;

/** What tact_world_add_body() adds: vertices, and the facets, edges and points that they make. */
typedef struct tact_body_definition {
  uint32_t struct_size;
  int32_t surface;        /**< tact_surface */
  tact_columns positions; /**< 3 x V, metres; the rest shape of a rigid body */
  tact_columns facets;    /**< 3 x F, indices of vertices */
  int32_t motion;         /**< tact_motion */
  uint32_t layer;         /**< the layers that the body is on, a bit each */
  uint32_t mask;          /**< the layers that the body is tested against; a pair needs both masks */
  const char* name;       /**< for messages; by default "body <index>" */
  uint64_t external_id;   /**< the program's own number; no answer depends on it */
  double margin;          /**< how far ahead of the surface contact points are seen, metres, 0 to 2^300 */
  bool self_contact;      /**< whether the body is tested against itself, too */
  uint32_t group;         /**< bodies of one group are not tested against each other. 0 is no group */
  bool has_key;           /**< whether `key` is given */
  uint64_t key;           /**< the order of bodies in all answers, and what ids of points and patches are made of; by
                             default the index. Each body of a world has another */
  tact_columns edges;     /**< 2 x E, indices of vertices: ropes and hair */
  const int32_t* points;  /**< vertices that stand alone: grains */
  size_t point_count;     /**< how many there are */
  bool has_rest_offset;   /**< whether `rest_offset` is given */
  double rest_offset; /**< what the body adds to the distance that surfaces keep, metres, 0 to the margin; by default
                         the margin, whatever that becomes */
} tact_body_definition;
#define TACT_BODY_DEFINITION_INIT                                                                             \
  {                                                                                                           \
    (uint32_t)sizeof(tact_body_definition), TACT_SURFACE_CLOSED, {NULL, 0, 24, TACT_FLOAT64},                 \
        {NULL, 0, 12, TACT_INT32}, TACT_MOTION_DEFORMABLE, 1u, 0xffffffffu, NULL, 0, 0.0, false, 0, false, 0, \
        {NULL, 0, 8, TACT_INT32}, NULL, 0, false, 0.0                                                         \
  }

/** What tact_world_add_plane() adds: a floor or a wall of any size. */
typedef struct tact_plane_definition {
  uint32_t struct_size;
  double normal[3];     /**< out of what is solid, of length 1 to 1e-9; taken as it is */
  double offset;        /**< how far the plane is from the origin along `normal`, metres */
  const char* name;     /**< for messages; by default "body <index>" */
  uint32_t layer;       /**< the layers that the plane is on, a bit each */
  uint32_t mask;        /**< the layers that it is tested against; a pair needs both masks */
  uint32_t group;       /**< see tact_body_definition.group */
  uint64_t external_id; /**< the program's own number; no answer depends on it */
  bool has_key;         /**< whether `key` is given */
  uint64_t key;         /**< see tact_body_definition.key */
  double margin;        /**< see tact_body_definition.margin */
  bool has_rest_offset; /**< whether `rest_offset` is given */
  double rest_offset;   /**< see tact_body_definition.rest_offset */
} tact_plane_definition;
#define TACT_PLANE_DEFINITION_INIT                                                                                    \
  {                                                                                                                   \
    (uint32_t)sizeof(tact_plane_definition), {0.0, 0.0, 1.0}, 0.0, NULL, 1u, 0xffffffffu, 0, 0, false, 0, 0.0, false, \
        0.0                                                                                                           \
  }

/** A half-space: all x with normal * x <= offset. */
typedef struct tact_plane {
  double normal[3]; /**< out of what is solid */
  double offset;    /**< metres */
} tact_plane;

/** New positions of one body, for tact_world_set_positions(). */
typedef struct tact_positions_update {
  tact_body body; /**< the body */
  tact_columns positions;
} tact_positions_update;

/** A new mesh of one body, for tact_world_set_facets(). */
typedef struct tact_mesh_update {
  uint32_t struct_size;
  tact_columns positions;    /**< 3 x V, metres */
  tact_columns facets;       /**< 3 x F, indices of vertices */
  tact_columns edges;        /**< 2 x E, indices of vertices */
  const int32_t* points;     /**< vertices that stand alone */
  size_t point_count;        /**< how many there are */
  const int32_t* vertex_map; /**< of each vertex the old one that it was, or -1 */
  size_t vertex_map_count;   /**< its entries */
  const int32_t* facet_map;  /**< of each facet the old one whose label, layer and mask it has, or -1 */
  size_t facet_map_count;    /**< its entries */
} tact_mesh_update;
#define TACT_MESH_UPDATE_INIT                                                                   \
  {                                                                                             \
    (uint32_t)sizeof(tact_mesh_update), {NULL, 0, 24, TACT_FLOAT64}, {NULL, 0, 12, TACT_INT32}, \
        {NULL, 0, 8, TACT_INT32}, NULL, 0, NULL, 0, NULL, 0                                     \
  }

/** Settings of single vertices and facets of a body. An empty array sets nothing. */
typedef struct tact_feature_settings {
  uint32_t struct_size;
  const double* rest_offsets; /**< what each vertex adds to the distance that surfaces keep, metres, 0 to the margin */
  size_t rest_offset_count;   /**< their number */
  const uint32_t* vertex_labels; /**< the program's own numbers, one a vertex */
  size_t vertex_label_count;     /**< their number */
  const uint32_t* facet_labels;  /**< the program's own numbers, one a facet */
  size_t facet_label_count;      /**< their number */
  const uint32_t* vertex_layers; /**< the layers that each vertex is on, a bit each; by default those of the body */
  size_t vertex_layer_count;     /**< their number */
  const uint32_t* vertex_masks;  /**< the layers that each vertex is tested against; by default those of the body */
  size_t vertex_mask_count;      /**< their number */
  const uint32_t* facet_layers;  /**< the layers that each facet is on, a bit each; by default those of the body */
  size_t facet_layer_count;      /**< their number */
  const uint32_t* facet_masks;   /**< the layers that each facet is tested against; by default those of the body */
  size_t facet_mask_count;       /**< their number */
  /** How far ahead of each vertex contact points are seen, metres, 0 to the margin of the body. */
  const double* margins;
  size_t margin_count; /**< their number */
} tact_feature_settings;
#define TACT_FEATURE_SETTINGS_INIT \
  { (uint32_t)sizeof(tact_feature_settings), NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0 }

/** Which features of a body that is tested against itself are too near to each other to be tested. */
typedef struct tact_self_contact_filter {
  uint32_t struct_size;
  /** Features with vertices at most so many edges apart are left out, 0 to 16; 0 leaves out those with a
   * common vertex alone. */
  int32_t rings;
  /** Features with vertices at most so far apart at rest are left out, metres, 0 to 2^300; 0 leaves out none. */
  double rest_distance;
  /** Where vertices are at rest, metres; by default where they are when the filter is set. It is 3 x V. */
  tact_columns rest_positions;
} tact_self_contact_filter;
#define TACT_SELF_CONTACT_FILTER_INIT                                                 \
  {                                                                                   \
    (uint32_t)sizeof(tact_self_contact_filter), 0, 0.0, { NULL, 0, 24, TACT_FLOAT64 } \
  }

/** What has a label. */
typedef enum tact_label_kind {
  TACT_LABEL_FACET = 0, /**< facets, and edges and vertices that only such facets have */
  TACT_LABEL_VERTEX = 1 /**< vertices, and the edges and facets that have any of them */
} tact_label_kind;

/** A label of one body and a label of another, or of the same. */
typedef struct tact_label_pair {
  tact_body a;      /**< a body */
  uint32_t label_a; /**< a label of it, not 0 */
  tact_body b;      /**< another body, or the same */
  uint32_t label_b; /**< a label of that, not 0 */
  int32_t kind;     /**< tact_label_kind */
} tact_label_pair;

/** The labels of a vertex, an edge or a facet; 0 where there is none. */
typedef struct tact_feature_labels {
  uint32_t vertices[3]; /**< those of its vertices, in their order */
  uint32_t facet;       /**< that of the facet, or of the first facet that has the vertex or the edge */
} tact_feature_labels;

/** A new pose of a rigid body, for tact_world_set_poses(). */
typedef struct tact_pose_update {
  tact_body body;        /**< the body */
  double rotation[9];    /**< of determinant +1. Row by row */
  double translation[3]; /**< metres */
} tact_pose_update;

/* The world. */

/** Makes a world; `settings` may be null for the default. */
TACT_C_API tact_error tact_world_create(const tact_settings* settings, tact_world* world);
/** Destroys a world. */
TACT_C_API tact_error tact_world_destroy(tact_world world);
/** Gives the settings. */
TACT_C_API tact_error tact_world_settings(tact_world world, tact_settings* settings);
/** Sets the settings for the next step, which looks at every pair again. */
TACT_C_API tact_error tact_world_set_settings(tact_world world, const tact_settings* settings);
/** Adds a body; copies its mesh and groups the facets into clusters. */
TACT_C_API tact_error tact_world_add_body(tact_world world, const tact_body_definition* definition, tact_body* body);
/** Adds a half-space, which is fixed and has no vertices: exact at any distance, and without a mesh. */
TACT_C_API tact_error tact_world_add_plane(tact_world world, const tact_plane_definition* definition, tact_body* body);
/** Removes a body. */
TACT_C_API tact_error tact_world_remove_body(tact_world world, tact_body body);
/** Copies new positions of a body, 3 x V in metres; equal ones do not move it. */
TACT_C_API tact_error tact_world_set_positions(tact_world world, tact_body body, const tact_columns* positions);
/** Copies new positions of many bodies in parallel, all or none. */
TACT_C_API tact_error tact_world_set_positions_of_many(tact_world world, const tact_positions_update* updates,
                                                       size_t count);
/** Gives a body other vertices and facets; `vertex_map` tells of each new vertex which old one it was, or -1. It has
 * `count` entries, one a new vertex. */
TACT_C_API tact_error tact_world_set_facets(tact_world world, tact_body body, const tact_columns* positions,
                                            const tact_columns* facets, const int32_t* vertex_map, size_t count);
/** The same with edges and points, of which the other leaves none, and with labels, layers and masks of facets. */
TACT_C_API tact_error tact_world_set_facets_by(tact_world world, tact_body body, const tact_mesh_update* update);
/** Places a rigid body: a vertex added at p stands at rotation * p + translation. `rotation` has 9 numbers, row by row,
 * `translation` 3. */
TACT_C_API tact_error tact_world_set_pose(tact_world world, tact_body body, const double* rotation,
                                          const double* translation);
/** Places many rigid bodies in parallel, all or none. */
TACT_C_API tact_error tact_world_set_poses(tact_world world, const tact_pose_update* updates, size_t count);
/** Gives the rotation nearest to a matrix that is orthonormal to 1e-5. Both have 9 numbers, row by row. See
 * tact/rotation.h. */
TACT_C_API tact_error tact_nearest_rotation(const double* matrix, double* rotation);
/** Gives the rotation of a quaternion x, y, z, w whose length is 1 to 1e-5. `rotation` gets 9 numbers, row by row. */
TACT_C_API tact_error tact_rotation_of_quaternion(const double* quaternion, double* rotation);
/** Sets the layers of a body and those that it is tested against. */
TACT_C_API tact_error tact_world_set_layers(tact_world world, tact_body body, uint32_t layer, uint32_t mask);
/** Sets the group of a body. */
TACT_C_API tact_error tact_world_set_group(tact_world world, tact_body body, uint32_t group);
/** Sets whether two bodies are excluded from tests, whatever their layers: the two sides of a joint, say. */
TACT_C_API tact_error tact_world_set_excluded(tact_world world, tact_body a, tact_body b, bool excluded);
/** Sets how a body moves. */
TACT_C_API tact_error tact_world_set_motion(tact_world world, tact_body body, int32_t motion);
/** Sets how far ahead of a body's surface contact points are seen, metres. */
TACT_C_API tact_error tact_world_set_margin(tact_world world, tact_body body, double margin);
/** Sets what a body adds to the distance that surfaces keep, metres; none takes the margin, whatever that becomes. None
 * is a null pointer. */
TACT_C_API tact_error tact_world_set_rest_offset(tact_world world, tact_body body, const double* rest_offset);
/** Replaces the settings of single vertices and facets of a body. */
TACT_C_API tact_error tact_world_set_feature_settings(tact_world world, tact_body body,
                                                      const tact_feature_settings* settings);
/** Sets whether a body is tested against itself. */
TACT_C_API tact_error tact_world_set_self_contact(tact_world world, tact_body body, bool wanted);
/** Sets which features of a body are too near to each other to be tested against each other. */
TACT_C_API tact_error tact_world_set_self_contact_filter(tact_world world, tact_body body,
                                                         const tact_self_contact_filter* filter);
/** Sets whether features of two labels are excluded from tests: a collar and what it is sewn to, say. */
TACT_C_API tact_error tact_world_set_excluded_labels(tact_world world, const tact_label_pair* labels, bool excluded);
/** Takes one step: finds the contacts of the current positions. The functions tact_report_... tell what it found. */
TACT_C_API tact_error tact_world_detect(tact_world world);
/** Finds what meets between the positions of the last tact_world_detect() and the current ones, every vertex moving
 * straight. `wanted` is a tact_impacts. The functions tact_motion_... tell what it found. */
TACT_C_API tact_error tact_world_detect_motion(tact_world world, int32_t wanted);

/** What tact_world_detect_motion() looks for. */
typedef struct tact_motion_options {
  uint32_t struct_size;
  int32_t wanted;    /**< which impacts */
  bool has_distance; /**< whether `distance` is given */
  /** How near features come to meet, metres, zero or more; by default the sum of their rest offsets. */
  double distance;
  bool bounds; /**< whether to find how far each vertex may go; requires TACT_IMPACTS_ALL */
} tact_motion_options;
#define TACT_MOTION_OPTIONS_INIT \
  { (uint32_t)sizeof(tact_motion_options), 0, false, 0, false }

/** The same by options: the distance at which features meet; bounds of how far each vertex may go. */
TACT_C_API tact_error tact_world_detect_motion_by(tact_world world, const tact_motion_options* options);

/** Gives all that later answers depend on as bytes: settings, bodies, histories. Writes up to `capacity` of them, and
 * how many there are. */
TACT_C_API tact_error tact_world_save(tact_world world, void* bytes, size_t capacity, size_t* count);
/** Goes back to the state of `bytes`, of this world or another: later calls answer as after tact_world_save(), bit for
 * bit. There are `count` of them. */
TACT_C_API tact_error tact_world_restore(tact_world world, const void* bytes, size_t count);

/** Whether `body` names a body of this world. */
TACT_C_API tact_error tact_world_contains(tact_world world, tact_body body, bool* contains);
/** Gives the number of bodies. */
TACT_C_API tact_error tact_world_body_count(tact_world world, size_t* count);
/** Gives the bodies in the order of their index. Writes up to `capacity` of them, and how many there are. */
TACT_C_API tact_error tact_world_bodies(tact_world world, tact_body* bodies, size_t capacity, size_t* count);
/** Gives the name of a body, valid until the body is removed. */
TACT_C_API tact_error tact_world_name(tact_world world, tact_body body, const char** name);
/** What the facets of a body are. */
TACT_C_API tact_error tact_world_surface(tact_world world, tact_body body, tact_surface* surface);
/** How a body moves. */
TACT_C_API tact_error tact_world_motion(tact_world world, tact_body body, tact_motion* motion);
/** The group of a body, or 0. */
TACT_C_API tact_error tact_world_group(tact_world world, tact_body body, uint32_t* group);
/** Whether tact_world_set_excluded() excludes two bodies. */
TACT_C_API tact_error tact_world_excluded(tact_world world, tact_body a, tact_body b, bool* excluded);
/** The layers that a body is on. */
TACT_C_API tact_error tact_world_layer(tact_world world, tact_body body, uint32_t* layer);
/** The layers that a body is tested against. */
TACT_C_API tact_error tact_world_mask(tact_world world, tact_body body, uint32_t* mask);
/** The number that the program gave a body. */
TACT_C_API tact_error tact_world_external_id(tact_world world, tact_body body, uint64_t* external_id);
/** The key of a body: given, or its index. */
TACT_C_API tact_error tact_world_key(tact_world world, tact_body body, uint64_t* key);
/** The margin of a body, metres. */
TACT_C_API tact_error tact_world_margin(tact_world world, tact_body body, double* margin);
/** The rest offset of a body, or its margin, metres. */
TACT_C_API tact_error tact_world_rest_offset(tact_world world, tact_body body, double* rest_offset);
/** Gives the settings of single vertices and facets of a body, valid until they or its facets change. */
TACT_C_API tact_error tact_world_feature_settings(tact_world world, tact_body body, tact_feature_settings* settings);
/** Gives the labels of a feature of a body, whose vertices are named as in a point, a pair or an impact. `vertices` are
 * three; -1 fills up. */
TACT_C_API tact_error tact_world_labels(tact_world world, tact_body body, const int* vertices,
                                        tact_feature_labels* labels);
/** Whether a body is tested against itself. */
TACT_C_API tact_error tact_world_self_contact(tact_world world, tact_body body, bool* wanted);
/** Gives which features of a body are too near to be tested, valid until that or its facets change. */
TACT_C_API tact_error tact_world_self_contact_filter(tact_world world, tact_body body,
                                                     tact_self_contact_filter* filter);
/** Whether tact_world_set_excluded_labels() excludes two labels. */
TACT_C_API tact_error tact_world_excluded_labels(tact_world world, const tact_label_pair* labels, bool* excluded);
/** The number of vertices that were added. */
TACT_C_API tact_error tact_world_vertex_count(tact_world world, tact_body body, size_t* count);
/** The number of facets that were added. */
TACT_C_API tact_error tact_world_facet_count(tact_world world, tact_body body, size_t* count);
/** The number of edges that were added. */
TACT_C_API tact_error tact_world_edge_count(tact_world world, tact_body body, size_t* count);
/** The number of points that were added. */
TACT_C_API tact_error tact_world_point_count(tact_world world, tact_body body, size_t* count);
/** Gives the half-space of a body that tact_world_add_plane() added; none for any other. Then `is_plane` is false. */
TACT_C_API tact_error tact_world_plane(tact_world world, tact_body body, bool* is_plane, tact_plane* plane);

/** A box. */
typedef struct tact_bounds {
  double lower[3]; /**< metres */
  double upper[3]; /**< metres */
} tact_bounds;

/** Copies the current positions of a body, 3 x V metres, column by column; a vertex that no facet, edge or point uses
 * is NaN. `room` counts the numbers of `coordinates`. */
TACT_C_API tact_error tact_world_copy_positions(tact_world world, tact_body body, double* coordinates, size_t room);
/** Copies the facets of a body, 3 x F indices, column by column. `room` counts the numbers of `corners`. */
TACT_C_API tact_error tact_world_copy_facets(tact_world world, tact_body body, int* corners, size_t room);
/** Copies the edges of a body, 2 x E indices, column by column. `room` counts the numbers of `ends`. */
TACT_C_API tact_error tact_world_copy_edges(tact_world world, tact_body body, int* ends, size_t room);
/** Copies the points of a body, P indices. `room` counts the numbers of `vertices`. */
TACT_C_API tact_error tact_world_copy_points(tact_world world, tact_body body, int* vertices, size_t room);
/** Gives the box of a body with its margin, metres; that of a plane is infinite. Without a facet, edge or point, lower
 * is above upper. */
TACT_C_API tact_error tact_world_bounds(tact_world world, tact_body body, tact_bounds* bounds);

/** What tact_world_check_surface() finds. */
typedef enum tact_surface_fault_kind {
  TACT_FAULT_BORDER_EDGE = 0,          /**< an edge of one facet: two vertices */
  TACT_FAULT_BRANCHING_EDGE = 1,       /**< an edge of three or more facets: two vertices */
  TACT_FAULT_TURNED_FACET = 2,         /**< a facet turned against most of its component */
  TACT_FAULT_INSIDE_OUT_COMPONENT = 3, /**< the first facet of a closed component that is inside out */
  TACT_FAULT_CROSSING = 4,             /**< two facets that meet beyond what neighbours share */
  TACT_FAULT_REPEATED_FACET = 5,       /**< a facet, and the first with the same corners */
  TACT_FAULT_REPEATED_VERTEX = 6,      /**< a vertex, and the first at the same place */
  TACT_FAULT_SLIVER = 7,               /**< a facet of hardly any height, or of no area */
  TACT_FAULT_UNUSED_VERTEX = 8         /**< a vertex of no facet, edge or point */
} tact_surface_fault_kind;

/** A fault of a surface. */
typedef struct tact_surface_fault {
  int32_t kind;   /**< tact_surface_fault_kind */
  int32_t first;  /**< the vertex or the facet */
  int32_t second; /**< the other one, or -1 */
} tact_surface_fault;

/** Checks what a body's surface is: borders, turned facets, crossings with itself and more. A facet is a sliver whose
 * height is at most `sliver` times its longest side. `solid` may be null: whether the surface bounds a solid. Faults
 * are sorted by kind. Writes up to `capacity` of them, and how many there are. */
TACT_C_API tact_error tact_world_check_surface(tact_world world, tact_body body, double sliver, bool* solid,
                                               tact_surface_fault* faults, size_t capacity, size_t* count);

/* Meshes: see tact/weld.h. */

/** A mesh in which no two vertices have equal positions. */
typedef struct tact_welded_mesh {
  uint32_t struct_size;
  int32_t vertices;         /**< how many vertices are left */
  int32_t merged_vertices;  /**< how many vertices became one with an earlier vertex */
  int32_t collapsed_facets; /**< how many facets have a vertex twice that had three */
  double* positions;        /**< of each place the first vertex that was given. Room for 3 x V given ones, or null */
  int* facets;              /**< all that were given, in their order. Room for 3 x F, or null */
  int* vertex_of;           /**< for each vertex that was given, its vertex in this mesh. Room for V, or null */
} tact_welded_mesh;
#define TACT_WELDED_MESH_INIT \
  { (uint32_t)sizeof(tact_welded_mesh), 0, 0, 0, NULL, NULL, NULL }

/** Gives a mesh without the vertices that repeat an earlier position; 0 and -0 are equal. */
TACT_C_API tact_error tact_weld(const tact_columns* positions, const tact_columns* facets, tact_welded_mesh* mesh);

/* Recordings: see tact/recording.h. */

/** Records everything that enters the world to the file `path` (UTF-8), from before its first body on; null ends it and
 *  tells whether the file holds all (TACT_ERROR_FILE). It also ends with the world. */
TACT_C_API tact_error tact_world_record(tact_world world, const char* path);

/** Runs a recording again, step by step. {0}: none. */
typedef struct tact_player {
  uint64_t handle;
} tact_player;

/** A step that was run again. */
typedef struct tact_played_step {
  uint32_t struct_size;
  int32_t number;    /**< counted from 0 */
  size_t byte;       /**< where its hash stands in the recording, or the size of the recording */
  bool answered;     /**< whether the step had an answer when it was recorded */
  uint64_t recorded; /**< the hash of the recorded report */
  uint64_t now;      /**< the hash of the report now */
} tact_played_step;
#define TACT_PLAYED_STEP_INIT \
  { (uint32_t)sizeof(tact_played_step), 0, 0, false, 0, 0 }

/** `threads` of -1 uses as many as the recording had. */
TACT_C_API tact_error tact_player_open(const char* path, int32_t threads, tact_player* player);
TACT_C_API tact_error tact_player_close(tact_player player);
/** Runs the calls up to and with the next step. `played` is false at the end. */
TACT_C_API tact_error tact_player_next(tact_player player, tact_played_step* step, bool* played);
/** Gives the byte of the record that the end of the recording cuts off. Known at the end. */
TACT_C_API tact_error tact_player_cut_at(tact_player player, bool* cut, size_t* byte);
/** Gives the world that the calls are made in. */
TACT_C_API tact_error tact_player_world(tact_player player, tact_world* world);
/** Gives the version of tact that wrote the recording. */
TACT_C_API tact_error tact_player_recorded_by(tact_player player, const char** version);

#ifdef __cplusplus
}
#endif

#endif
