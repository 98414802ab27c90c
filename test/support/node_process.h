#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace stereo_nav::test {

/// A program that runs beside the test and is ended by Ctrl-C's signal, as roslaunch does.
class NodeProcess {
 public:
  explicit NodeProcess(const std::vector<std::string>& command) : pid_(fork()) {
    if (pid_ != 0) return;
    std::vector<char*> arguments;
    for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  ~NodeProcess() { stop(); }
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  /// Ends the program; returns its exit status, or 128 when a signal killed it.
  int stop() {
    if (pid_ <= 0) return status_;
    kill(pid_, SIGINT);
    wait(0);
    return status_;
  }

  /// Waits until the program ends by itself; returns the same as stop().
  int join() {
    if (pid_ > 0) wait(0);
    return status_;
  }

  /// Whether the program has ended by itself.
  bool ended() {
    if (pid_ > 0) wait(WNOHANG);
    return pid_ <= 0;
  }

 private:
  void wait(int options) {
    int status = 0;
    if (waitpid(pid_, &status, options) == 0) return;
    pid_ = 0;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }

  pid_t pid_;
  int status_ = 0;
};

}  // namespace stereo_nav::test
