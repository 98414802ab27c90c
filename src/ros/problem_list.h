#pragma once

#include <map>
#include <string>

namespace stereo_nav::ros_io {

/// The current problems, each under its own key. Decides when a problem is logged: when it is new, and again
/// every `repeat_s` while it lasts. Diagnostics show the whole list.
class ProblemList {
 public:
  struct Problem {
    bool is_error = false;  ///< it prevents the odometry; otherwise it is a warning
    std::string text;
    double said_s = 0.0;
  };

  explicit ProblemList(double repeat_s) : repeat_s_(repeat_s) {}

  /// Adds or updates a problem; returns whether to log it now. `now_s` is on any clock that only runs
  /// forward.
  bool raise(const std::string& key, bool is_error, const std::string& text, double now_s);
  /// Removes a problem; returns whether there was one, i.e. whether to log its end.
  bool clear(const std::string& key) { return problems_.erase(key) > 0; }

  const std::map<std::string, Problem>& all() const { return problems_; }

 private:
  double repeat_s_;
  std::map<std::string, Problem> problems_;
};

}  // namespace stereo_nav::ros_io
