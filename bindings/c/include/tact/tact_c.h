/* tact for C99: the whole public interface, with the meaning that the headers of C++ give it (world.h, report.h).
 *
 *   tact_world world;
 *   if (tact_world_create(NULL, &world) != TACT_OK) puts(tact_last_error_message());
 *   tact_body_definition definition = TACT_BODY_DEFINITION_INIT;
 *   ...
 *   tact_world_add_body(world, &definition, &body);
 *   tact_world_set_positions(world, body, &positions);
 *   tact_world_detect(world);
 *
 * Every function returns TACT_OK or an error, of which tact_last_error_message() then tells more; the world is as it
 * was before. A handle that was destroyed or never given out, a null pointer, a wrong size and calls of one world by
 * two threads at once are errors as well, not crashes. (Functions that only read may run at the same time.) Pointers
 * that point to nowhere cannot be told.
 *
 * Arrays that come back belong to the world: they are valid until its next tact_world_detect(),
 * tact_world_set_settings(), tact_world_restore() or tact_world_destroy(). Lengths are metres.
 *
 * Structs begin with their size, by which the library knows which version of this header a program was compiled with:
 * always begin with the TACT_..._INIT of the struct. */
#ifndef TACT_C_H
#define TACT_C_H

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

/** The version of the library, such as "0.1.0". */
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
  TACT_MESSAGE_OPEN_SURFACE = 3     /**< a body was added as closed, and is taken as a sheet */
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
  const int32_t* facet_map;  /**< of each facet the old one whose label it has, or -1 */
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
} tact_feature_settings;
#define TACT_FEATURE_SETTINGS_INIT \
  { (uint32_t)sizeof(tact_feature_settings), NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0 }

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
/** The same with edges and points, of which the other leaves none, and with labels of facets. */
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

/* The report of the last step. */

/** How a contact direction was found. */
typedef enum tact_direction_source {
  TACT_SOURCE_CARRIED = 0, /**< from the direction of the last step */
  TACT_SOURCE_FRESH = 1,   /**< from the direction that last separated the hulls */
  TACT_SOURCE_SMALLEST = 2 /**< as the smallest separation of the hulls */
} tact_direction_source;

/** Which of two bodies lies wholly inside the other, so that no facets meet. */
typedef enum tact_containment {
  TACT_CONTAINMENT_NONE = 0,   /**< neither, or TACT_ACCURACY_HULLS */
  TACT_CONTAINMENT_A_IN_B = 1, /**< a lies inside b, a closed body */
  TACT_CONTAINMENT_B_IN_A = 2  /**< b lies inside a, a closed body */
} tact_containment;

/**
 * Two facets that share at least one point. Facets of one body that name common vertices are a pair where they share
 * more than these vertices and the edge between them.
 */
typedef struct tact_facet_pair {
  int a; /**< facet of the first body */
  int b; /**< facet of the second */
} tact_facet_pair;

/** The smallest disk around an impact zone, seen along the contact direction. */
typedef struct tact_zone_disk {
  double center[3]; /**< metres */
  double radius;    /**< metres; negative where no zone is computed or it is empty */
} tact_zone_disk;

/** Two bodies whose convex hulls overlap or touch, decided exactly, or are nearer than the sum of the margins. */
typedef struct tact_contact {
  uint32_t struct_size;
  tact_body a;         /**< its key is below that of b; equal to b for a body with itself */
  tact_body b;         /**< the second body */
  double direction[3]; /**< unit vector from a to b: moving b by depth * direction separates the hulls */
  double depth;   /**< the overlap of the hulls along `direction`, metres; minus their distance where they are apart */
  int32_t source; /**< tact_direction_source */
  int32_t iterations;    /**< shifted calls of GJK that it took */
  bool limit_reached;    /**< whether GJK or the direction stopped at a limit, with the best direction found */
  bool touching;         /**< whether facets meet, or a point's gap is below the sum of the rest offsets */
  double plane_a;        /**< the contact plane direction * x = plane_a, the farthest that the hull of a reaches */
  double plane_b;        /**< the contact plane direction * x = plane_b, the nearest that the hull of b reaches */
  tact_zone_disk zone_a; /**< around the part of a between the planes */
  tact_zone_disk zone_b; /**< around the part of b between the planes */
  int64_t kept_facets_a; /**< facets of a left after the criteria */
  int64_t kept_facets_b; /**< facets of b left after the criteria */
  const tact_facet_pair* facet_pairs; /**< the facets that meet, sorted; empty at TACT_ACCURACY_HULLS */
  size_t facet_pair_count;
  size_t patch_count;  /**< see tact_contact_patch() */
  int32_t containment; /**< which body lies wholly inside the other, decided exactly; the direction leads out of it */
  /** whether a sheet crosses itself deeper than its crossing edges are long: vertices there have no point */
  bool point_limit_reached;
  size_t curve_count; /**< see tact_contact_curve() */
} tact_contact;
#define TACT_CONTACT_INIT                                                                                          \
  {                                                                                                                \
    (uint32_t)sizeof(tact_contact), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, false, false, 0, 0, {{0, 0, 0}, -1}, \
        {{0, 0, 0}, -1}, 0, 0, NULL, 0, 0, 0, false, 0                                                             \
  }

