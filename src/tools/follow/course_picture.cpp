#include "tools/follow/course_picture.h"

#include <fmt/format.h>

#include "eval/gnuplot.h"

namespace stereo_nav::tools {
namespace {

const char* const kLayout =
    R"(set terminal svg size 820,780 dynamic noenhanced font 'Helvetica,13' background rgb 'white'
set border 3 lc rgb '#5f6b76'
set tics nomirror out scale 0.6 textcolor rgb '#3a444d'
set grid lc rgb '#dfe4e8' lw 1 dt 1
set key outside top center horizontal samplen 2
set multiplot
set origin 0,0.4
set size 1,0.6
set size ratio -1
set xlabel 'x, m'
set ylabel 'y, m'
)";
const char* const kSecondPanel = R"(set origin 0,0
set size 1,0.4
set size noratio
unset title
set xlabel 'time, s'
set ylabel 'distance from the path, mm'
set y2label 'speed, m/s'
set y2tics
set y2range [0:*]
)";

}  // namespace

std::string drawCourse(const control::Path& path, const control::CourseRun& run, double reference_m,
                       const std::string& title, const std::string& path_prefix) {
  std::string course, way, distance, speed;
  for (const auto& point : path.points())
    course += fmt::format("{:.4f} {:.4f}\n", point.position.x(), point.position.y());
  for (const auto& sample : run.samples) {
    const Eigen::Vector2d reference = sample.state.T_world_base * Eigen::Vector2d(reference_m, 0.0);
    way += fmt::format("{:.4f} {:.4f}\n", reference.x(), reference.y());
    distance += fmt::format("{:.4f} {:.3f}\n", sample.time_s, 1e3 * sample.left_m);
    speed += fmt::format("{:.4f} {:.4f}\n", sample.time_s, sample.state.twist.head<2>().norm());
  }
  const std::string script =
      fmt::format("$course << E\n{}E\n$way << E\n{}E\n$distance << E\n{}E\n$speed << E\n{}E\n", course, way,
                  distance, speed) +
      kLayout + fmt::format("set title '{}'\n", title) +
      "plot $course with lines lc rgb '#5f6b76' lw 4 title 'course', $way with lines lc rgb '#c9302c' lw 1.5 "
      "title 'driven'\n" +
      kSecondPanel +
      "plot $distance with lines lc rgb '#c9302c' lw 1.5 title 'distance, left of the path positive', $speed "
      "axes x1y2 with lines lc rgb '#1668b3' lw 1.5 title 'speed'\nunset multiplot\n";
  return eval::runGnuplot(script, path_prefix);
}

}  // namespace stereo_nav::tools
