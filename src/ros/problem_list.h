#pragma once

#include <map>
#include <string>

namespace stereo_nav::ros_io {

/// What is wrong at the moment, each thing under a key of its own. Decides when to say it in the log: when it
/// is new, and again every `repeat_s` while it lasts. Diagnostics show the list as it is.
class ProblemList {
 public:
  struct Problem {
    bool is_error = false;  ///< there is no odometry because of it; otherwise a warning
    std::string text;
    double said_s = 0.0;
  };

  explicit ProblemList(double repeat_s) : repeat_s_(repeat_s) {}

  /// Adds or updates; returns whether to say it now. `now_s` on any clock that only runs forward.
  bool raise(const std::string& key, bool is_error, const std::string& text, double now_s);
  /// Returns whether it was there, i.e. whether to say that it is over.
  bool clear(const std::string& key) { return problems_.erase(key) > 0; }

  const std::map<std::string, Problem>& all() const { return problems_; }

 private:
  double repeat_s_;
  std::map<std::string, Problem> problems_;
};

}  // namespace stereo_nav::ros_io