/** A connected set of facet pairs and contact points: a place where two bodies touch or nearly do. */
typedef struct tact_patch {
  uint32_t struct_size;
  double point[3];     /**< the middle of its points, or of the boxes that its facet pairs have in common; metres */
  double direction[3]; /**< unit vector from a to b: the mean normal of its points, weighted by depth, or of its facets,
                          by area */
  double depth; /**< metres: minus the smallest gap of its points, or how far b moves along `direction` to part its
                   facet pairs */
  const int* facet_pairs; /**< indices into tact_contact.facet_pairs, ascending */
  size_t facet_pair_count;
  uint64_t id; /**< the same in the next step if both share most of their vertices; made from both keys, the step of its
                  beginning and its place */
  double area; /**< the area of the convex hull of its points, seen along `direction`; square metres */
  const int* points; /**< indices into tact_contact_points(), ascending */
  size_t point_count;
  int spanning[4]; /**< at most four of `points`: the deepest, and those that span the most area; kept while they nearly
                      do. -1 fills up */
} tact_patch;
#define TACT_PATCH_INIT                                                                               \
  {                                                                                                   \
    (uint32_t)sizeof(tact_patch), {0, 0, 0}, {0, 0, 0}, 0, NULL, 0, 0, 0, NULL, 0, { -1, -1, -1, -1 } \
  }

/** The features of bodies a and b that are nearest, or that meet. Of the last five either feature is of no facet. */
typedef enum tact_feature_pair {
  TACT_VERTEX_FACET = 0,  /**< a vertex of a, a facet of b */
  TACT_FACET_VERTEX = 1,  /**< a facet of a, a vertex of b */
  TACT_EDGE_EDGE = 2,     /**< an edge of each */
  TACT_VERTEX_EDGE = 3,   /**< a vertex of a, an edge of b */
  TACT_EDGE_VERTEX = 4,   /**< an edge of a, a vertex of b */
  TACT_VERTEX_VERTEX = 5, /**< a vertex of each */
  TACT_VERTEX_PLANE = 6,  /**< a vertex of a, b is a plane */
  TACT_PLANE_VERTEX = 7   /**< a is a plane, a vertex of b */
} tact_feature_pair;

/** A point on each of two surfaces, where features are nearest or have crossed. */
typedef struct tact_contact_point {
  int32_t kind; /**< tact_feature_pair */
  int patch; /**< the number of its patch, counted from 0: an index into tact_contact_patch(), if tact_settings.patches
                is set */
  int a_vertices[3];   /**< vertices of the smallest feature of a that holds the point; -1 fills up */
  int b_vertices[3];   /**< the same of b */
  double a_weights[3]; /**< weights of the vertices of a, not negative, with a sum of 1 */
  double b_weights[3]; /**< the same of b */
  double normal[3]; /**< unit vector from the point of a to that of b; the normal of a facet where the two coincide */
  double gap;  /**< the distance of the two points along the normal, metres; negative where the surfaces have crossed */
  uint64_t id; /**< the same in every step in which these features are near: a key for impulses */
  bool minimum; /**< whether nothing beside it on either surface is nearer along its normal, which lies in the normal
                   cones of both features */
} tact_contact_point;

/** Where an edge of one surface goes through a facet of the other; a corner of an intersection curve. */
typedef struct tact_curve_point {
  double position[3]; /**< metres; the exact place, rounded once */
  double fraction;    /**< how far along the edge, 0 to 1 */
  int edge[2]; /**< the vertices of the edge, ascending. The second is -1 at a common vertex of two facets of one body
                */
  int facet;   /**< the facet that the edge goes through; -1 at a common vertex */
  int facet_pair; /**< the facets that hold the way to the next point: an index into tact_contact.facet_pairs. -1: no
                     way leads on */
  bool edge_of_b; /**< whether the edge is of b, and the facet of a */
} tact_curve_point;

/** A polyline of points on both surfaces. */
typedef struct tact_curve {
  uint32_t struct_size;
  bool closed;                    /**< whether the last point leads on to the first */
  const tact_curve_point* points; /**< in order */
  size_t point_count;
} tact_curve;
#define TACT_CURVE_INIT \
  { (uint32_t)sizeof(tact_curve), false, NULL, 0 }

/** A vertex and a facet, or two edges, that are nearer to each other than the sum of the margins. Of one body, features
 * without a common vertex. */
