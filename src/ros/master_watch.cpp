#include "ros/master_watch.h"

#include <netdb.h>
#include <poll.h>
#include <ros/ros.h>
#include <sys/socket.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string>

namespace stereo_nav::ros_io {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPeriod{1000};
constexpr int kConnectTimeout_ms = 1000;
constexpr int kGoneStatus = 3;
/// Time limit of an orderly shutdown, which talks to nodes and masters that may not answer.
constexpr milliseconds kShutdownPatience{2000};

/// Result of one check of the master; patience() says how many equal results in a row mean that it has gone.
enum class Answer { kGood, kRefused, kUnknownNode, kUnreachable };

int patience(Answer answer) {
  switch (answer) {
    case Answer::kUnreachable:
      return 15;  // each check takes up to two seconds
    default:
      return 3;
  }
}

const char* wordsFor(Answer answer) {
  switch (answer) {
    case Answer::kRefused:
      return "its port refuses connections; roscore has ended";
    case Answer::kUnknownNode:
      return "another master, which does not know this node, answers in its place; roscore was restarted";
    default:
      return "it cannot be reached; look at the network between the computers";
  }
}

/// Tries to connect; the result is kGood, kRefused or kUnreachable.
Answer connect(const std::string& host, unsigned int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0)
    return Answer::kUnreachable;
  Answer answer = Answer::kUnreachable;
  for (const addrinfo* address = found; address != nullptr && answer != Answer::kGood;
       address = address->ai_next) {
    const int fd = socket(address->ai_family, address->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (fd < 0) continue;
    int error = 0;
    if (::connect(fd, address->ai_addr, address->ai_addrlen) != 0) error = errno;
    if (error == EINPROGRESS) {
      pollfd waiting{fd, POLLOUT, 0};
      socklen_t length = sizeof error;
      error = ETIMEDOUT;
      if (poll(&waiting, 1, kConnectTimeout_ms) == 1) getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &length);
    }
    if (error == 0) answer = Answer::kGood;
    if (error == ECONNREFUSED) answer = Answer::kRefused;
    close(fd);
  }
  freeaddrinfo(found);
  return answer;
}

Answer askMaster(const std::string& host, unsigned int port, const std::string& node) {
  const Answer connection = connect(host, port);
  if (connection != Answer::kGood) return connection;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue arguments, reply;
  arguments[0] = node;
  arguments[1] = node;
  if (!client.execute("lookupNode", arguments, reply) || client.isFault() || reply.size() < 1) {
    return Answer::kUnreachable;
  }
  return static_cast<int>(reply[0]) == 1 ? Answer::kGood : Answer::kUnknownNode;
}

std::atomic<bool> gone_was_said{false};

}  // namespace

struct MasterWatch::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  bool stop = false;      ///< guarded by mutex
  bool finished = false;  ///< guarded by mutex
  std::atomic<bool> gone{false};
};

MasterWatch::MasterWatch() : shared_(std::make_shared<Shared>()), thread_(&MasterWatch::watch, shared_) {}

MasterWatch::~MasterWatch() {
  std::unique_lock<std::mutex> lock(shared_->mutex);
  shared_->stop = true;
  shared_->changed.notify_all();
  // A master that accepts connections and never answers must not keep the node from ending.
  const bool finished =
      shared_->changed.wait_for(lock, milliseconds(kConnectTimeout_ms), [&] { return shared_->finished; });
  lock.unlock();
  if (finished) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

int MasterWatch::exitStatus() const {
  return shared_->gone ? kGoneStatus : 0;
}

void MasterWatch::watch(const std::shared_ptr<Shared>& shared) {
  const std::string& node = ros::this_node::getName();
  const std::string& host = ros::master::getHost();
  const unsigned int port = ros::master::getPort();
  Answer last = Answer::kGood;
  int repeated = 0;
  std::unique_lock<std::mutex> lock(shared->mutex);
  while (!shared->changed.wait_for(lock, kPeriod, [&] { return shared->stop; })) {
    lock.unlock();
    const Answer answer = askMaster(host, port, node);
    lock.lock();
    repeated = answer == last ? repeated + 1 : 1;
    last = answer;
    if (answer == Answer::kGood || repeated < patience(answer) || shared->stop || !ros::ok()) continue;
    shared->gone = true;
    if (!gone_was_said.exchange(true)) {
      ROS_FATAL("The ROS master at %s has gone: %s. This node ends; started again, it waits for a master",
                ros::master::getURI().c_str(), wordsFor(answer));
    }
    ros::requestShutdown();
    if (!shared->changed.wait_for(lock, kShutdownPatience, [&] { return shared->stop; }))
      std::_Exit(kGoneStatus);
    break;
  }
  shared->finished = true;
  shared->changed.notify_all();
}

}  // namespace stereo_nav::ros_io
