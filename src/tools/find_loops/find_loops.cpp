// Finds the places that a camera came back to, without a master, and writes list, figures and pictures.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "core/atomic_file.h"
#include "tools/common/program.h"
#include "tools/find_loops/find_loops_options.h"
#include "tools/find_loops/image_folder.h"
#include "tools/find_loops/loop_report.h"
#include "tools/find_loops/recorded_loops.h"

namespace stereo_nav::tools {
namespace {

void showProgress(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "\r%zu of %zu frames%s", done, all, done == all ? "\n" : "");
}

/// Of the first accepted loops.
void writePictures(const FindLoopsOptions& options, const LoopRun& run) {
  int pictures = 0;
  for (const mapping::LoopCandidate& candidate : run.candidates) {
    if (!candidate.accepted() || pictures++ >= options.pictures) continue;
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", run.picture(candidate), bytes);
    writeFileAtomically(
        fmt::format("{}/loop_{}_{}.png", options.output, candidate.query_id, candidate.place_id),
        std::string(bytes.begin(), bytes.end()));
  }
}

int run(int argc, char** argv) {
  const auto options = parseFindLoopsOptions(argc, argv);
  if (!options) return 0;
  { const AtomicFile writable(options->output + "/summary.json"); }  // before the work, not after it
  const LoopRun run = std::filesystem::is_directory(options->input)
                          ? findLoopsInFolder(*options)
                          : findLoopsInRecording(*options, showProgress);
  const LoopFigures figures = figuresOf(run);
  const std::string name = std::filesystem::path(options->input).lexically_normal().filename().string();
  writeFileAtomically(options->output + "/loops.csv", toCsv(run));
  writeFileAtomically(options->output + "/summary.json", toJson(figures, name));
  writeFileAtomically(options->output + "/timing.json", timingJson(run));
  writePictures(*options, run);
  print(figures, run, name);
  for (const std::string& note : run.notes) std::fprintf(stderr, "find_loops: note: %s\n", note.c_str());
  std::printf("results in %s\n", options->output.c_str());
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("find_loops", stereo_nav::tools::run, argc, argv);
}
