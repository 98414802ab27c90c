#!/usr/bin/python3
"""One row of the table of results: results_row.py CASE CONFIG FOLDER_OF_EVALUATE"""
import json
import sys


def text(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def main():
    case, config, folder = sys.argv[1:]
    with open(folder + "/summary.json") as file:
        summary = json.load(file)
    with open(folder + "/timing.json") as file:
        timing = json.load(file)
    frame_ms = timing["frame_time_ms"]
    cells = [case, config, str(summary["frames"]), str(summary["frames_lost"]), text(summary["ate_rmse_m"], 4),
             text(summary["rpe_translation_percent"], 2), text(summary["rpe_rotation_deg_per_m"], 3),
             text(summary["end_error_percent"], 2), text(frame_ms["median"], 2), text(frame_ms["p95"], 2),
             text(frame_ms["p95"] / frame_ms["median"], 2), text(timing["disparity_time_ms"], 1)]
    print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
