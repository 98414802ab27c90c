// Records an IMU module at rest: drift of its angles, Allan deviation of its rates, quality of its stream.
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>

#include <cstdio>
#include <iostream>
#include <sstream>

#include "core/angles.h"
#include "core/atomic_file.h"
#include "eval/gnuplot.h"
#include "ros/bag_structure.h"
#include "sensors/imu/allan_deviation.h"
#include "sensors/imu/drift.h"
#include "sensors/imu/imu_estimator.h"
#include "sensors/serial/steady_clock.h"
#include "tools/common/command_line.h"
#include "tools/common/imu_source.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

struct Options {
  ImuSource source;
  double duration_s = 600.0;
  std::string output = "imu_drift";
  std::string bag, topic = "imu/data";
};

struct RestRecording {
  std::vector<imu::AngleSample> angles;
  std::vector<double> rate_times_s;
  std::vector<Eigen::Vector3d> rates;  ///< rad/s, raw modules only
};

RestRecording recordFromPort(const Options& options, imu::ImuDeviceStatus& status) {
  RestRecording recording;
  imu::ImuEstimator estimator({}, {}, 0.02);
  double start_s = -1.0, now_s = 0.0;
  const double given_up_s = serial::steadyNow_s() + options.duration_s + 30.0;
  const auto keep_going = [&] {
    return (start_s < 0.0 || now_s - start_s < options.duration_s) && serial::steadyNow_s() < given_up_s;
  };
  status = options.source.read(keep_going, [&](const imu::ImuReading& reading) {
    now_s = reading.time_s;
    if (start_s < 0.0) start_s = now_s;
    const imu::ImuEstimate estimate = estimator.process(reading);
    if (reading.angles) {
      recording.angles.push_back({now_s, *reading.angles});
    } else if (estimate.q_world_imu) {
      recording.angles.push_back({now_s, imu::moduleFromOrientation(*estimate.q_world_imu)});
    }
    if (reading.raw) {
      recording.rate_times_s.push_back(now_s);
      recording.rates.push_back(reading.raw->angular_velocity);
    }
  });
  return recording;
}

RestRecording recordFromBag(const Options& options) {
  RestRecording recording;
  rosbag::Bag bag;
  ros_io::openBag(bag, options.bag);
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(options.topic))) {
    const auto message = instance.instantiate<sensor_msgs::Imu>();
    if (!message) continue;
    const double time_s = message->header.stamp.toSec();
    if (message->orientation_covariance[0] != -1.0) {
      const auto& q = message->orientation;
      recording.angles.push_back({time_s, imu::moduleFromOrientation({q.w, q.x, q.y, q.z})});
    }
    if (message->angular_velocity_covariance[0] == -1.0) continue;
    const auto& w = message->angular_velocity;
    recording.rate_times_s.push_back(time_s);
    recording.rates.emplace_back(w.x, w.y, w.z);
  }
  return recording;
}

void printDrift(const char* name, const imu::AngleDrift& drift) {
  std::printf("  %-6s %9.3f %13.4f %12.4f %12.3f\n", name, drift.total_deg, drift.slope_deg_min,
              drift.residual_deg, drift.largest_deg);
}

void printStream(const imu::ImuDeviceStatus& status) {
  std::printf("frames %llu, bad %llu, lost %llu; %.3f Hz; jitter on arrival %.3f ms, of the stamps %.4f ms\n",
              static_cast<unsigned long long>(status.counters.frames),
              static_cast<unsigned long long>(status.counters.bad_frames),
              static_cast<unsigned long long>(status.counters.lost_frames), status.rate_hz,
              1e3 * status.arrival_jitter_s, 1e3 * status.stamp_jitter_s);
}

std::string csvOf(const std::vector<imu::AngleSample>& samples) {
  std::ostringstream csv;
  csv.precision(17);
  csv << "# time (s), yaw (deg), pitch (deg), roll (deg)\n";
  for (const imu::AngleSample& sample : samples) {
    csv << sample.time_s << "," << sample.angles.yaw_deg << "," << sample.angles.pitch_deg << ","
        << sample.angles.roll_deg << "\n";
  }
  return csv.str();
}

void plot(const std::string& script, const std::string& path) {
  try {
    writeFileAtomically(path, eval::runGnuplot("set terminal svg size 900,500\n" + script, path));
  } catch (const eval::GnuplotError& error) {
    std::cerr << "imu_drift: no plot: " << error.what() << "\n";
  }
}