typedef struct tact_reach_pair {
  int32_t kind;        /**< tact_feature_pair */
  int a_vertices[3];   /**< vertices of the feature of a, each once; -1 fills up. Those of edges ascend */
  int b_vertices[3];   /**< the same of b */
  double a_weights[3]; /**< weights, with a sum of 1, of the place of a nearest to b; above zero are those of the
                          closest vertex, edge or facet alone */
  double b_weights[3]; /**< the same of b */
  double normal[3];    /**< unit vector from the place of a to that of b; zero where the two coincide */
  double distance;     /**< how far the two places are apart, metres */
} tact_reach_pair;

/** Two bodies whose boxes overlap. */
typedef struct tact_candidate_pair {
  tact_body a;        /**< its key is below that of b */
  tact_body b;        /**< the second body */
  bool hulls_overlap; /**< whether their hulls overlap or touch */
} tact_candidate_pair;

/** Two bodies, or one with itself, that began or ceased to touch in this step: see tact_contact.touching. */
typedef struct tact_contact_event {
  tact_body a; /**< its key is not above that of b */
  tact_body b; /**< the second body */
} tact_contact_event;

/** What became of the patch. */
typedef enum tact_patch_event_kind {
  TACT_PATCH_BEGAN = 0,  /**< it is new */
  TACT_PATCH_SPLIT = 1,  /**< it is new, and was a part of the patch `other`, which persists */
  TACT_PATCH_MERGED = 2, /**< it became a part of the patch `other` */
  TACT_PATCH_ENDED = 3   /**< it is gone */
} tact_patch_event_kind;

/** A change of a patch in this step. */
typedef struct tact_patch_event {
  tact_body a;    /**< its key is not above that of b */
  tact_body b;    /**< the second body */
  int32_t kind;   /**< tact_patch_event_kind */
  uint64_t patch; /**< its id */
  uint64_t other; /**< the id of the other patch, or 0 */
} tact_patch_event;

/** A count or a time of the step. */
typedef struct tact_statistic {
  const char* name;
  const char* text;
  bool is_time;
  int64_t count; /**< 0 if it is a time */
  double ms;     /**< 0 if it is a count */
} tact_statistic;

/** A part of one thread's work: see tact::TraceEvent. Times are nanoseconds of the steady clock. */
typedef struct tact_trace_event {
  uint32_t struct_size;
  int32_t kind; /**< in the order of tact::TraceEvent::Kind */
  int32_t thread;
  int64_t begin_ns;
  int64_t end_ns;
  tact_body a;
  tact_body b;
  int64_t count;
} tact_trace_event;
#define TACT_TRACE_EVENT_INIT \
  { (uint32_t)sizeof(tact_trace_event), 0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, 0 }

/** Gives the contacts, sorted by (a, b). `count` is their number; each of them is tact_report_contact(). */
TACT_C_API tact_error tact_report_contacts(tact_world world, size_t* count);
/** The contact `index` of those, sorted by bodies. */
TACT_C_API tact_error tact_report_contact(tact_world world, size_t index, tact_contact* contact);
/** Gives the contact of two bodies, in either order, if they have one. The number of contacts stands for none. */
TACT_C_API tact_error tact_report_find_contact(tact_world world, tact_body a, tact_body b, size_t* index);
/** The patch `patch` of the contact `index`. */
TACT_C_API tact_error tact_contact_patch(tact_world world, size_t index, size_t patch, tact_patch* result);
/** Gives the points, if tact_settings.points is set; sorted by kind, then by features. */
TACT_C_API tact_error tact_contact_points(tact_world world, size_t index, const tact_contact_point** points,
                                          size_t* count);
/** Gives one of the curves in which the surfaces cross, if tact_settings.curves is set; sorted by their first facet
 * pair. */
TACT_C_API tact_error tact_contact_curve(tact_world world, size_t index, size_t curve, tact_curve* result);
/** Gives every vertex and facet, and every two edges, nearer than the sum of the margins, if
 * tact_settings.within_reach is set; sorted by kind, then by features. */
TACT_C_API tact_error tact_contact_within_reach(tact_world world, size_t index, const tact_reach_pair** pairs,
                                                size_t* count);
/** Gives a number made from every bit of the contact, its facet pairs, points, pairs within reach and patches, but for
 * counts of work. Bodies enter it by their keys alone. */
TACT_C_API tact_error tact_contact_hash(tact_world world, size_t index, uint64_t* hash);
/** Gives the pairs whose boxes overlap, sorted by (a, b). */
TACT_C_API tact_error tact_report_candidate_pairs(tact_world world, const tact_candidate_pair** pairs, size_t* count);
/** Gives the contacts that touch now and did not in the last step, sorted by (a, b). */
TACT_C_API tact_error tact_report_began(tact_world world, const tact_contact_event** events, size_t* count);
/** Gives the contacts that touched in the last step and do not now, sorted by (a, b); ids of removed bodies are stale.
 */
