"""What the experiments run: every case is a simulated drive, evaluated with some configurations of the odometry."""
import collections
import hashlib
import os
import sys

import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scripts", "lib"))

Config = collections.namedtuple("Config", "file odometry disparity true_step_px options", defaults=({}, {}, None, ""))

# Configurations: a file of config/, what is changed in it and in config/disparity.yaml; with `true_step_px` the disparity
# map is the true one, rounded to that step (0: not at all); `options` are more of evaluate's.
CONFIGS = {
    "thesis": Config("vo_thesis.yaml"),
    "thesis_latest": Config("vo_thesis.yaml", {"thesis.disparity": "latest"}),
    "thesis_vision": Config("vo_thesis.yaml", {"thesis.rotation": "vision"}),
    "thesis_near": Config("vo_thesis.yaml", {"thesis.depth.min_disparity_px": 7.0}),
    "thesis_strict": Config("vo_thesis.yaml", {"thesis.rigidity.threshold_m": 0.02}),
    "thesis_true": Config("vo_thesis.yaml", true_step_px="0"),
    "thesis_true_64th": Config("vo_thesis.yaml", true_step_px="0.015625"),
    "thesis_true_16th": Config("vo_thesis.yaml", true_step_px="0.0625"),
    # The nearest depth that is found stays 0.89 m when the images get larger.
    "thesis_range128": Config("vo_thesis.yaml", {}, {"disparity_range": 128}),
    "thesis_range256": Config("vo_thesis.yaml", {}, {"disparity_range": 256}),
    "stereo": Config("vo.yaml"),
    "stereo_unaware": Config("vo.yaml", options="--rolling-shutter-ms 0"),
}

BOTH = ["thesis", "stereo"]
# The thesis' two choices (disparity map, source of the rotation) beside the default.
CHOICES = ["thesis", "thesis_latest", "thesis_vision", "stereo"]
PERFECT = ["imu.kind=perfect"]
TWO_CLOCKS = ["timing.free_running=true", "timing.clock_ppm=200", "timing.jitter_ms=1"]
BLUR = ["sensor.exposure_ms=15"]
# Slower cameras for the comparison of resolutions: large images cost 16 times as much to render.
TEN_HZ = PERFECT + ["timing.rate_hz=10"]
# The first is the thesis' module: 2.9 deg in 600 s.
DRIFTS_DPS = ["0.0048", "0.03", "0.1", "0.3", "1"]

# group -> point -> (scenario, settings, configurations). The settings are those of `simulate --set`.
GROUPS = {
    "accuracy": {
        "arena 320x240": ("arena", [], ["stereo"]),
        "arena 640x480": ("arena", ["rig.image_scale=2"], ["stereo"]),
        "standstill": ("standstill", [], ["stereo"]),
        "turn_in_place": ("turn_in_place", [], ["stereo"]),
    },
    "ideal": {
        "ideal": ("arena", PERFECT, BOTH + ["thesis_near", "thesis_strict", "thesis_true", "thesis_true_64th", "thesis_true_16th"]),
    },
    "ablation": {
        "10 Hz": ("arena", TEN_HZ, ["thesis"]),
        "1 m/s": ("arena", PERFECT + ["motion.max_speed_mps=1.0"], ["thesis"]),
        "no noise, no blur": ("arena", PERFECT + ["sensor.read_noise=0", "sensor.shot_noise=0", "sensor.exposure_ms=0"],
                              ["thesis"]),
    },
    "thesis_conditions": {
        "two clocks, blur": ("arena", TWO_CLOCKS + BLUR, CHOICES),
        "two clocks, no blur": ("arena", TWO_CLOCKS + ["sensor.exposure_ms=0"], ["thesis_latest"]),
        "one clock, blur": ("arena", BLUR, ["thesis_latest"]),
    },
    "skew": {str(skew): ("arena", PERFECT + (["timing.time_offset_ms=%d" % skew] if skew else []), CHOICES)
             for skew in (0, 4, 8, 12, 16)},
    "free": {"free": ("arena", PERFECT + ["timing.free_running=true", "timing.jitter_ms=1"], CHOICES)},
    "rolling": {
        "0 ms": ("arena", PERFECT, BOTH),
        **{"%d ms" % readout: ("arena", PERFECT + ["sensor.rolling_shutter_ms=%d" % readout],
                               ["thesis", "stereo_unaware", "stereo"]) for readout in (10, 20, 30)},
        "30 ms, two clocks": ("arena", PERFECT + TWO_CLOCKS + ["sensor.rolling_shutter_ms=30"],
                              ["thesis", "stereo_unaware", "stereo"]),
    },
    "resolution": {
        "320x240": ("arena", TEN_HZ, BOTH),
        "640x480": ("arena", TEN_HZ + ["rig.image_scale=2"], ["thesis_range128", "stereo"]),
        "1280x960": ("arena", TEN_HZ + ["rig.image_scale=4"], ["thesis_range256", "stereo"]),
    },
    "drift": {"0": ("arena", PERFECT, ["thesis_vision"]), **{
        drift: ("arena", ["imu.kind=thesis", "imu.yaw_drift_dps=" + drift], BOTH) for drift in DRIFTS_DPS}},
}

