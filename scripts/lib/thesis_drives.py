"""The course of the thesis and what its author's three drives estimated (its tables of position tests)."""

WAYPOINTS = [(1, 0), (2, 0), (3, 0), (4, 0), (5, 0), (6, 0.5), (7, 0.5), (8, 0.5), (8, 0), (8, -1), (8, -2), (8, -3)]

DRIVES = [
    [(0.85, 0), (1.83, 0.06), (2.66, 0.1), (3.43, 0.12), (4.7, 0.12), (5.8, 0.65), (7.6, 0.67), (9.4, 0.68), (9.88, 0.04),
     (9.9, -1), (9.9, -2.18), (10.08, -3.8)],
    [(1.5, -0.1), (2.18, -0.15), (3.3, -0.15), (4.7, -0.15), (6, 0), (6.6, 0.25), (9.6, 0.25), (11.42, 0.25), (11.2, -1.2),
     (11.2, -2.32), (11.1, -4.1), (11.1, -5.3)],
    [(0.98, 0.12), (2.6, 0), (3.3, 0.15), (4.5, 0.2), (5.9, 0.12), (7.58, 0.57), (9.09, 0.6), (10.59, 0.54), (11.03, 0.075),
     (11.03, -1.05), (11.02, -2.39), (11, -3.8)],
]

COURSE_LENGTH_M = 11.62


def distance(a, b):
    return ((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2) ** 0.5


def figures(estimates, truths=WAYPOINTS):
    """RMSE in x, y and distance over the way-points, and the error at the last one, all in metres."""
    def rms(values):
        return (sum(value ** 2 for value in values) / len(values)) ** 0.5

    return {
        "rmse_x_m": rms([e[0] - t[0] for e, t in zip(estimates, truths)]),
        "rmse_y_m": rms([e[1] - t[1] for e, t in zip(estimates, truths)]),
        "rmse_m": rms([distance(e, t) for e, t in zip(estimates, truths)]),
        "end_error_m": distance(estimates[-1], truths[-1]),
    }