void plotDrift(const std::vector<imu::AngleSample>& samples, const std::string& folder) {
  std::ostringstream script;
  script << "set xlabel 'time (s)'\nset ylabel 'change (deg)'\nset grid\n$d << E\n";
  const std::size_t every = std::max<std::size_t>(1, samples.size() / 5000);
  const imu::ModuleAngles& first = samples.front().angles;
  for (std::size_t i = 0; i < samples.size(); i += every) {
    const imu::ModuleAngles& a = samples[i].angles;
    script << samples[i].time_s - samples.front().time_s << " " << wrapDegrees(a.yaw_deg - first.yaw_deg)
           << " " << wrapDegrees(a.pitch_deg - first.pitch_deg) << " "
           << wrapDegrees(a.roll_deg - first.roll_deg) << "\n";
  }
  script
      << "E\nplot $d using 1:2 with lines title 'yaw', $d using 1:3 with lines title 'pitch', $d using 1:4 "
         "with lines title 'roll'\n";
  plot(script.str(), folder + "/drift.svg");
}

void reportAllan(const RestRecording& recording, const std::string& folder) {
  const double period_s = (recording.rate_times_s.back() - recording.rate_times_s.front()) /
                          static_cast<double>(recording.rates.size() - 1);
  std::ostringstream data, plots;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> samples;
    for (const Eigen::Vector3d& rate : recording.rates) samples.push_back(rate[axis] * kDegPerRad);
    const auto points = imu::allanDeviation(samples, period_s);
    std::printf("  gyroscope %c: noise %.5f deg/s/sqrt(Hz), bias instability %.5f deg/s\n", "xyz"[axis],
                imu::noiseDensity(points), imu::biasInstability(points));
    data << "$d" << axis << " << E\n";
    for (const auto& point : points) data << point.tau_s << " " << point.deviation << "\n";
    data << "E\n";
    plots << (axis == 0 ? "plot" : ",") << " $d" << axis << " using 1:2 with lines title '"
          << "xyz"[axis] << "'";
  }
  plot("set logscale\nset grid\nset xlabel 'averaging time (s)'\nset ylabel 'Allan deviation (deg/s)'\n" +
           data.str() + plots.str() + "\n",
       folder + "/allan.svg");
}

bool parse(int argc, char** argv, Options& options) {
  po::options_description visible(
      helpHeading("usage: imu_drift (--port PORT | --bag BAG) [options]",
                  "Measures a module that lies still: drift of each angle, noise of the rates, stamps."));
  visible.add_options()("help,h", "this text");
  options.source.addOptions(visible);
  visible.add_options()                                                                                //
      ("duration", po::value(&options.duration_s)->default_value(options.duration_s), "seconds")       //
      ("output", po::value(&options.output)->default_value(options.output), "folder for the results")  //
      ("bag", po::value(&options.bag), "a recording instead of a port")                                //
      ("topic", po::value(&options.topic)->default_value(options.topic), "its sensor_msgs/Imu topic");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "", values)) return false;
  if (options.source.port.empty() == options.bag.empty()) {
    throw std::runtime_error("give either --port or --bag; see imu_drift --help");
  }
  options.source.finish();
  return true;
}

int run(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return 0;
  imu::ImuDeviceStatus status;
  const RestRecording recording =
      options.bag.empty() ? recordFromPort(options, status) : recordFromBag(options);
  if (options.bag.empty()) printStream(status);
  writeFileAtomically(options.output + "/samples.csv", csvOf(recording.angles));
  if (!recording.angles.empty()) {
    const imu::DriftReport drift = imu::measureDrift(recording.angles);
    std::printf("%.1f s at rest  drift (deg)  line (deg/min)  noise (deg)  largest (deg)\n",
                drift.duration_s);
    printDrift("yaw", drift.yaw);
    printDrift("pitch", drift.pitch);
    printDrift("roll", drift.roll);
    plotDrift(recording.angles, options.output);
  }
  if (recording.rates.size() > 100) reportAllan(recording, options.output);
  std::printf("results in %s\n", options.output.c_str());
  return recording.angles.empty() && recording.rates.empty() ? 1 : 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("imu_drift", stereo_nav::tools::run, argc, argv);
}
