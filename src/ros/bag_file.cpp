#include "ros/bag_file.h"

#include <utility>
#include <vector>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::ros_io {
namespace {

/// Keeps a bag that cannot be closed until the process ends, since its destructor must not run; see
/// ~BagFile().
void giveUp(std::unique_ptr<rosbag::Bag> bag) {
  static auto* given_up = new std::vector<rosbag::Bag*>;  // never destroyed: that would destroy the bags, too
  given_up->push_back(bag.release());
}

}  // namespace

BagFile::BagFile(const std::string& path) : path_(path), file_(path), bag_(std::make_unique<rosbag::Bag>()) {
  guarded([this] { bag_->open(file_.temporaryPath(), rosbag::bagmode::Write); });
}

BagFile::~BagFile() {
  // The destructor of a rosbag::Bag writes the index. On a full disk that throws, and an exception from a
  // destructor would end the program. Therefore the bag is closed here or, once writing has failed, abandoned
  // together with its memory.
  try {
    if (!failed_) bag_->close();
  } catch (const std::exception&) {
    failed_ = true;
  }
  if (failed_) giveUp(std::move(bag_));
}

void BagFile::commit() {
  guarded([this] { bag_->close(); });
  file_.commit();
}

void BagFile::guarded(const std::function<void()>& action) {
  try {
    action();
  } catch (const rosbag::BagException& error) {
    failed_ = true;
    throw InputError(path_ + ": cannot be written: " + error.what() + "; is there space on the disk?");
  }
}

}  // namespace stereo_nav::ros_io
