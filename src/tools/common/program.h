#pragma once

#include <boost/program_options/errors.hpp>
#include <cstdio>
#include <exception>

namespace stereo_nav::tools {

/// Runs a program and reports its errors: one line on standard error that begins with the program's name, and
/// exit status 2. Errors of the command line point to --help.
inline int runProgram(const char* name, int (*run)(int, char**), int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const boost::program_options::error& error) {
    std::fprintf(stderr, "%s: %s; see %s --help\n", name, error.what(), name);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
  }
  return 2;
}

}  // namespace stereo_nav::tools
