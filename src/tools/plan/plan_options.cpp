#include "tools/plan/plan_options.h"

#include <sstream>
#include <vector>

#include "core/angles.h"
#include "core/text_table.h"
#include "ros/package_files.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

/// `X,Y` or `X,Y,HEADING`.
std::vector<double> pose(const po::variables_map& values, const std::string& name) {
  const std::string usage = "--" + name + "=X,Y or --" + name + "=X,Y,HEADING";
  if (values.count(name) == 0)
    throw InputError(usage + " is needed, in m in the frame of the map; see plan --help");
  std::istringstream text(values[name].as<std::string>());
  std::vector<double> numbers;
  for (const TextRow& row : readTextTable(text, "--" + name))
    for (std::size_t i = 0; i < row.fields.size(); ++i) numbers.push_back(row.number(i));
  if (numbers.size() != 2 && numbers.size() != 3)
    throw InputError(usage + " is what can be said, in m and degrees");
  return numbers;
}

/// `NAME=VALUE`, with sections as in the file: `clearance.weight=1`.
void apply(const std::string& setting, navigation::PlannerParams& params) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) throw InputError("--set takes NAME=VALUE, not '" + setting + "'");
  std::string text = setting.substr(equals + 1), name = setting.substr(0, equals);
  for (std::size_t dot = name.rfind('.'); dot != std::string::npos; dot = name.rfind('.')) {
    text = "{" + name.substr(dot + 1) + ": " + text + "}";
    name.resize(dot);
  }
  readParameters(parseYaml(name + ": " + text, "--set"), "--set", params);
}

}  // namespace

std::optional<PlanOptions> parsePlanOptions(int argc, char** argv) {
  PlanOptions options;
  std::string config;
  std::vector<std::string> settings;
  po::options_description visible(helpHeading(
      "usage: plan MAP --start=X,Y[,HEADING] --goal=X,Y[,HEADING] [options]\n       plan --scenarios FILE.scen",
      "Plans a path for a robot of real size on MAP, the YAML file of a map of map_server's format, or a drawing in which black is an "
      "obstacle, and prints what it found. Places are in m in the frame of the map, headings in degrees. --scenarios runs a file of the "
      "public grid benchmark on the map beside it. Exit status 1: there is no path, or a scenario was not solved with the optimal length."));
  visible.add_options()                                                                                     //
      ("help,h", "this text")                                                                               //
      ("start", po::value<std::string>(), "where the robot is: X,Y or X,Y,HEADING")                         //
      ("goal", po::value<std::string>(), "where it is to go, likewise")                                     //
      ("config", po::value<std::string>(&config), "parameters of planning (default: config/planner.yaml)")  //
      ("set", po::value<std::vector<std::string>>(&settings)->composing(),
       "one of these parameters, NAME=VALUE; may be given several times")                             //
      ("metres-per-pixel", numberOption(options.drawing.metres_per_pixel), "of a drawing")            //
      ("resolution", numberOption(options.drawing.resolution_m), "side of a cell, m, for a drawing")  //
      ("image", po::value<std::string>(&options.image), "write a picture of the path on the map")     //
      ("csv", po::value<std::string>(&options.csv), "write the path as x_m,y_m,heading_rad")          //
      ("text", po::value<std::string>(&options.text),
       "write the path as the published work does: x y in mm a line")                                       //
      ("as-published", "plan as the published work: Manhattan estimate, falling weight, every n-th point")  //
      ("thin-every", po::value<int>(&options.thin_every), "that n (default 20)")                            //
      ("scenarios", po::value<std::string>(&options.scenarios), "run a benchmark's scenarios");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "map", values)) return std::nullopt;
  options.as_published = values.count("as-published") != 0;
  if (options.thin_every < 1) throw InputError("--thin-every must be 1 or more");
  if (!options.scenarios.empty()) return options;
  if (values.count("map") == 0) throw InputError("MAP or --scenarios is needed; see plan --help");
  options.map = values["map"].as<std::string>();
  const std::vector<double> start = pose(values, "start"), goal = pose(values, "goal");
  options.start = {{start[0], start[1]}, start.size() == 3 ? start[2] * kRadPerDeg : 0.0};
  options.goal_m = {goal[0], goal[1]};
  if (goal.size() == 3) options.goal_heading_rad = goal[2] * kRadPerDeg;
  const std::string file = config.empty() ? ros_io::configFile("planner.yaml") : config;
  readParameters(loadYamlFile(file), file, options.planner);
  for (const auto& setting : settings) apply(setting, options.planner);
  return options;
}

}  // namespace stereo_nav::tools
