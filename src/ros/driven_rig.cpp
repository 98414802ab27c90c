#include "ros/driven_rig.h"

#include "core/angles.h"
#include "kinematics/drive_file.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::ros_io {
namespace {

/// Whether the file has the section, which is read then.
template <class Params>
bool readSection(const RigFile& rig, const char* name, Params& params) {
  const YAML::Node section = rig.section(name);
  if (!section.IsDefined() || section.IsNull()) return false;
  readParameters(section, rig.sectionName(name), params);
  return true;
}

}  // namespace

DrivenDevices readDrivenDevices(const RigFile& rig) {
  DrivenDevices devices;
  devices.rig.drive = kinematics::readDrive(rig);
  readSection(rig, rig_sections::kBase, devices.base);
  devices.base.checkNames();
  devices.rig.limits = devices.base.limits;
  devices.rig.command_rate_hz = devices.base.command_rate_hz;
  devices.rig.cmd_vel_timeout_s = devices.base.cmd_vel_timeout_s;
  if (readSection(rig, rig_sections::kLaser, devices.laser))
    devices.rig.lasers = {{rig.mounting().laser.T_base_sensor(), devices.laser.device.scan}};
  readSection(rig, rig_sections::kRangeFinders, devices.finders);
  devices.finders.checkNames();
  for (const BaseRangeParams& finder : devices.base.ranges) {
    devices.rig.ranges.push_back({finder.mounting.T_base_sensor(), kRadPerDeg * finder.field_of_view_deg,
                                  finder.min_range_m, finder.max_range_m});
  }
  for (const RangeFinderParams& finder : devices.finders.finders) {
    devices.rig.ranges.push_back({finder.mounting.T_base_sensor(), kRadPerDeg * finder.field_of_view_deg,
                                  finder.device.range_min_m, finder.device.range_max_m});
  }
  return devices;
}

}  // namespace stereo_nav::ros_io
