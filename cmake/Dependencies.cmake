# Everything the package builds against, found once.
find_package(catkin REQUIRED COMPONENTS
  actionlib camera_calibration_parsers camera_info_manager cv_bridge diagnostic_msgs diagnostic_updater dynamic_reconfigure
  geometry_msgs image_geometry image_proc image_transport message_generation move_base_msgs nav_msgs nodelet
  pluginlib rosbag rosbag_storage rosconsole roscpp rosgraph_msgs roslib sensor_msgs std_msgs std_srvs stereo_image_proc stereo_msgs
  tf2 tf2_eigen tf2_geometry_msgs tf2_msgs tf2_ros topic_tools)
find_package(Boost REQUIRED COMPONENTS program_options)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(JPEG REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs features2d video calib3d videoio)
find_package(Threads REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(ZLIB REQUIRED)
if(STEREO_NAV_MAPPING)
  find_package(Ceres REQUIRED)
endif()
