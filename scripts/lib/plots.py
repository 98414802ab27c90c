"""Pictures of the scripts and the experiments, drawn by gnuplot: one look for all."""
import statistics
import subprocess

COLOURS = ["#1668b3", "#c9302c", "#b36b00", "#2b8a57", "#7a4fa3", "#5f6b76"]


def draw(path, commands, height_px=400):
    """Runs gnuplot on the commands after a common header."""
    header = (
        "set terminal svg size 820,%d dynamic noenhanced font 'Helvetica,13' background rgb 'white'\nset output '%s'\n"
        "set border 3 lc rgb '#5f6b76'\nset tics nomirror out scale 0.6 textcolor rgb '#3a444d'\n"
        "set grid lc rgb '#dfe4e8' lw 1 dt 1\nset key outside top center horizontal samplen 2\n" % (height_px, path))
    styles = "".join("set style line %d lc rgb '%s' lw 2 pt 7 ps 0.6\n" % item for item in enumerate(COLOURS, 1))
    subprocess.run(["gnuplot"], input=header + styles + commands + "\n", text=True, check=True)


def quoted(text):
    """A string of gnuplot; two of its quotes stand for one."""
    return "'%s'" % text.replace("'", "''")


def quoted_label(text):
    """The label of an axis' tic, where % begins a format."""
    return quoted(text.replace("%", "%%"))


def block(rows):
    """Inline data of gnuplot; None interrupts the line."""
    return "".join(" ".join("%g" % value for value in row or ()) + "\n" for row in rows) + "e\n"


def tics(labels, rotate=False):
    return "set xtics (%s)%s\n" % (", ".join("%s %g" % (quoted_label(label), x) for x, label in labels),
                                   " rotate by -12" if rotate else "")


def curves(path, xlabel, ylabel, series, commands="", first_style=1):
    """Mean (line) and range (bars) over the seeds; series: title -> [(x, values of the seeds)], None interrupts."""
    text = "set xlabel %s\nset ylabel %s\nset yrange [0:*]\nset offsets graph 0.03, graph 0.03, graph 0.05, 0\n%s" % (
        quoted(xlabel), quoted(ylabel), commands)
    text += "plot " + ", ".join("'-' with yerrorlines ls %d title %s" % (i, quoted(title))
                                for i, title in enumerate(series, first_style)) + "\n"
    draw(path, text + "".join(block(point and (point[0], statistics.mean(point[1]), min(point[1]), max(point[1]))
                                    for point in points) for points in series.values()))


def seeds(path, ylabel, cases, commands=""):
    """One point for each seed, one column for each case; cases: [(label, values)]."""
    text = "set ylabel %s\nset xrange [-0.5:%g]\nset yrange [0:*]\nunset key\n" % (quoted(ylabel), len(cases) - 0.5)
    text += tics([(i, label) for i, (label, _) in enumerate(cases)], rotate=len(cases) > 4) + commands
    rows = [(i + 0.03 * (n - 0.5 * (len(values) - 1)), value) for i, (_, values) in enumerate(cases)
            for n, value in enumerate(values)]
    means = [(i - 0.25, statistics.mean(values), 0.5) for i, (_, values) in enumerate(cases)]
    draw(path, text + "plot '-' using 1:2:3:(0) with vectors nohead ls 2 lw 3, '-' with points ls 1 ps 0.7\n" +
         block(means) + block(rows))


def lines(path, xlabel, ylabel, series, commands="", height_px=400):
    """series: [(title or None, style, [(x, y)])]; style is gnuplot's, e.g. `lines ls 1`."""
    text = "set xlabel %s\nset ylabel %s\n%s" % (quoted(xlabel), quoted(ylabel), commands)
    text += "plot " + ", ".join("'-' with %s %s" % (style, "title " + quoted(title) if title else "notitle")
                                for title, style, _ in series) + "\n"
    draw(path, text + "".join(block(rows) for _, _, rows in series), height_px)
