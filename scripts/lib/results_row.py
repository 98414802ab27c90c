#!/usr/bin/python3
"""One row of a table of results: results_row.py [--simulated] CASE CONFIG FOLDER_OF_EVALUATE

Of a recording with times; with --simulated the consistency in their place: the mean of NEES (6 expected), and that of
translation and rotation apart (3 each), and how many are inside the ellipsoid of 95 %.
"""
import json
import sys


def text(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def load(path):
    with open(path) as file:
        return json.load(file)


def times(folder):
    timing = load(folder + "/timing.json")
    frame_ms = timing["frame_time_ms"]
    return [text(frame_ms["median"], 2), text(frame_ms["p95"], 2), text(frame_ms["p95"] / frame_ms["median"], 2),
            text(timing["disparity_time_ms"], 1)]


def consistency(nees):
    if not nees["pairs"]:
        return "-"
    return "%.1f (%.1f + %.1f), %.0f %%" % (
        nees["mean"], nees["translation"], nees["rotation"], nees["inside_95_percent"])


def main(arguments):
    simulated = arguments[0] == "--simulated"
    case, config, folder = arguments[1:] if simulated else arguments
    summary = load(folder + "/summary.json")
    cells = [case, config, str(summary["frames"]), str(summary["frames_lost"]), text(summary["ate_rmse_m"], 4),
             text(summary["rpe_translation_percent"], 2), text(summary["rpe_rotation_deg_per_m"], 3)]
    if simulated:
        cells += [consistency(summary["nees"][interval]) for interval in ("0.2", "1", "5")]
    else:
        cells += [text(summary["end_error_percent"], 2)] + times(folder)
    print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
