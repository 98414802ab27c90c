#pragma once

#include <rosbag/bag.h>

#include <functional>
#include <string>

namespace stereo_nav::ros_io {

/// Walks over the records of a bag of format 2.0 (wiki.ros.org/Bags/Format/2.0) without reading the messages.
/// rosbag trusts the lengths and places that it finds in a file and, where they are damaged, reads what is
/// not its own and ends the process. Throws a rosbag::BagFormatException that says where the damage is. What
/// rosbag itself recognises (another format, no index) passes.
void checkBagStructure(const std::string& path);

/// Opens a bag for reading once its structure has been checked.
void openBag(rosbag::Bag& bag, const std::string& path);

/// Does what reads the bag `path`; its errors become an InputError with the likely cause and the remedy.
void readBag(const std::string& path, const std::function<void()>& read);

}  // namespace stereo_nav::ros_io