TACT_C_API tact_error tact_report_ended(tact_world world, const tact_contact_event** events, size_t* count);
/** Gives the changes of patches, if tact_settings.patches is set; sorted by (a, b), ends before beginnings. */
TACT_C_API tact_error tact_report_patch_events(tact_world world, const tact_patch_event** events, size_t* count);
/** Gives counts and times of the step. Writes up to `capacity` of them, counts before times, and how many there are. */
TACT_C_API tact_error tact_report_stats(tact_world world, tact_statistic* statistics, size_t capacity, size_t* count);
/** Gives what each thread did, if tact_settings.trace is set; sorted by thread and time, outer events first. `count` is
 * their number; each of them is tact_report_trace_event(). */
TACT_C_API tact_error tact_report_trace(tact_world world, size_t* count);
TACT_C_API tact_error tact_report_trace_event(tact_world world, size_t index, tact_trace_event* event);
/** Gives a number made from every bit of candidate pairs, contacts, facet pairs, points and pairs within reach; bodies
 * enter it by their keys. */
TACT_C_API tact_error tact_report_hash(tact_world world, uint64_t* hash);
/** Copies a report; memory is reused. `kept` is zero, or of an earlier call; any thread may read it by
 * tact_report_...(), whatever the world does, until tact_world_destroy(). As a world it holds no bodies. */
TACT_C_API tact_error tact_report_keep(tact_world world, tact_world* kept);

/** Arrays for the contact points of a whole report. A null one is left out. */
typedef struct tact_point_arrays {
  uint32_t struct_size;
  uint32_t* bodies;    /**< the index of body a and of body b, 2 a point */
  int* contacts;       /**< the number of its contact, counted from 0 */
  uint8_t* kinds;      /**< which features these are, as numbers */
  int* a_vertices;     /**< vertices of a, 3 a point; -1 fills up */
  int* b_vertices;     /**< vertices of b, 3 a point; -1 fills up */
  double* a_weights;   /**< weights of the vertices of a, 3 a point */
  double* b_weights;   /**< weights of the vertices of b, 3 a point */
  double* normals;     /**< unit vectors from a to b, 3 a point */
  double* gaps;        /**< metres; negative where the surfaces have crossed */
  uint64_t* ids;       /**< the same in every step in which these features are near */
  uint64_t* patch_ids; /**< ids of the patches, or 0 where patches are not requested */
  uint8_t* minima;     /**< 1 if nothing beside it on either surface is nearer, else 0 */
} tact_point_arrays;
#define TACT_POINT_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_point_arrays), NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL }

/** Arrays for the facet pairs of a whole report. A null one is left out. */
typedef struct tact_facet_pair_arrays {
  uint32_t struct_size;
  uint32_t* bodies; /**< the index of body a and of body b, 2 a pair */
  int* contacts;    /**< the number of its contact, counted from 0 */
  int* facets;      /**< the facet of a and that of b, 2 a pair */
} tact_facet_pair_arrays;
#define TACT_FACET_PAIR_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_facet_pair_arrays), NULL, NULL, NULL }

/** Arrays for the pairs within reach of a whole report. A null one is left out. */
typedef struct tact_reach_pair_arrays {
  uint32_t struct_size;
  uint32_t* bodies;  /**< the index of body a and of body b, 2 a pair */
  int* contacts;     /**< the number of its contact, counted from 0 */
  uint8_t* kinds;    /**< which features these are, as numbers */
  int* a_vertices;   /**< vertices of a, 3 a pair; -1 fills up */
  int* b_vertices;   /**< vertices of b, 3 a pair; -1 fills up */
  double* a_weights; /**< weights of the vertices of a, 3 a pair */
  double* b_weights; /**< weights of the vertices of b, 3 a pair */
  double* normals;   /**< unit vectors from a to b, 3 a pair; zero where the distance is */
  double* distances; /**< metres */
} tact_reach_pair_arrays;
#define TACT_REACH_PAIR_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_reach_pair_arrays), NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL }

/** Gives the number of contact points of all contacts. */
TACT_C_API tact_error tact_report_point_count(tact_world world, size_t* count);
/** Gives the number of pairs within reach of all contacts. */
TACT_C_API tact_error tact_report_reach_pair_count(tact_world world, size_t* count);
/** Gives the number of facet pairs of all contacts. */
TACT_C_API tact_error tact_report_facet_pair_count(tact_world world, size_t* count);
/** Fills arrays with the points of all contacts, in their order. `rows` is the number of points that they have room
 * for: tact_report_point_count(). */
TACT_C_API tact_error tact_report_copy_points(tact_world world, const tact_point_arrays* arrays, size_t rows);
/** Fills arrays with the pairs within reach of all contacts, in their order. `rows` is tact_report_reach_pair_count().
 */
