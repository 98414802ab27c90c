#pragma once

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace stereo_nav::tools {

/// The heading of a program's --help: its synopsis, its description wrapped at 100 columns, and what the list
/// of options is called.
inline std::string helpHeading(const std::string& synopsis, const std::string& description) {
  constexpr std::size_t kColumns = 100;
  std::string text = synopsis + "\n", line, word;
  std::istringstream words(description);
  while (words >> word) {
    if (!line.empty() && line.size() + 1 + word.size() > kColumns) {
      text += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line + "\n\nOptions";
}

/// An option whose default is the value that the variable has, shown with as few digits as it needs.
inline boost::program_options::typed_value<double>* numberOption(double& variable) {
  return boost::program_options::value(&variable)->default_value(variable, fmt::format("{}", variable));
}

/// How many arguments without dashes a program takes.
enum class Positional { kOne, kMany };

/// Fills `values`, and the variables that `visible`, with an option `help`, is bound to. `positional`: name
/// under which the argument without dashes is stored, or with kMany all of them as a list; empty where there
/// is none. False when help was asked for: it is printed then.
inline bool parseCommandLine(int argc, char** argv,
                             const boost::program_options::options_description& visible,
                             const std::string& positional, boost::program_options::variables_map& values,
                             Positional count = Positional::kOne) {
  namespace po = boost::program_options;
  po::options_description all;
  all.add(visible);
  po::positional_options_description positions;
  if (!positional.empty()) {
    if (count == Positional::kMany) {
      all.add_options()(positional.c_str(), po::value<std::vector<std::string>>());
    } else {
      all.add_options()(positional.c_str(), po::value<std::string>());
    }
    positions.add(positional.c_str(), count == Positional::kMany ? -1 : 1);
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
