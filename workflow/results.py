"""The workflow's results as the report reads them."""
import csv
import json
import os
import statistics

import cases
import thesis_drives

NAMES = {
    "thesis": "as published (matched disparity)",
    "thesis_latest": "as published, latest disparity",
    "thesis_vision": "as published, rotation from vision",
    "thesis_near": "as published, only features nearer than 8.1 m",
    "thesis_strict": "as published, rigidity threshold 2 cm",
    "thesis_true": "as published, true disparity",
    "thesis_true_64th": "as published, true disparity in steps of 1/64 px",
    "thesis_true_16th": "as published, true disparity in steps of 1/16 px",
    "thesis_range128": "as published (matched disparity)",
    "thesis_range256": "as published (matched disparity)",
    "stereo": "default (vo.yaml)",
    "stereo_unaware": "default, not told of the rolling shutter",
}


class Results:
    """Rows of results.csv and the JSON files beside it."""

    def __init__(self, folder):
        self.folder = folder
        with open(os.path.join(folder, "results.csv")) as file:
            self.rows = list(csv.DictReader(file))

    def json(self, name):
        """The content of a JSON file, None where it was not made."""
        path = os.path.join(self.folder, name)
        if not os.path.exists(path):
            return None
        with open(path) as file:
            return json.load(file)

    def select(self, group, point, config):
        return [row for row in self.rows if (row["group"], row["point"], row["config"]) == (group, point, config)]

    def points(self, group, config=None):
        """Names of the group's points that were evaluated (with this configuration)."""
        return [point for point in cases.GROUPS[group] if any(
            row["group"] == group and row["point"] == point and config in (None, row["config"]) for row in self.rows)]

    def values(self, group, point, config, key="rmse_m"):
        return [float(row[key]) for row in self.select(group, point, config)]

    def mean(self, group, point, config, key="rmse_m"):
        return statistics.mean(self.values(group, point, config, key))

    def frames(self, row):
        """Lines of frames.csv of an evaluated drive."""
        with open(os.path.join(self.folder, "evaluated", row["drive"], row["config"], "frames.csv")) as file:
            return [{key: float(value) for key, value in line.items() if value and key != "reason"} for line in csv.DictReader(file)]

    def waypoint_times(self, row):
        """Seconds from the first image to each passing of a way-point."""
        import rosbag

        with rosbag.Bag(os.path.join(self.folder, "signals", row["drive"] + ".bag")) as bag:
            start_s = next(m for _, m, _ in bag.read_messages(topics=["ground_truth/odom"])).header.stamp.to_sec()
            return [m.header.stamp.to_sec() - start_s for _, m, _ in bag.read_messages(topics=["ground_truth/waypoint"])]


def waypoints(row):
    """Estimated positions at the twelve way-points."""
    return json.loads(row["waypoints"])


def course_ratio(positions):
    """Length of the path over the way-points, of the course's: what can be told of the thesis' drives, too."""
    def length(points):
        return sum(thesis_drives.distance(a, b) for a, b in zip([(0, 0)] + points, points))

    return length(list(positions)) / length(thesis_drives.WAYPOINTS)


def end_percent(row):
    return 100 * float(row["end_error_m"]) / thesis_drives.COURSE_LENGTH_M


def spread(values, digits=2):
    """Mean and standard deviation of the seeds; more digits where the value is small."""
    values = [float(value) for value in values if value != ""]
    if not values:
        return "-"
    mean = statistics.mean(values)
    while digits < 4 and 0 < abs(mean) < 10 ** (1 - digits):
        digits += 1
    return "%.*f" % (digits, mean) + (" ± %.*f" % (digits, statistics.stdev(values)) if len(values) > 1 else "")


def table(header, rows):
    """Markdown."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def drives_table(results, groups):
    rows = []
    for group in groups:
        for point, (_, _, configs) in cases.GROUPS[group].items():
            for config in configs:
                chosen = results.select(group, point, config)
                if chosen:
                    rows.append([point, NAMES[config], len(chosen)] + [spread(row[key] for row in chosen) for key in (
                        "rmse_x_m", "rmse_y_m", "rmse_m", "end_error_m")] + [
                            spread((end_percent(row) for row in chosen), 1), spread(course_ratio(waypoints(row)) for row in chosen),
                            spread((row["inliers_mean"] for row in chosen), 1),
                            "%d of %d" % (sum(int(row["frames_lost"]) for row in chosen), sum(int(row["frames"]) for row in chosen))])
    return table(["drive", "configuration", "seeds", "RMSE x (m)", "RMSE y (m)", "RMSE (m)", "end error (m)",
                  "end error (% of course)", "way from point to point, estimated / true",
                  "inliers", "images lost"], rows)
