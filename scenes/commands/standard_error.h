// What goes to standard error. Text that it does not take, as it is closed or full, is lost: nobody is left to tell.
#pragma once

#include <string_view>

namespace tact::scenes {

// Gives the program the standard streams that it was started without, as ones that refuse what is written to them. A
// file that is opened later would else stand in their place, and take messages and tables in.
void open_standard_streams();

// Writes `text` as it is.
void write_error(std::string_view text);
// Writes "tact: `message`" as one line: names of files may hold ends of lines.
void print_error(std::string_view message);
// Writes "tact: warning: `message`" as one line.
void print_warning(std::string_view message);

}  // namespace tact::scenes