TACT_C_API tact_error tact_report_copy_reach_pairs(tact_world world, const tact_reach_pair_arrays* arrays, size_t rows);
/** Fills arrays with the facet pairs of all contacts, in their order. `rows` is tact_report_facet_pair_count(). */
TACT_C_API tact_error tact_report_copy_facet_pairs(tact_world world, const tact_facet_pair_arrays* arrays, size_t rows);

/** A vertex of a body. */
typedef struct tact_vertex_of_body {
  tact_body body; /**< the body of the vertex */
  int vertex;     /**< counted from 0 */
} tact_vertex_of_body;

/** What a solver did at a contact point: an impulse in N s, or a force in N. */
typedef struct tact_point_impulse {
  uint64_t id;       /**< tact_contact_point.id */
  double impulse[3]; /**< on b; a has the opposite */
} tact_point_impulse;

/** What a sum is over. */
typedef enum tact_sum_kind {
  TACT_SUM_CONTACT = 0, /**< two bodies, or one with itself */
  TACT_SUM_PATCH = 1,   /**< a patch of the contact before it */
  TACT_SUM_BODY = 2     /**< all contacts of `a`; `b` is no body */
} tact_sum_kind;

/** The sum over the points of a contact, a patch or a body. */
typedef struct tact_contact_sum {
  int32_t kind;       /**< tact_sum_kind */
  tact_body a;        /**< the first body */
  tact_body b;        /**< the second body, which `normal` and `force` push */
  uint64_t patch;     /**< the id of the patch, or 0 */
  int points;         /**< the number of contact points */
  double area;        /**< the areas of the patches, square metres; 0 where tact_settings.patches is not set */
  double deepest_gap; /**< the smallest gap, metres; infinity without points */
  double mean_gap;    /**< metres */
  double center[3];   /**< the mean place of its points, metres */
  double normal[3];   /**< the mean of the normals towards `b`, or towards the body of a sum over a body; shorter than 1
                         where they differ */
  double force[3];    /**< the sum of the impulses on `b`, or on the body */
  double torque[3];   /**< their moment about `center` */
  size_t first_vertex; /**< where the vertices that its points name begin, each once, in order */
  size_t vertex_count;
} tact_contact_sum;

/** Room for what tact_report_sum_contacts() gives, and how much there is. */
typedef struct tact_contact_sums {
  uint32_t struct_size;
  tact_contact_sum* sums; /**< each contact with points, followed by its patches; then the bodies of these, in the order
                             of their index. May be null */
  size_t sum_capacity;
  size_t sum_count;
  tact_vertex_of_body* vertices; /**< those of all sums. May be null */
  size_t vertex_capacity;
  size_t vertex_count;
} tact_contact_sums;
#define TACT_CONTACT_SUMS_INIT \
  { (uint32_t)sizeof(tact_contact_sums), NULL, 0, 0, NULL, 0, 0 }

/** Adds up the points of the last step, at the current positions. Points without an impulse have none; impulses without
 * a point are left out. */
TACT_C_API tact_error tact_report_sum_contacts(tact_world world, const tact_point_impulse* impulses, size_t count,
                                               tact_contact_sums* sums);

/* What tact_world_detect_motion() found; valid until it is called again. */

/** Which impacts tact_world_detect_motion() finds. */
typedef enum tact_impacts {
  TACT_IMPACTS_ALL = 0,           /**< every pair of features that meets */
  TACT_IMPACTS_FIRST_OF_PAIR = 1, /**< the earliest of each pair of bodies; faster */
  TACT_IMPACTS_FIRST = 2          /**< the earliest of all; the fastest */
} tact_impacts;

/** A vertex and a facet, or two edges, that meet between the last step and now. */
typedef struct tact_impact {
  tact_body a;       /**< its key is below that of b; equal to b for a body with itself */
  tact_body b;       /**< the second body */
  int32_t kind;      /**< tact_feature_pair */
  double time;       /**< the part of the way, 0 to 1, at which they first meet; never later than the true time */
  int a_vertices[3]; /**< vertices of the feature of a; -1 fills up */
  int b_vertices[3]; /**< vertices of the feature of b; -1 fills up */
  /** False if they touch and part, or slide along each other: the surfaces around them do not cross there. */
  bool stops;
} tact_impact;

/** Two bodies, or one with itself, with at least one impact. */
typedef struct tact_impact_pair {
  uint32_t struct_size;
  tact_body a;                /**< its key is not above that of b */
  tact_body b;                /**< the second body */
  double first_time;          /**< the earliest time of the impacts that stop; infinity if none does */
  const tact_impact* impacts; /**< sorted by time; valid as long as the report */
  size_t impact_count;
} tact_impact_pair;
#define TACT_IMPACT_PAIR_INIT \
  { (uint32_t)sizeof(tact_impact_pair), {0, 0, 0}, {0, 0, 0}, 0, NULL, 0 }

