#!/usr/bin/env python3
"""Gives altered recordings to import_sequence and evaluate: the path is right, or a message names what is wrong.

usage: variants_test.py PROGRAMS_DIR [NAME...]     (only variants whose name contains a NAME; then with their output)

A variant passes when the error of its path is at most the larger of 2 % of the path and 2 cm, or when the program ends
with exit status 2 or 3, or says `note:`, `warning:` or `lost:`, in words that match what the variant is about. A wrong
path without a word, a signal and a program that does not end are failures, and so is a refusal of what is accepted.
"""
import multiprocessing
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

from calibration_variants import calibration_variants
from expected_failures import EXPECTED_FAILURES
from folder_variants import TOE_IN_DEG, dialect_variants, layout_variants
from image_variants import image_variants, stamp_variants
from recording import TRUTH, Recording, rotation, simulate, write_calibration
from sensor_variants import imu_variants, rig_variants

LIMIT_M, LIMIT_SHARE = 0.02, 0.02
TIME_LIMIT_S = 60
REFUSALS = (2, 3)
T_BASE_CAMERA_M = np.array([0.1, 0.0613, 0.283])
SAID = re.compile(r'note:|warning:|lost:|lost,|set aside', re.IGNORECASE)


def make_bases(programs, folder):
    """The clean recordings from which variants start, simulated with different calibrations."""
    drive = pathlib.Path(__file__).resolve().parent / 'drive.yaml'
    calibrations = {
        'clean': write_calibration(folder / 'rectified'),
        'toe_in': write_calibration(folder / 'toe_in', R=rotation('y', -TOE_IN_DEG)),
        'rolled': write_calibration(folder / 'rolled', R=rotation('z', 1.0)),
        'raw': None,
    }
    bases = {}
    for name, calibration in calibrations.items():
        bag = folder / f'{name}.bag'
        simulate(programs, drive, bag, calibration)
        bases[name] = Recording(bag)
    return bases


def positions(recording):
    """Stamps of the truth, and where base_link and the left camera are, each from its own first position."""
    stamps, base, camera = [], [], []
    for odometry in recording.of(TRUTH):
        p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
        vector = np.array([q.x, q.y, q.z])
        turned = T_BASE_CAMERA_M + 2 * np.cross(vector, np.cross(vector, T_BASE_CAMERA_M) + q.w * T_BASE_CAMERA_M)
        stamps.append(odometry.header.stamp.to_sec())
        base.append([p.x, p.y, p.z])
        camera.append(np.array([p.x, p.y, p.z]) + turned - T_BASE_CAMERA_M)
    return np.array(stamps), np.array(base), np.array(camera)


def path_error(variant, truth, trajectory):
    """Largest distance from the truth, m, and what is allowed; of base_link or, in folders without one, the camera."""
    stamps, base, camera = positions(truth)
    rows = np.atleast_2d(np.loadtxt(trajectory))
    if rows.shape[1] < 8:
        return float('inf'), 0.0
    of_camera = variant.make and 'euroc' not in variant.name
    expected = camera if of_camera else base
    allowed = max(LIMIT_M, LIMIT_SHARE * np.linalg.norm(np.diff(expected, axis=0), axis=1).sum())
    found = rows[:, 1:4] - rows[0, 1:4]
    error = np.linalg.norm(found[-1] - expected[-1])
    if variant.stamps == 'own':
        times = rows[:, 0] - rows[0, 0]
        first = 0.0 if of_camera else rows[0, 0] - stamps[0]
        if not 0.0 <= first < stamps[-1] - stamps[0]:
            first = 0.0
        at = [np.interp(times + first + stamps[0], stamps, expected[:, axis]) for axis in range(3)]
        at = np.array(at).T
        error = max(error, np.linalg.norm(found - (at - at[0]), axis=1).max())
    return error, allowed


