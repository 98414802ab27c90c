#pragma once

#include <boost/program_options.hpp>
#include <iostream>
#include <string>

namespace stereo_nav::tools {

/// Fills `values`, and the variables that `visible`, with an option `help`, is bound to. `positional`: name
/// under which the one argument without dashes is stored; empty where there is none. False when help was
/// asked for: it is printed then.
inline bool parseCommandLine(int argc, char** argv,
                             const boost::program_options::options_description& visible,
                             const std::string& positional, boost::program_options::variables_map& values) {
  namespace po = boost::program_options;
  po::options_description all;
  all.add(visible);
  po::positional_options_description positions;
  if (!positional.empty()) {
    all.add_options()(positional.c_str(), po::value<std::string>());
    positions.add(positional.c_str(), 1);
  }
  po::store(po::command_line_parser(argc, argv).options(all).positional(positions).run(), values);
  if (values.count("help") != 0) {
    std::cout << visible << "\n";
    return false;
  }
  po::notify(values);
  return true;
}

}  // namespace stereo_nav::tools
