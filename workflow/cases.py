"""What the experiments run: every case is a simulated drive, evaluated with some configurations of the odometry."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scripts", "lib"))

# Configurations: a file of config/ and what is changed in it.
CONFIGS = {
    "thesis": ("vo_thesis.yaml", {}),
    "thesis_latest": ("vo_thesis.yaml", {"thesis.disparity": "latest"}),
    "thesis_vision": ("vo_thesis.yaml", {"thesis.rotation": "vision"}),
    "thesis_near": ("vo_thesis.yaml", {"thesis.depth.min_disparity_px": 7.0}),
    "thesis_strict": ("vo_thesis.yaml", {"thesis.rigidity.threshold_m": 0.02}),
    "stereo": ("vo.yaml", {}),
}

BOTH = ["thesis", "stereo"]
PERFECT = ["imu.kind=perfect"]
REAL_CAMERAS = ["timing.free_running=true", "timing.clock_ppm=200", "timing.jitter_ms=1", "sensor.exposure_ms=15"]

# group -> point -> (scenario, settings, configurations). The settings are those of `simulate --set`.
GROUPS = {
    "ideal": {
        "ideal": ("arena", PERFECT, BOTH + ["thesis_near", "thesis_strict"]),
    },
    "ablation": {
        "10 Hz": ("arena", PERFECT + ["timing.rate_hz=10"], ["thesis"]),
        "1 m/s": ("arena", PERFECT + ["motion.max_speed_mps=1.0"], ["thesis"]),
        "no noise, no blur": ("arena", PERFECT + ["sensor.read_noise=0", "sensor.shot_noise=0", "sensor.exposure_ms=0"],
                              ["thesis"]),
    },
    "thesis_conditions": {
        "free running, latest": ("arena", REAL_CAMERAS, ["thesis_latest", "thesis", "stereo", "thesis_vision"]),
    },
    "skew": {str(skew): ("arena", PERFECT + (["timing.skew_ms=%d" % skew] if skew else []), BOTH)
             for skew in (0, 4, 8, 12, 16)},
    "free": {"free": ("arena", PERFECT + ["timing.free_running=true", "timing.jitter_ms=1"], BOTH)},
    "resolution": {
        "320x240": ("arena", PERFECT, BOTH),
        "640x480": ("arena", PERFECT + ["rig.image_scale=2"], BOTH),
        "1280x960": ("arena", PERFECT + ["rig.image_scale=4"], BOTH),
    },
}


def bag_name(scenario, settings, seed):
    """A file name that says what is in it; equal drives of different groups share it."""
    parts = [scenario] + ["%s=%s" % tuple(setting.split("=")) for setting in sorted(settings)] + ["seed%d" % seed]
    return "__".join(part.replace("/", "_") for part in parts)


def all_runs(groups, seeds, leave_out=()):
    """One (group, point, config, seed, bag name, scenario, settings) for everything that is evaluated."""
    runs = []
    for group in groups:
        for point, (scenario, settings, configs) in GROUPS[group].items():
            if point in leave_out:
                continue
            for seed in seeds:
                for config in configs:
                    runs.append((group, point, config, seed, bag_name(scenario, settings, seed), scenario, settings))
    return runs
