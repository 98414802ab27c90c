#include "eval/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "core/atomic_file.h"

extern char** environ;

namespace stereo_nav::eval {
namespace {

std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Runs gnuplot and returns its exit status. The three standard streams are files, so that no shell, no
/// quoting and no blocking pipe is involved.
int spawnGnuplot(const std::string& script_path, const std::string& svg_path, const std::string& log_path) {
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, 0, script_path.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&streams, 1, svg_path.c_str(), O_WRONLY | O_TRUNC, 0);
  posix_spawn_file_actions_addopen(&streams, 2, log_path.c_str(), O_WRONLY | O_TRUNC, 0);
  // -d: the user's own start-up file must not change the pictures.
  std::string arguments[] = {"gnuplot", "-d"};
  char* argv[] = {arguments[0].data(), arguments[1].data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &streams, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&streams);
  if (error != 0) {
    throw GnuplotError(std::string("no pictures in the report: gnuplot cannot be started (") +
                       std::strerror(error) + "); install it with 'sudo apt-get install gnuplot-nox'");
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

}  // namespace

std::string runGnuplot(const std::string& script, const std::string& path_prefix) {
  // The three files are never committed, so that they are removed when this function ends.
  const AtomicFile script_file(path_prefix + ".gnuplot");
  const AtomicFile svg_file(path_prefix + ".drawing");
  const AtomicFile log_file(path_prefix + ".log");
  std::ofstream(script_file.temporaryPath()) << script;
  const int status =
      spawnGnuplot(script_file.temporaryPath(), svg_file.temporaryPath(), log_file.temporaryPath());
  std::string svg = readFile(svg_file.temporaryPath());
  if (status == 0 && svg.find("</svg>") != std::string::npos) return svg;
  std::string log = readFile(log_file.temporaryPath());
  for (char& c : log) c = c == '\n' ? ' ' : c;
  throw GnuplotError("a picture is missing from the report: gnuplot failed: " + log.substr(0, 300));
}

}  // namespace stereo_nav::eval