def run(program, arguments):
    """Exit status (negative: signal; 'hangs') and output."""
    try:
        done = subprocess.run([str(program), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=TIME_LIMIT_S, check=False)
    except subprocess.TimeoutExpired:
        return 'hangs', ''
    return done.returncode, done.stdout.decode(errors='replace')


def process(variant, programs, folder, recording):
    """Writes the variant and runs the programs on it. Returns exit status, output, trajectory."""
    bag, output = folder / 'variant.bag', ''
    if variant.make:
        arguments, images = variant.make(folder / 'images', recording)
        status, output = run(programs / 'import_sequence', [*arguments, images, '--output', bag])
        if status != 0:
            return status, output, None
    else:
        recording.write(bag)
    if variant.damage:
        variant.damage(bag)
    status, said = run(programs / 'evaluate', [bag, '--output', folder / 'results', *variant.arguments])
    return status, output + said, folder / 'results' / 'trajectory.tum'


def message_of(variant, output):
    """The first line that names what the variant is about: a note, or the reason of a refusal."""
    lines = [line.strip() for line in output.splitlines()]
    return next((line for line in lines if re.search(variant.names, line) and
                 (SAID.search(line) or re.match(r'(evaluate|import_sequence): ', line))), None)


def judge(variant, programs, folder, truth):
    """Returns (passed, what happened)."""
    recording = truth.copy()
    if variant.change:
        variant.change(recording)
    status, output, trajectory = process(variant, programs, folder, recording)
    message = message_of(variant, output) if variant.names else None
    if status not in (0, *REFUSALS):
        return False, f'ends with {status}: {output[-300:]}'
    if status == 2:
        if variant.right:
            return False, f'refused, though it is accepted: {output.strip()[-300:]}'
        return message is not None, f'refused: {message or output.strip()[-300:]}'
    error, allowed = path_error(variant, truth, trajectory)
    what = f'error {100 * error:.1f} cm of {100 * allowed:.1f} cm, exit status {status}'
    if status == 0 and error <= allowed:
        return True, what + (f'; {message}' if message else '')
    return message is not None and not variant.right, f'{what}; {message or "no word of it"}'


def judge_in_process(number):
    variant = VARIANTS[number]
    with tempfile.TemporaryDirectory() as folder:
        try:
            return judge(variant, PROGRAMS, pathlib.Path(folder), BASES[variant.base])
        except Exception as error:  # one variant that cannot be made must not hide the others
            return False, f'{type(error).__name__}: {error}'


def report(results):
    """Prints TAP. Returns the number of surprises."""
    surprises = 0
    print(f'1..{len(results)}')
    for number, (variant, (passed, what)) in enumerate(results, 1):
        reason = EXPECTED_FAILURES.get(variant.name)
        surprises += passed == (reason is not None)
        todo = f' # TODO {reason}' if reason else ''
        print(f"{'ok' if passed else 'not ok'} {number} - {variant.name}{todo}\n# {what}", flush=True)
    passed = sum(result[0] for _, result in results)
    print(f'# {passed} of {len(results)} variants pass, {len(results) - passed} fail; {surprises} not as expected')
    return surprises


if __name__ == '__main__':
    PROGRAMS = pathlib.Path(sys.argv[1])
    # The programs look up scenarios and configurations in the package.
    os.environ['ROS_PACKAGE_PATH'] = str(pathlib.Path(__file__).resolve().parents[2])
    every = (calibration_variants() + image_variants() + stamp_variants() + imu_variants() + rig_variants() +
             layout_variants() + dialect_variants())
    VARIANTS = [v for v in every if len(sys.argv) < 3 or any(name in v.name for name in sys.argv[2:])]
    unknown = set(EXPECTED_FAILURES) - {variant.name for variant in every}
    if unknown:
        sys.exit(f'variants_test.py: expected to fail, but not there: {sorted(unknown)}')
    with tempfile.TemporaryDirectory() as top:
        BASES = make_bases(PROGRAMS, pathlib.Path(top))
        with multiprocessing.get_context('fork').Pool(os.cpu_count()) as pool:
            outcomes = pool.map(judge_in_process, range(len(VARIANTS)), chunksize=1)
    sys.exit(1 if report(list(zip(VARIANTS, outcomes))) else 0)
