#include "ros/topic_names.h"

#include <ros/names.h>

#include <set>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::ros_io {

void checkTopicNames(const std::vector<std::string>& names, const std::string& kind) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    std::string reason;
    if (name.empty() || name.find('/') != std::string::npos || !ros::names::validate(name, reason))
      throw ParameterError(kind + " name '" + name +
                           "' cannot be part of a topic; use letters, digits and underscores");
    if (!seen.insert(name).second)
      throw ParameterError(kind + " name '" + name +
                           "' is there twice, but each has topics of its own; give each its own name");
  }
}

}  // namespace stereo_nav::ros_io
