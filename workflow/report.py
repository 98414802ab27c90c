#!/usr/bin/env python3
"""Writes docs/experiments.md and its plots from the workflow's results.

usage: report.py RESULTS_FOLDER DOCS_FOLDER
"""
import os
import sys

import cases  # noqa: F401, finds the modules of scripts/lib
import curves
import repeated
import requirements
from results import Results

# Each section and the groups of drives that it tells about; it is left out when one of them was not driven.
SECTIONS = [
    (requirements.requirements, ["ideal", "thesis_conditions"]),
    (requirements.accuracy, ["accuracy"]),
    (repeated.live_rates, []),
    (repeated.yaw_drift, []),
    (repeated.features, ["thesis_conditions"]),
    (repeated.triangulation, []),
    (repeated.position_drives, ["ideal", "thesis_conditions"]),
    (curves.causes, ["ideal", "ablation", "thesis_conditions"]),
    (curves.skew, ["skew", "free"]),
    (curves.disparity_choice, ["skew", "free"]),
    (curves.rotation, ["skew", "free", "drift"]),
    (curves.rolling_shutter, ["rolling"]),
    (curves.resolution, ["resolution"]),
]

INTRODUCTION = """# The thesis' experiments, repeated in simulation

Made by `scripts/experiments.sh`: {runs} evaluations of {drives} simulated drives with exact ground truth. No figure and no
verdict here is typed by hand; the same command makes this page again. ± is the standard deviation over the seeds; bars in
the plots reach from the best to the worst seed. Unless said otherwise errors are those at the twelve way-points of the
arena, as the author measured them, and both configurations drive on the same recordings: `vo_thesis.yaml` is the method
as published, `vo.yaml` the default. "Ideal" means synchronised cameras and an IMU without error."""


def main():
    folder, docs = sys.argv[1:3]
    results = Results(folder)
    pictures = os.path.join(docs, "experiments")
    os.makedirs(pictures, exist_ok=True)
    texts = [INTRODUCTION.format(runs=len({(row["drive"], row["config"]) for row in results.rows}),
                                 drives=len({row["drive"] for row in results.rows}))]
    for section, groups in SECTIONS:
        text = section(results, pictures) if all(results.points(group) for group in groups) else None
        if text:
            texts.append(text)
    with open(os.path.join(docs, "experiments.md"), "w") as file:
        file.write("\n\n".join(texts) + "\n")


if __name__ == "__main__":
    main()
