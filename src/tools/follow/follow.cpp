// Drives a follower along a path on the simulated drive, and says how far from the path it was.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/angles.h"
#include "core/atomic_file.h"
#include "navigation/control/as_published.h"
#include "navigation/control/path_driver.h"
#include "navigation/planner/path_file.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"
#include "tools/follow/course_picture.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

struct Options {
  std::string path, config, output, law;
  bool as_published = false, parameters = false;
  double speed_m_per_s = 1.0, wheelbase_m = 0.0;
  double noise_m = 0.0, noise_deg = 0.0;
  control::CourseOptions course;
};

void describeDrive(po::options_description& visible, Options& options) {
  auto& drive = options.course.drive;
  visible.add_options()  //
      ("wheelbase", numberOption(options.wheelbase_m),
       "distance of the axles of a vehicle with steered front wheels, m; 0 for other bases")  //
      ("drive-dead-time", numberOption(drive.dead_time_s),
       "of the simulated drive, s; the follower reckons with that of its parameters")              //
      ("drive-lag", numberOption(drive.lag_s), "likewise, the time constant of its velocity")      //
      ("odometry-age", numberOption(options.course.odometry_age_s), "latency of the odometry, s")  //
      ("noise-m", numberOption(options.noise_m), "deviation of the odometry's positions, m")       //
      ("noise-deg", numberOption(options.noise_deg), "deviation of its headings, deg");
}

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  po::options_description visible(helpHeading(
      "usage: follow PATH [options]",
      "Drives from rest along a path (CSV with the heading x_m,y_m; or x and y in mm without heading) on the simulated drive of "
      "docs/driving.md and prints how far from the path it was, in one row of a table. Exit status: 0 arrived, 1 not "
      "arrived, 2 input that cannot be used."));
  visible.add_options()                                                                            //
      ("help,h", "this text")                                                                      //
      ("law", po::value(&options.law)->default_value("pursuit"), "holonomic, pursuit or stanley")  //
      ("speed", numberOption(options.speed_m_per_s), "highest speed, m/s")                         //
      ("as-published", po::bool_switch(&options.as_published),
       "pursuit or stanley as their authors wrote them")                                     //
      ("config", po::value(&options.config), "YAML file with parameters of the follower")    //
      ("parameters", po::bool_switch(&options.parameters), "list these parameters and end")  //
      ("output", po::value(&options.output), "folder for course.svg and run.csv");
  describeDrive(visible, options);
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "path", values)) return std::nullopt;
  if (options.parameters) return options;
  if (values.count("path") == 0) throw InputError("PATH is needed; see follow --help");
  options.path = values["path"].as<std::string>();
  return options;
}

control::ControlParams paramsOf(const Options& options) {
  control::ControlParams params;
  if (!options.config.empty()) readParameters(loadYamlFile(options.config), options.config, params);
  readParameters(parseYaml("law: " + options.law, "--law"), "--law", params);
  params.speed.max_speed_m_per_s = options.speed_m_per_s;
  params.drive.wheelbase_m = options.wheelbase_m;
  validateParameters(params, "options");
  if (params.law == control::FollowLaw::kStanley && !params.drive.steered())
    throw InputError("--law stanley steers front wheels: give --wheelbase, the distance of the axles");
  return params;
}

std::unique_ptr<control::Follower> followerOf(const Options& options, const control::ControlParams& params,
                                              const control::Path& path) {
  if (!options.as_published) return std::make_unique<control::PathDriver>(params, path);
  if (params.law == control::FollowLaw::kStanley) {
    return std::make_unique<control::PublishedStanley>(
        path, control::PublishedStanleyParams{options.speed_m_per_s, params.stanley.gain_per_s,
                                              params.stanley.max_steering_deg, options.wheelbase_m});
  }
  if (params.law != control::FollowLaw::kPursuit)
    throw InputError("--as-published has --law pursuit and --law stanley; the works have no other follower");
  control::PublishedPursuitParams published;
  published.speed_m_per_s = options.speed_m_per_s;
  return std::make_unique<control::PublishedPursuit>(path, published);
}

void writeFiles(const Options& options, const control::Path& path, const control::CourseRun& run) {
  std::string csv = "time_s,x_m,y_m,heading_rad,speed_m_per_s,turn_rate_rad_per_s,left_m\n";
  for (const auto& sample : run.samples) {
    const Eigen::Vector2d position = sample.state.T_world_base.translation();
    csv += fmt::format("{:.3f},{:.5f},{:.5f},{:.6f},{:.5f},{:.6f},{:.5f}\n", sample.time_s, position.x(),
                       position.y(), sample.state.heading_rad(), sample.state.twist.head<2>().norm(),
                       sample.state.twist.z(), sample.left_m);
  }
  writeFileAtomically(options.output + "/run.csv", csv);
  const std::string title = fmt::format("{}{}, {} m/s", options.law,
                                        options.as_published ? " as published" : "", options.speed_m_per_s);
  writeFileAtomically(options.output + "/course.svg",
                      drawCourse(path, run, options.course.reference_m, title, options.output + "/course"));
}

control::Path readCourse(const std::string& file) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& pose : navigation::readPath(file)) points.push_back(pose.position_m);
  return control::Path(points);
}

int printParameters() {
  for (const auto& doc : documentParameters(control::ControlParams()))
    std::printf("%-45s %-10s %-14s %s\n", doc.name.c_str(), doc.default_value.c_str(), doc.unit.c_str(),
                doc.doc.c_str());
  return 0;
}

int run(int argc, char** argv) {
  auto options = parse(argc, argv);
  if (!options) return 0;
  if (options->parameters) return printParameters();
  const control::ControlParams params = paramsOf(*options);
  const control::Path path = readCourse(options->path);
  const auto follower = followerOf(*options, params, path);
  control::CourseOptions& course = options->course;
  course.drive.wheelbase_m = params.drive.wheelbase_m;
  course.reference_m = params.reference_m();
  course.period_s = params.period_s;
  course.until_near_end = options->as_published;
  course.most_s = 60.0 + 10.0 * path.length_m() / options->speed_m_per_s;
  course.position_noise_m = options->noise_m;
  course.heading_noise_rad = kRadPerDeg * options->noise_deg;
  const control::CourseRun result = control::driveCourse(path, *follower, course);
  std::printf(
      "| course | follower | m/s | worst mm | RMS mm | end mm | end deg | time s | us a step |\n|---|---|---|---|---|---|---|---|---|\n"
      "| %s | %s%s | %g | %.1f | %.1f | %.1f | %.2f | %.2f | %.1f |\n",
      std::filesystem::path(options->path).stem().c_str(), options->law.c_str(),
      options->as_published ? " as published" : "", options->speed_m_per_s, 1e3 * result.worst_m,
      1e3 * result.rms_m, 1e3 * result.end_distance_m, kDegPerRad * result.end_heading_error_rad,
      result.duration_s, 1e6 * result.median_step_s);
  if (!options->output.empty()) writeFiles(*options, path, result);
  return result.finished ? 0 : 1;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("follow", stereo_nav::tools::run, argc, argv);
}
