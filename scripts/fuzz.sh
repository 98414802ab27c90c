#!/usr/bin/env bash
# Fuzz what reads calibrations, bags, stamps and lists of images, and the decoders of devices, with libFuzzer,
# AddressSanitizer and UndefinedBehaviourSanitizer.
#
#   scripts/fuzz.sh KIND [SECONDS] [BUILD_DIR]      (default: 600 seconds, build)
#
# KIND: ros, opencv, kalibr, kitti, euroc, rig, times, lists, names, bag; test/fuzz/input_fuzz.cpp says what each reads.
# Of devices: angles, raw, raw_udp, phone (IMU), laser, tfmini, base; test/fuzz/device_fuzz.cpp.
# Of maps: map; test/fuzz/map_fuzz.cpp.
# Needs clang and, but for devices and maps, a BUILD_DIR that is built: the readers are compiled anew, all else is taken from there.
# Inputs are kept in BUILD_DIR/fuzz; a finding ends the script with an error and leaves its input there.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
kind=${1:?usage: fuzz.sh KIND [SECONDS] [BUILD_DIR]}
seconds=${2:-600}
build=${3:-$root/build}
command -v clang++ >/dev/null || {
  echo "fuzz.sh: clang++ not found: sudo apt-get install clang" >&2
  exit 2
}
mkdir -p "$build/fuzz/objects" "$build/fuzz/inputs_$kind" "$root/test/fuzz/corpus/$kind"
sanitize=("-fsanitize=address,undefined" -fno-sanitize-recover=all)
cd "$root"

case $kind in
  angles | raw | raw_udp | phone | laser | tfmini | base)
    longest=4000
    includes=(-Iinclude -isystem "$(pkg-config --variable=prefix eigen3)/include/eigen3")
    sources=(test/fuzz/{base_fuzz,device_fuzz,device_fuzz_main}.cpp src/core/roll_pitch_yaw.cpp src/sensors/{serial,laser,range}/*.cpp
      src/sensors/imu/{angle_protocol,angle_gate,datagram_decoder,frame_decoder,module_angles,phone_protocol,raw_protocol}.cpp)
    libraries=()
    ;;
  map)
    longest=60000
    read -ra includes < <(pkg-config --cflags eigen3 opencv4)
    includes=(-Iinclude "${includes[@]/#-I/-isystem}")
    sources=(test/fuzz/{map_fuzz,map_fuzz_main}.cpp src/mapping/map/{map_file,map_sections,visual_map}.cpp src/core/{atomic_file,lie,planar_motion}.cpp)
    libraries=(z opencv_core)
    ;;
  *)
    longest=60000
    flags=$build/src/tools/import_sequence/CMakeFiles/stereo_nav_import.dir/flags.make
    [[ -f $flags ]] || {
      echo "fuzz.sh: $flags not found: build with scripts/build.sh first" >&2
      exit 2
    }
    read -ra includes < <(sed -n 's/^CXX_INCLUDES = //p' "$flags")
    sources=(test/fuzz/{input_fuzz,input_fuzz_main}.cpp src/core/{rig_file,text_table,parameters}.cpp
      src/ros/{bag_structure,calibration_file,recorded_order,recording,rig_topics,judged_infos,pairing,conversions}.cpp
      src/tools/import_sequence/{image_names,image_stamps,kitti_layout,euroc_layout,images_layout}.cpp
      src/tools/import_sequence/{raw_pair,raw_pair_files,rectified_camera,frame_reader,sixteen_bits}.cpp)
    libraries=(stereo_nav_{import,ros,vision,core} rosbag_storage roscpp_serialization rostime tf2 cv_bridge
      camera_calibration_parsers yaml-cpp fmt opencv_{core,imgcodecs,imgproc,calib3d,videoio} boost_filesystem
      console_bridge roscpp rosconsole class_loader roslib cpp_common)
    ;;
esac

objects=()
for source in "${sources[@]}"; do
  object=$build/fuzz/objects/${source//\//_}.o
  objects+=("$object")
  [[ $object -nt $source ]] && continue
  clang++ -std=c++17 -O1 -g1 -fsanitize=fuzzer-no-link "${sanitize[@]}" -iquote src -Itest "${includes[@]}" -c "$source" -o "$object"
done
clang++ -fsanitize=fuzzer "${sanitize[@]}" "${objects[@]}" -o "$build/fuzz/fuzz_$kind" -L"$build/devel/lib" \
  -Wl,-rpath,"$(realpath "$build")/devel/lib" "${libraries[@]/#/-l}"

# Strings cross the border to libraries without the sanitizers, whose containers they take for overflown.
STEREO_NAV_FUZZ_KIND=$kind ASAN_OPTIONS=detect_container_overflow=0:detect_leaks=0 "$build/fuzz/fuzz_$kind" \
  -max_total_time="$seconds" -max_len="$longest" -timeout=20 -rss_limit_mb=1500 -print_final_stats=1 \
  -artifact_prefix="$build/fuzz/finding_$kind-" "$build/fuzz/inputs_$kind" "test/fuzz/corpus/$kind"