# Courses on which the filter's sensors are compared, and what is set beside their files. One ray a pixel renders four times as fast.
FUSION = {
    "office": ["rig.samples_per_pixel=1"],
    "long_corridor": ["rig.samples_per_pixel=1"],
    "arena": ["rig.samples_per_pixel=1", "wheels.radius_sigma=0.03", "wheels.position_sigma_m=0.003", "wheels.slip_sigma_m=0.01"],
}


def bag_name(scenario, settings, seed):
    """A file name that says what is in it; equal drives of different groups share it."""
    parts = [scenario] + ["%s=%s" % tuple(setting.split("=")) for setting in sorted(settings)] + ["seed%d" % seed]
    return "__".join(part.replace("/", "_") for part in parts)


def settings_with_same_images(scenario, settings):
    """The settings of a case with the same images that differs in its IMU alone, since images cost much more than the
    rest. None if there is no such case."""
    others = [setting for setting in settings if not setting.startswith("imu.")]
    cases_of_all = [(case[0], sorted(case[1])) for points in GROUPS.values() for case in points.values()]
    return others if others != settings and (scenario, sorted(others)) in cases_of_all else None


def all_runs(groups, seeds_of, leave_out=()):
    """One (group, point, config, seed, bag name, scenario, settings) for everything that is evaluated."""
    runs = []
    for group in groups:
        for point, (scenario, settings, configs) in GROUPS[group].items():
            if point in leave_out:
                continue
            for seed in seeds_of(group):
                for config in configs:
                    runs.append((group, point, config, seed, bag_name(scenario, settings, seed), scenario, settings))
    return runs


def digest(*paths):
    """Hash of these files, and of all files in these folders, of the package: it changes when a result may change."""
    total = hashlib.sha256()
    for path in paths:
        top = os.path.join(ROOT, path)
        files = [top] if os.path.isfile(top) else sorted(
            os.path.join(folder, name) for folder, _, names in os.walk(top) for name in names)
        for name in files:
            with open(name, "rb") as file:
                total.update(file.read())
    return total.hexdigest()[:16]


def scenario_files(name):
    """The file of a scenario and those that it extends, relative to config/scenarios."""
    with open(os.path.join(ROOT, "config", "scenarios", name)) as file:
        extended = yaml.safe_load(file).get("extends", [])
    folder = os.path.dirname(name)
    files = [name]
    for other in [extended] if isinstance(extended, str) else extended:
        files += scenario_files(os.path.normpath(os.path.join(folder, other)))
    return files


def scenario_digest(scenario):
    return digest(*("config/scenarios/" + name for name in scenario_files(scenario + ".yaml")))


def simulator_digest():
    return digest("src/sim", "src/core", "src/ros/simulated_messages.cpp", "src/tools/simulate",
                  "config/thesis")


def fusion_digest():
    return digest("src/core", "src/vision", "src/odometry", "src/estimation", "src/tools/fusion_experiment", "config/fusion")


def odometry_digest():
    return digest("src/core", "src/vision", "src/odometry", "src/eval", "src/ros/stereo_processing.cpp",
                  "src/ros/recording.cpp", "src/ros/pairing.cpp", "src/tools/evaluate")
