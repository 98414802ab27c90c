"""Section of the report that holds figures against what was asked for."""
import statistics

import plots
from results import end_percent, table
from repeated import CONDITIONS


def _verdict(met):
    return "met" if met else "**missed**"


def _percent_of_path(rows):
    return [100 * float(row["path_rmse_m"]) / float(row["path_length_m"]) for row in rows]


def _accuracy_rows(results):
    """(what, bound, unit, values of the seeds) for everything that is told as a median."""
    def rows(point):
        return results.select("accuracy", point, "stereo")

    return [
        ("arena 320x240, RMSE", 1.0, "% of the path", _percent_of_path(rows("arena 320x240"))),
        ("arena 640x480, RMSE", 0.5, "% of the path", _percent_of_path(rows("arena 640x480"))),
        ("standstill 60 s, drift", 5.0, "mm", [1e3 * float(row["final_error_m"]) for row in rows("standstill")]),
        ("standstill 60 s, drift", 0.1, "deg", [float(row["final_rotation_deg"]) for row in rows("standstill")]),
        ("turn in place by 360 deg", 2.0, "cm", [1e2 * float(row["first_stop_error_m"]) for row in rows("turn_in_place")]),
    ]


def accuracy(results, pictures):
    cases = [case for case in _accuracy_rows(results) if case[3]]
    if not cases:
        return None
    rows = [["%s (%s)" % (what, unit), len(values), "%.3g" % statistics.median(values), "%.3g" % max(values), "%g" % bound,
             _verdict(statistics.median(values) <= bound)] for what, bound, unit, values in cases]
    plots.seeds(pictures + "/accuracy.svg", "error, as a share of what is allowed",
                [("%s (%s)" % (what, unit), [value / bound for value in values]) for what, bound, unit, values in cases],
                "set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lc rgb '#2b8a57' dt 2\n")
    turns = results.select("accuracy", "turn_in_place", "stereo")
    return ("## Accuracy of the default\n\n`vo.yaml`, synchronised cameras at 30 Hz, the thesis' IMU. RMSE is that of all "
            "images' positions with the first poses laid together. The turn is measured at the first stop, after 360°; at the "
            "end of the scenario, after three turns, the error is %.1f cm (median) and %.1f cm (worst).\n\n%s\n\n![accuracy]"
            "(experiments/accuracy.svg)" % (
                100 * statistics.median(float(row["final_error_m"]) for row in turns),
                100 * max(float(row["final_error_m"]) for row in turns),
                table(["what", "seeds", "median", "worst", "at most (median)", ""], rows)))


def requirements(results, pictures):
    ideal = results.values("ideal", "ideal", "thesis")
    ends = [end_percent(row) for row in results.select(*CONDITIONS, "thesis_latest")]
    rows = [
        ["method as published, ideal arena: RMSE", "at most 0.25 m", "%.2f m (%.2f to %.2f)" % (
            statistics.mean(ideal), min(ideal), max(ideal)), _verdict(max(ideal) <= 0.25)],
        ["method as published, thesis' conditions: end error", "5 to 30 % of the course", "%.1f %% (%.1f to %.1f)" % (
            statistics.mean(ends), min(ends), max(ends)), _verdict(5 <= min(ends) and max(ends) <= 30)],
    ]
    note = "" if all("missed" not in row[-1] for row in rows) else \
        " What is missed is taken apart in [Which stage is the cause](#which-stage-is-the-cause)."
    return "## What was asked for\n\nMean of the seeds, best and worst; a verdict holds for every seed.%s\n\n%s" % (
        note, table(["what", "wanted", "measured", ""], rows))
