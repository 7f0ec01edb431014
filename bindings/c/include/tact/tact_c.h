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

#include <tact/tact_c_debug_draw.h>
#include <tact/tact_c_motion.h>
#include <tact/tact_c_queries.h>
#include <tact/tact_c_report.h>
#include <tact/tact_c_solver.h>
#include <tact/tact_c_world.h>

#endif
