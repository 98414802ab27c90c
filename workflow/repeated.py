"""Sections of the report that repeat what the thesis measured (its chapter 4)."""
import statistics

import plots
import thesis_drives
from results import NAMES, drives_table, end_percent, spread, table, waypoints

THESIS_RECT_HZ, THESIS_DISPARITY_HZ, THESIS_LOWEST_HZ = 29.78, 29.735, 29.56
THESIS_FEATURES, THESIS_INLIERS = 149.99, 61.35
THESIS_DRIFT_DEG, THESIS_DRIFT_S = 2.9, 600
THESIS_BLOCK_RMSE_M = 0.066
# The conditions of the comparison with the thesis' drives: cameras with a clock each, blur, its IMU.
CONDITIONS = ("thesis_conditions", "two clocks, blur")


def live_rates(results, pictures):
    measured = results.json("live_rates.json")
    if not measured:
        return None
    rows, series = [], []
    for i, (topic, rates) in enumerate(measured["rates_hz"].items(), 1):
        if not rates:
            continue
        rows.append([topic, "%.2f" % statistics.mean(rates), "%.2f" % min(rates), "%.2f" % max(rates),
                     "%d of %d" % (measured["messages"][topic], measured["pairs"])])
        series.append((topic, "linespoints ls %d" % i,
                       [((n + 0.5) * measured["window_s"], rate) for n, rate in enumerate(rates)]))
    plots.lines(pictures + "/rates.svg", "time (s)", "messages per second, windows of %g s" % measured["window_s"], series,
                "set yrange [25:31]\nset xrange [0:*]\n")
    recorded_hz = measured["pairs"] / measured["duration_s"]
    kept_up = all(min(rates) >= THESIS_LOWEST_HZ for rates in measured["rates_hz"].values())
    verdict = ("Every window of every topic is at least the thesis' lowest." if kept_up else
               "Not every window reaches the thesis' lowest: the machine did not keep up, or had other work to do.")
    return ("## Rates of the node graph (tables 4-1 and 4-2)\n\nThe real graph, live: `replay.launch` plays %.0f s of the "
            "arena, rendered before, at real time (%.2f pairs per second) through the `image_proc` and `stereo_image_proc` "
            "nodelets and the odometry of `vo_thesis.yaml`; messages are counted in windows of %g s. %s\n\n%s\n\nThe thesis: "
            "rectified image %g Hz, disparity %g Hz on average, %g Hz at the lowest.\n\n![rates](experiments/rates.svg)" % (
                measured["duration_s"], recorded_hz, measured["window_s"], verdict,
                table(["topic", "mean (Hz)", "lowest (Hz)", "highest (Hz)", "messages, of pairs"], rows),
                THESIS_RECT_HZ, THESIS_DISPARITY_HZ, THESIS_LOWEST_HZ))


def yaw_drift(results, pictures):
    drift = results.json("yaw_drift.json")
    plots.lines(pictures + "/yaw_drift.svg", "time at rest (s)", "change of yaw (deg)", [
        ("simulated module", "lines ls 1", drift["curve"]),
        ("thesis, at the end", "points ls 2 ps 1.2", [(THESIS_DRIFT_S, THESIS_DRIFT_DEG)])], "set xrange [0:620]\n")
    return ("## Yaw drift at rest\n\n%.2f° in %.0f s from the simulated module, which is modelled after the thesis' "
            "(%g° in %g s).\n\n![yaw drift](experiments/yaw_drift.svg)" % (
                drift["drift_deg"], drift["duration_s"], THESIS_DRIFT_DEG, THESIS_DRIFT_S))


def features(results, pictures):
    group, point = CONDITIONS
    series, rows, marks = [], [], ""
    for config, colour in (("thesis_latest", 2), ("stereo", 1)):
        chosen = results.select(group, point, config)
        drive = chosen[0]
        frames = results.frames(drive)
        for kind, dashes in (("features", 3), ("inliers", 1)):
            series.append(("%s, %s" % (kind, NAMES[config]), "lines ls %d lw 1 dt %d" % (colour, dashes),
                           [(frame["time_s"], frame[kind]) for frame in frames]))
        if not marks:
            times = results.waypoint_times(drive)
            marks = "".join("set arrow %d from %g, graph 0 to %g, graph 1 nohead lc rgb '#9aa4ad' dt 2\n"
                            "set label %d '%d' at %g, graph 0.97 center tc rgb '#5f6b76'\n" % (n, t, t, n, n, t)
                            for n, t in enumerate(times, 1))
        rows.append([NAMES[config]] + [spread((row[key] for row in chosen), 1) for key in ("features_mean", "inliers_mean")])
    rows.append(["thesis, its three drives", THESIS_FEATURES, THESIS_INLIERS])
    plots.lines(pictures + "/features.svg", "time (s); numbers above: way-points", "per image", series,
                marks + "set yrange [0:220]\n")
    published = [float(row["inliers_mean"]) for row in results.select(group, point, "thesis_latest")]
    fewer = " The method as published has fewer inliers here than its author had." if max(published) < THESIS_INLIERS else ""
    return ("## Features and inliers over the course\n\nUnder the thesis' conditions (%s, latest disparity, its IMU); the "
            "plot shows seed 1.%s\n\n%s\n\n![features](experiments/features.svg)" % (
                point, fewer, table(["configuration", "features per image", "inliers per image"], rows)))