/** Counts and times, milliseconds, of tact_world_detect_motion(). */
typedef struct tact_motion_statistics {
  uint32_t struct_size;
  int64_t moved_bodies;  /**< bodies with other positions than in the last step */
  int64_t body_pairs;    /**< pairs of bodies whose boxes come near on their way, and bodies with themselves */
  int64_t cluster_pairs; /**< pairs of clusters whose boxes come near on their way */
  int64_t candidates;    /**< pairs of features whose boxes come near on their way */
  int64_t searched;      /**< candidates that the filter left undecided */
  int64_t spans;         /**< parts of the way that the search looked at */
  int64_t impacts;
  double sweep_ms;  /**< the search for bodies that pass each other */
  double search_ms; /**< all other work */
} tact_motion_statistics;
#define TACT_MOTION_STATISTICS_INIT \
  { (uint32_t)sizeof(tact_motion_statistics), 0, 0, 0, 0, 0, 0, 0, 0, 0 }

/** Gives the earliest time of an impact that stops, 0 to 1; infinity if none does. */
TACT_C_API tact_error tact_motion_first_time(tact_world world, double* time);
/** Gives the impacts, sorted by (a, b), time and features. */
TACT_C_API tact_error tact_motion_impacts(tact_world world, const tact_impact** impacts, size_t* count);
/** Gives the pairs of bodies that meet, sorted by (a, b). `count` is their number; each of them is tact_motion_pair().
 */
TACT_C_API tact_error tact_motion_pairs(tact_world world, size_t* count);
TACT_C_API tact_error tact_motion_pair(tact_world world, size_t index, tact_impact_pair* pair);
/** Gives for each vertex of a body how far along its way it may go, 0 to 1, if bounds were requested. All may go so
 * far at once, and meet nothing. It is empty for a body that did not move. */
TACT_C_API tact_error tact_motion_bounds(tact_world world, tact_body body, const double** bounds, size_t* count);
/** Gives counts and times. */
TACT_C_API tact_error tact_motion_stats(tact_world world, tact_motion_statistics* statistics);

/** Arrays for the impacts of a motion report. A null one is left out. */
typedef struct tact_impact_arrays {
  uint32_t struct_size;
  uint32_t* bodies; /**< the index of body a and of body b, 2 an impact */
  uint8_t* kinds;   /**< which features meet, as numbers */
  double* times;    /**< the parts of the way, 0 to 1, at which they first meet */
  int* a_vertices;  /**< vertices of a, 3 an impact; -1 fills up */
  int* b_vertices;  /**< vertices of b, 3 an impact; -1 fills up */
  uint8_t* stops;   /**< 0 where they part or slide along each other, else 1 */
} tact_impact_arrays;
#define TACT_IMPACT_ARRAYS_INIT \
  { (uint32_t)sizeof(tact_impact_arrays), NULL, NULL, NULL, NULL, NULL, NULL }

/** Fills arrays with the impacts of a motion report, in their order. `rows` is the count that tact_motion_impacts()
 * gives. */
TACT_C_API tact_error tact_motion_copy_impacts(tact_world world, const tact_impact_arrays* arrays, size_t rows);

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
 * of each stencil in `limits`, newtons. Below `smoothing` metres the force grows smoothly. */
TACT_C_API tact_error tact_stencil_friction(const tact_stencil* stencils, size_t count, const double* moved,
                                            size_t vertex_count, const double* limits, double smoothing,
                                            tact_terms terms);
/** Gives a colour to each stencil; two of one colour share no vertex below `moving`. */
TACT_C_API tact_error tact_stencil_colors(const tact_stencil* stencils, size_t count, size_t moving, int32_t* colors);

/* Queries to the surfaces where they are now. */

/** A segment, ends included. */
typedef struct tact_ray {
  double from[3]; /**< metres */
  double to[3];   /**< metres */
  uint32_t layer; /**< the layers that the query is on */
  uint32_t mask;  /**< the layers that the query considers */
} tact_ray;
#define TACT_RAY_INIT \
  { {0, 0, 0}, {0, 0, 0}, 0xffffffffu, 0xffffffffu }

/** Which facet tact_world_cast_ray() returns. */
typedef enum tact_ray_hits {
  TACT_RAY_FIRST = 0, /**< the first facet on the way; of several at one place the least by body and facet */
  TACT_RAY_ANY = 1    /**< some facet on the way; faster */
} tact_ray_hits;

/** A facet that a ray meets. */
typedef struct tact_ray_hit {
  tact_body body;        /**< the body of the facet */
  int facet;             /**< negative: the ray meets nothing */
  double fraction;       /**< the place on the ray: from + fraction * (to - from) */
  double barycentric[3]; /**< the place on the facet: weights of its corners, not negative, with a sum of 1 */
} tact_ray_hit;

