#include "scenes/commands/command_line.h"

int main(int argc, char** argv) { return tact::scenes::run_command_line(argc, argv); }
