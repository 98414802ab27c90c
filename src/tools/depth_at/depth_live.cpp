#include "tools/depth_at/depth_live.h"

#include <cv_bridge/cv_bridge.h>
#include <ros/ros.h>
#include <stereo_msgs/DisparityImage.h>

#include <cmath>
#include <cstdio>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "tools/depth_at/depth_statistics.h"

namespace stereo_nav::tools {
namespace {

constexpr double kPatience_s = 30.0;
constexpr const char* kWindow = "depth_at: click into the image, any key ends";

/// Collects distances at one pixel until there are enough, then prints them.
class LiveDepth {
 public:
  explicit LiveDepth(const DepthAtOptions& options) : options_(options), pixel_(options.pixel) {
    disparity_ = node_.subscribe("camera/disparity", 10, &LiveDepth::addDisparity, this);
  }

  bool done() const { return statistics_.frames() == static_cast<std::size_t>(options_.frames); }
  bool anythingCame() const { return anything_came_; }
  std::string topic() const { return disparity_.getTopic(); }
  int windowSize() const { return options_.window_px; }
  const std::optional<cv::Point>& pixel() const { return pixel_; }

  void measureAt(cv::Point pixel) {
    pixel_ = pixel;
    statistics_ = DepthStatistics();
  }

 private:
  void addDisparity(const stereo_msgs::DisparityImageConstPtr& message) {
    anything_came_ = true;
    if (!pixel_ || done()) return;
    const cv::Mat map = cv_bridge::toCvShare(message->image, message, "32FC1")->image;
    const auto disparity_px = medianDisparity(map(windowAround(*pixel_, options_.window_px, map.size())));
    std::optional<double> depth_m;
    if (disparity_px) depth_m = static_cast<double>(message->f) * std::fabs(message->T) / *disparity_px;
    statistics_.add(depth_m);
    if (options_.each) std::printf("%.6f %.4f\n", message->header.stamp.toSec(), depth_m.value_or(NAN));
    if (done()) {
      std::printf("pixel (%d, %d): %s\n", pixel_->x, pixel_->y, statistics_.text().c_str());
      std::fflush(stdout);
    }
  }

  const DepthAtOptions& options_;
  std::optional<cv::Point> pixel_;
  DepthStatistics statistics_;
  bool anything_came_ = false;
  ros::NodeHandle node_;
  ros::Subscriber disparity_;
};

/// The left image, and where it was clicked.
class ImageWindow {
 public:
  explicit ImageWindow(LiveDepth& depth) : depth_(depth) {
    cv::namedWindow(kWindow, cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
    cv::setMouseCallback(kWindow, &ImageWindow::onMouse, this);
    image_ = node_.subscribe("camera/left/image_rect", 1, &ImageWindow::show, this);
  }
  ~ImageWindow() { cv::destroyAllWindows(); }
  ImageWindow(const ImageWindow&) = delete;
  ImageWindow& operator=(const ImageWindow&) = delete;

 private:
  static void onMouse(int event, int x, int y, int, void* window) {
    if (event == cv::EVENT_LBUTTONDOWN) static_cast<ImageWindow*>(window)->click({x, y});
  }
  void click(cv::Point pixel) {
    try {
      windowAround(pixel, depth_.windowSize(), size_);
      depth_.measureAt(pixel);
    } catch (const InputError& error) {
      std::printf("%s\n", error.what());
    }
  }
  void show(const sensor_msgs::ImageConstPtr& message) {
    cv::Mat image;
    cv::cvtColor(ros_io::toMono8(message), image, cv::COLOR_GRAY2BGR);
    size_ = image.size();
    if (depth_.pixel()) {
      cv::drawMarker(image, *depth_.pixel(), cv::Scalar(0, 0, 255), cv::MARKER_CROSS, 15);
    }
    cv::imshow(kWindow, image);
  }

  LiveDepth& depth_;
  cv::Size size_;
  ros::NodeHandle node_;
  ros::Subscriber image_;
};

}  // namespace

void measureLive(const DepthAtOptions& options) {
  LiveDepth depth(options);
  std::optional<ImageWindow> window;
  if (!options.pixel) window.emplace(depth);
  const ros::WallTime start = ros::WallTime::now();
  while (ros::ok()) {
    ros::spinOnce();
    if (options.pixel && depth.done()) return;
    if (!depth.anythingCame() && (ros::WallTime::now() - start).toSec() > kPatience_s) {
      throw InputError("nothing on " + depth.topic() + " for " +
                       std::to_string(static_cast<int>(kPatience_s)) +
                       " s; is the graph of nodes running (image_proc.launch), with cameras or a bag?");
    }
    if (!window) {
      ros::WallDuration(0.005).sleep();
    } else if (cv::waitKey(5) >= 0) {
      return;
    }
  }
}

}  // namespace stereo_nav::tools