/** A point, and how far the answer may be away. */
typedef struct tact_point_query {
  double point[3]; /**< metres */
  double within;   /**< metres, at least 0 */
  uint32_t layer;  /**< the layers that the query is on */
  uint32_t mask;   /**< the layers that the query considers */
} tact_point_query;
#define TACT_POINT_QUERY_INIT \
  { {0, 0, 0}, HUGE_VAL, 0xffffffffu, 0xffffffffu }

/** The nearest place of all surfaces; of equally near ones the least by body and facet. */
typedef struct tact_closest_point {
  tact_body body;        /**< the body of the facet */
  int facet;             /**< negative: no facet is within reach */
  double distance;       /**< metres; infinity where no facet is within reach */
  double barycentric[3]; /**< the place on the facet: weights of its corners, not negative, with a sum of 1 */
} tact_closest_point;

/** A closed box. */
typedef struct tact_box_query {
  double lower[3]; /**< metres */
  double upper[3]; /**< metres, not below `lower` */
  uint32_t layer;  /**< the layers that the query is on */
  uint32_t mask;   /**< the layers that the query considers */
} tact_box_query;
#define TACT_BOX_QUERY_INIT TACT_RAY_INIT

/** A facet of a body. */
typedef struct tact_facet_of_body {
  tact_body body; /**< the body of the facet */
  int facet;      /**< counted from 0 */
} tact_facet_of_body;

/** Two bodies, and how far they may be apart. */
typedef struct tact_distance_query {
  tact_body a;   /**< the first body */
  tact_body b;   /**< another body */
  double within; /**< metres, at least 0: what is farther is not looked for */
} tact_distance_query;
#define TACT_DISTANCE_QUERY_INIT \
  { {0, 0, 0}, {0, 0, 0}, HUGE_VAL }

/** Which bodies are nearest to a body. */
typedef struct tact_nearest_bodies_query {
  tact_body body; /**< the body from which distances are measured */
  size_t count;   /**< how many bodies at most */
  double within;  /**< metres, at least 0 */
  uint32_t layer; /**< the layers that the query is on */
  uint32_t mask;  /**< the layers that the query considers */
} tact_nearest_bodies_query;
#define TACT_NEAREST_BODIES_QUERY_INIT \
  { {0, 0, 0}, 1, HUGE_VAL, 0xffffffffu, 0xffffffffu }

/** The least distance of the surfaces of two bodies, and where it is; of equally near facets the least of a, then of
 * b. */
typedef struct tact_body_distance {
  tact_body a; /**< the first body, as requested */
  tact_body b; /**< the second body */
  /** Metres: zero exactly where the surfaces share a point, else right to 1e-12 of both bodies' size; infinity where
   * they are farther apart than requested. */
  double distance;
  int a_facet;             /**< negative: farther apart than requested */
  int b_facet;             /**< likewise */
  double a_barycentric[3]; /**< the place on a's facet: weights of its corners; zero on a plane */
  double b_barycentric[3]; /**< the place on b's facet */
  int32_t containment;     /**< whether one lies wholly inside the other, whose surfaces are apart */
} tact_body_distance;

/** A way of a body as a whole: it goes straight and turns at the same time, both evenly. At fraction s a vertex at p is
 * at center + s * way + R * (p - center), where R turns about `axis` by s * angle. */
