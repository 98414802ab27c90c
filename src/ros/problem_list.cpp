#include "ros/problem_list.h"

namespace stereo_nav::ros_io {

bool ProblemList::raise(const std::string& key, bool is_error, const std::string& text, double now_s) {
  const auto [entry, is_new] = problems_.try_emplace(key);
  Problem& problem = entry->second;
  problem.is_error = is_error;
  problem.text = text;
  if (!is_new && now_s - problem.said_s < repeat_s_) return false;
  problem.said_s = now_s;
  return true;
}

}  // namespace stereo_nav::ros_io
