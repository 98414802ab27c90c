#!/usr/bin/env python3
"""Writes docs/experiments.md and its plots from the workflow's results.

usage: report.py RESULTS_FOLDER DOCS_FOLDER
"""
import os
import sys

import curves
import repeated
import requirements
from results import Results

SECTIONS = [
    requirements.requirements,
    requirements.accuracy,
    repeated.live_rates,
    repeated.yaw_drift,
    repeated.features,
    repeated.triangulation,
    repeated.position_drives,
    curves.causes,
    curves.skew,
    curves.disparity_choice,
    curves.rotation,
    curves.resolution,
]

INTRODUCTION = """# The thesis' experiments, repeated in simulation

Made by `scripts/experiments.sh`: {runs} evaluations of {drives} simulated drives with exact ground truth. No figure and no
verdict here is typed by hand; the same command makes this page again. ± is the standard deviation over the seeds, bars in
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
    texts += [text for text in (section(results, pictures) for section in SECTIONS) if text]
    with open(os.path.join(docs, "experiments.md"), "w") as file:
        file.write("\n\n".join(texts) + "\n")


if __name__ == "__main__":
    main()