typedef struct tact_sweep {
  tact_body body;   /**< the body that is moved, from where it is now */
  double way[3];    /**< how far it goes, metres */
  double axis[3];   /**< what it turns about, of any length but zero */
  double center[3]; /**< a point of the axis where the way begins, metres */
  double angle;     /**< radians, at most 1000 in size; counter-clockwise about `axis` */
  uint32_t layer;   /**< the layers that the query is on */
  uint32_t mask;    /**< the layers that the query considers */
} tact_sweep;
#define TACT_SWEEP_INIT \
  { {0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 0, 0xffffffffu, 0xffffffffu }

/** The first facet that a swept body meets; of equal fractions the least by body, then by facets. */
typedef struct tact_sweep_hit {
  tact_body body; /**< the body that is met */
  int facet;      /**< of the swept body; negative: it meets nothing */
  int other;      /**< the facet of `body` that it meets */
  /** The part of the way, 0 to 1, that is free: never later than the true one. Earlier by the time that the facets take
   * for the last 1e-13 of their size and way. */
  double fraction;
  double normal[3];            /**< unit vector from `facet` to `other`; zero if they meet at once */
  double barycentric[3];       /**< the place on `facet`: weights of its corners */
  double other_barycentric[3]; /**< the place on `other` */
} tact_sweep_hit;

/** What two closed bodies have in common. */
typedef struct tact_overlap {
  double volume; /**< cubic metres */
  double area;   /**< of its surface, square metres; zero where the bodies only touch */
} tact_overlap;

/** Gives the first facet that a ray meets, or any. `wanted` is a tact_ray_hits. */
TACT_C_API tact_error tact_world_cast_ray(tact_world world, const tact_ray* ray, int32_t wanted, tact_ray_hit* hit);
/** Answers many rays in parallel. */
TACT_C_API tact_error tact_world_cast_rays(tact_world world, const tact_ray* rays, size_t count, int32_t wanted,
                                           tact_ray_hit* hits);
/** Gives all facets that a ray meets, sorted by fraction, body and facet. Writes up to `capacity` of them, and how many
 * there are. */
TACT_C_API tact_error tact_world_cast_ray_all(tact_world world, const tact_ray* ray, tact_ray_hit* hits,
                                              size_t capacity, size_t* count);
/** Gives the facets that share a point with a box, decided exactly; sorted by body and facet. Writes up to `capacity`
 * of them, and how many there are. */
TACT_C_API tact_error tact_world_overlap_box(tact_world world, const tact_box_query* query, tact_facet_of_body* facets,
                                             size_t capacity, size_t* count);
/** Gives the closed bodies that contain a point or have it on their surface, decided exactly; ignores `within`. Writes
 * up to `capacity` of them, and how many there are. */
TACT_C_API tact_error tact_world_bodies_containing(tact_world world, const tact_point_query* query, tact_body* bodies,
                                                   size_t capacity, size_t* count);
/** Finds the facets in many boxes in parallel. Answers follow each other: that of query
 * i ends at ends[i]. Up to `capacity` are written; ends[count - 1] is how many there are. */
TACT_C_API tact_error tact_world_overlap_boxes(tact_world world, const tact_box_query* queries, size_t count,
                                               tact_facet_of_body* facets, size_t capacity, size_t* ends);
/** Finds the bodies that contain many points in parallel. Laid out as by
 * tact_world_overlap_boxes(). */
TACT_C_API tact_error tact_world_bodies_containing_each(tact_world world, const tact_point_query* queries, size_t count,
                                                        tact_body* bodies, size_t capacity, size_t* ends);
/** Gives the nearest place of all surfaces to a point. */
TACT_C_API tact_error tact_world_closest_point(tact_world world, const tact_point_query* query,
                                               tact_closest_point* answer);
/** Finds the nearest places to many points in parallel. */
TACT_C_API tact_error tact_world_closest_points(tact_world world, const tact_point_query* queries, size_t count,
                                                tact_closest_point* answers);

/** Gives the nearest surface of closed bodies and planes; its distance is minus the depth where one contains the
 * point: the deepest, at any depth. */
TACT_C_API tact_error tact_world_signed_distance(tact_world world, const tact_point_query* query,
                                                 tact_closest_point* answer);
/** Finds the signed distances of many points in parallel. */
TACT_C_API tact_error tact_world_signed_distances(tact_world world, const tact_point_query* queries, size_t count,
                                                  tact_closest_point* answers);
/** Gives the least distance of two bodies. */
TACT_C_API tact_error tact_world_distance(tact_world world, const tact_distance_query* query,
                                          tact_body_distance* answer);
/** Finds the distances of many pairs of bodies in parallel. */
TACT_C_API tact_error tact_world_distances(tact_world world, const tact_distance_query* queries, size_t count,
                                           tact_body_distance* answers);
/** Gives the bodies nearest to one, sorted by distance and body. Writes up to `capacity` of them, and how many there
 * are. */
TACT_C_API tact_error tact_world_nearest_bodies(tact_world world, const tact_nearest_bodies_query* query,
                                                tact_body_distance* answers, size_t capacity, size_t* count);
/** Gives what a body meets first when it is moved straight or turned, all others standing still. */
TACT_C_API tact_error tact_world_sweep(tact_world world, const tact_sweep* sweep, tact_sweep_hit* hit);
/** Finds what many sweeps meet in parallel. */
TACT_C_API tact_error tact_world_sweeps(tact_world world, const tact_sweep* queries, size_t count,
                                        tact_sweep_hit* hits);
/** Gives volume and surface of what two closed bodies that do not cross themselves have in common. */
TACT_C_API tact_error tact_world_overlap(tact_world world, tact_body a, tact_body b, tact_overlap* overlap);

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
} tact_debug_draw_options;

/** Fills in the defaults of all fields, struct_size included. */
TACT_C_API tact_error tact_debug_draw_defaults(tact_debug_draw_options* options);
/** Draws what the last step found; `options` may be null: the default. */
TACT_C_API tact_error tact_world_debug_draw(tact_world world, const tact_debug_drawer* drawer,
                                            const tact_debug_draw_options* options);

#ifdef __cplusplus
}
#endif

#endif
