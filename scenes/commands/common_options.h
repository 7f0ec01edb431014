// The options that the commands share.
#pragma once

#include <tact/settings.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>

namespace tact::scenes {

// A check of CLI11 for options that name a file or a folder: what is wrong with "", as a script gives whose variable is
// not set.
std::string refuse_empty_name(const std::string& name);
// --accuracy hulls|paper|exact
void add_accuracy_option(CLI::App& command, Accuracy& accuracy);
// --threads N; 0 stands for as many as OpenMP would use
void add_threads_option(CLI::App& command, int& threads);
// --json FILE, "-" being standard output
void add_json_option(CLI::App& command, std::string& file);
// --record FILE
void add_record_option(CLI::App& command, std::string& file);
// --trace FILE
void add_trace_option(CLI::App& command, std::string& file);

}  // namespace tact::scenes
