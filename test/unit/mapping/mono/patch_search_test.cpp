#include "mapping/mono/patch_search.h"

#include <gtest/gtest.h>

#include "mapping/mono/pixel_prediction.h"
#include "point_world.h"
#include "support/textured_room.h"
#include "vision/image_pyramid.h"

namespace stereo_nav::mapping {
namespace {

cv::Mat roomImage(const Eigen::Isometry3d& T_room_camera) {
  const MonoCamera camera = test::smallCamera();
  return stereo_nav::test::TexturedRoom().render(T_room_camera, camera.fx, camera.fy, camera.cx, camera.cy,
                                                 camera.size);
}

/// A point of the back wall, which faces the first view, as it is found from another pose.
void expectFound(const CameraState& now, double within_px) {
  const MonoCamera camera = test::smallCamera();
  const vision::ImagePyramid first(roomImage(Eigen::Isometry3d::Identity()), 1);
  const vision::ImagePyramid second(roomImage(now.T_world_camera()), 1);
  int found = 0;
  constexpr int kPoints = 25;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector2d px(110.0 + 25.0 * (i % 5), 80.0 + 20.0 * (i / 5));
    StateBlock landmark;
    landmark.value.head<3>() = 6.0 * camera.ray(px);
    const auto view = keepView(first.level(0), px, Eigen::Isometry3d::Identity());
    const Eigen::Vector2d expected = *pixelOf(camera, now, landmark, 0.0);
    const auto warp = warpOf(camera, *view, landmark, now, expected);
    ASSERT_TRUE(warp);
    const auto match = searchPatch(second.level(0), *view, *warp, expected + Eigen::Vector2d(2.0, -1.5),
                                   4.0 * Eigen::Matrix2d::Identity(), {});
    if (match && (*match - expected).norm() < within_px) ++found;
  }
  EXPECT_GE(found, 4 * kPoints / 5);
}

TEST(PatchSearch, APatchIsFoundWhereItIs) {
  CameraState now;
  now.p_world = {0.3, 0.1, 0.2};
  expectFound(now, 0.3);
}

TEST(PatchSearch, ATurnAboutTheAxisOfViewIsWarped) {
  CameraState now;
  now.q_world_camera = expQuaternion({0.0, 0.0, 0.6});
  expectFound(now, 0.3);
}

TEST(PatchSearch, AnApproachIsWarped) {
  CameraState now;
  now.p_world = {0.0, 0.0, 2.0};
  expectFound(now, 0.5);
}

TEST(PatchSearch, APatchAtTheEdgeOfTheImageIsKept) {
  const vision::ImagePyramid image(roomImage(Eigen::Isometry3d::Identity()), 1);
  for (const Eigen::Vector2d& px : {Eigen::Vector2d(9.0, 11.0), Eigen::Vector2d(311.0, 231.0)}) {
    const auto view = keepView(image.level(0), px, Eigen::Isometry3d::Identity());
    const auto match = searchPatch(image.level(0), *view, Eigen::Matrix2f::Identity(), px,
                                   Eigen::Matrix2d::Identity(), {13, 0.8, 0.1, 30.0});
    ASSERT_TRUE(match);
    EXPECT_LT((*match - px).norm(), 0.1);
  }
}

}  // namespace
}  // namespace stereo_nav::mapping
