#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

namespace stereo_nav::tools {

/// The camera_info, without header, of MonoSLAM's hand-held webcam (SceneLib: 320x240, f 195 px, centre (162,
/// 125), k 9e-6 / px^2). Its lens, u / sqrt(1 + 2 k r^2), becomes a rational_polynomial, the Pade approximant
/// [3/3] of 1 / sqrt(1 + x), which is within 0.1 px everywhere in the image; P keeps nearly all of the view.
sensor_msgs::CameraInfo monoslamInfo();

/// Writes the images of the public MonoSLAM sequence, `DIR/frames` in the order of their names at 30 Hz, as
/// the left camera of a recording; base_link is the camera with x forward. Returns their number. Throws
/// InputError.
std::size_t importMonoslam(const std::string& folder, const std::string& bag);

}  // namespace stereo_nav::tools