def triangulation(results, pictures):
    measured = results.json("triangulation.json")
    rows = [["%.1f" % row["true_m"], "%g" % row["thesis_m"]] +
            ["%.2f ± %.3f" % tuple(row[key]) if row[key] else "no match" for key in ("32", "64")] for row in measured["rows"]]
    series = [("thesis", "points ls 2", [(r["true_m"], r["thesis_m"] - r["true_m"]) for r in measured["rows"]
                                         if r["thesis_m"] > 0])]
    for style, key in ((3, "32"), (1, "64")):
        series.append(("range " + key, "yerrorlines ls %d" % style, [
            (r["true_m"], r[key][0] - r["true_m"], r[key][1]) for r in measured["rows"] if r[key]]))
    plots.lines(pictures + "/triangulation.svg", "true distance (m)", "error (m)", series)
    lost = [row for row in measured["rows"] if not row["32"]]
    explanation = ("f·B is 56.9 px·m: at 1.5 m the disparity is 37.9 px, beyond a search of 32. Then nothing matches; the "
                   "thesis lifted the marker of \"no disparity\", -1, and got f·B/(-1) = -56 m. ")
    explanation += ("Here a search of 32 finds nothing at %s m, one of 64 %s." % (
        ", ".join("%.1f" % row["true_m"] for row in lost),
        "finds the block at every distance" if all(row["64"] for row in measured["rows"]) else "does not find it everywhere")
                    if lost else "Here a search of 32 finds the block at every distance, too, which it should not.")
    better = "better" if measured["rmse_64_m"] < THESIS_BLOCK_RMSE_M else "worse"
    return ("## Triangulation (table 4-3)\n\nDistance of a block in the middle of the image, by `depth_at`: mean and spread "
            "over the frames of a second at rest. RMSE with range 64: %.3f m over all distances; with range 32: %.3f m over "
            "those that it finds (thesis: %g m without the first one), %s than the thesis. %s\n\n%s\n\n![triangulation]"
            "(experiments/triangulation.svg)" % (
                measured["rmse_64_m"], measured["rmse_32_m"], THESIS_BLOCK_RMSE_M, better, explanation,
                table(["true (m)", "thesis (m)", "range 32 (m)", "range 64 (m)"], rows)))


def _waypoint_table(drives):
    """Error at each way-point; drives: [(title, positions)]."""
    rows = []
    for number, truth in enumerate(thesis_drives.WAYPOINTS, 1):
        rows.append(["%d (%g, %g)" % (number, *truth)] +
                    ["%.2f" % thesis_drives.distance(positions[number - 1], truth) for _, positions in drives])
    figures = [thesis_drives.figures(positions) for _, positions in drives]
    for title, key in (("RMSE x", "rmse_x_m"), ("RMSE y", "rmse_y_m"), ("RMSE", "rmse_m"), ("error at the end", "end_error_m")):
        rows.append(["**%s**" % title] + ["%.2f" % f[key] for f in figures])
    rows.append(["**... % of the course**"] + ["%.1f" % (100 * f["end_error_m"] / thesis_drives.COURSE_LENGTH_M)
                                               for f in figures])
    return table(["way-point (m)"] + [title for title, _ in drives], rows)


def position_drives(results, pictures):
    group, point = CONDITIONS
    ours = {config: results.select(group, point, config)[:3] for config in ("thesis_latest", "stereo")}
    drives = [("thesis, drive %d" % n, drive) for n, drive in enumerate(thesis_drives.DRIVES, 1)]
    for config, title in (("thesis_latest", "as published"), ("stereo", "default")):
        drives += [("%s, seed %s" % (title, row["seed"]), waypoints(row)) for row in ours[config]]
    start = [(0, 0)]
    series = [("truth", "linespoints ls 6 lw 4", start + thesis_drives.WAYPOINTS)]
    for title, style, group_drives in (("thesis' drives", 3, thesis_drives.DRIVES),
                                       ("as published", 2, [waypoints(row) for row in ours["thesis_latest"]]),
                                       ("default", 1, [waypoints(row) for row in ours["stereo"]])):
        for n, drive in enumerate(group_drives):
            series.append((title if n == 0 else None, "linespoints ls %d lw 1" % style, start + list(drive)))
    plots.lines(pictures + "/positions.svg", "x (m)", "y (m)", series, "set size ratio -1\n", 560)
    ends = [end_percent(row) for row in results.select(group, point, "thesis_latest")]
    default = [end_percent(row) for row in results.select(group, point, "stereo")]
    ahead = thesis_drives.WAYPOINTS[7][0]  # way-point 8 is the farthest ahead
    theirs = [drive[7][0] for drive in thesis_drives.DRIVES]
    published = [waypoints(row)[7][0] for row in results.select(group, point, "thesis_latest")]
    if min(published) > ahead:
        sign = "The errors have the size and the sign of the thesis'."
    elif max(published) < ahead:
        sign = "The errors have the size of the thesis', but the other sign, which the simulation does not explain."
    else:
        sign = "The errors have the size of the thesis', but not always its sign."
    return ("## Position: three drives\n\nError at each way-point in metres. Ours are driven under the thesis' conditions: two "
            "cameras with a clock each, 15 ms of blur, the latest disparity map, its IMU. The thesis' figures are recomputed "
            "from its tables.\n\n%s\n\n![positions](experiments/positions.svg)\n\nOver all %d seeds the method as published "
            "ends %.0f to %.0f %% of the course away from the truth (thesis: 19 to 33 %%). At way-point 8, %g m ahead, it "
            "says %.1f to %.1f m (thesis: %.1f to %.1f m). %s The "
            "default ends %.1f to %.1f %% away on the same recordings.\n\n%s" % (
                _waypoint_table(drives), len(ends), min(ends), max(ends), ahead, min(published), max(published), min(theirs),
                max(theirs), sign, min(default), max(default),
                drives_table(results, ["ideal", "thesis_conditions"])))
