/* Functions of JavaScript behind the pointers that the interface for C calls. `user` is the number of the callee. */
#include <tact/tact_c.h>

#define TACT_OF_JS(name) __attribute__((import_module("tact"), import_name(#name)))

TACT_OF_JS(message) void tact_js_message(void* user, const tact_message* message);
TACT_OF_JS(line) void tact_js_line(void* user, const double* from, const double* to, tact_debug_color color);
TACT_OF_JS(triangle)
void tact_js_triangle(void* user, const double* p, const double* q, const double* r, tact_debug_color color);
TACT_OF_JS(text) void tact_js_text(void* user, const double* at, const char* words, tact_debug_color color);

tact_message_function tact_js_message_function(void) { return tact_js_message; }

const tact_debug_drawer* tact_js_drawer(void* user) {
  static tact_debug_drawer drawer = {tact_js_line, tact_js_triangle, tact_js_text, NULL};
  drawer.user = user;
  return &drawer;
}
