#!/usr/bin/env python3
"""Any list of bags x configurations through the workflow: on this machine, and as jobs of a Slurm cluster.

usage: workflow_test.py BUILD_DIR [TEST...]; exit status 77: everything was skipped.
"""
import csv
import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import one_node_slurm

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD_DIR = ""
CONFIGS = ["vo.yaml", "vo_thesis.yaml"]


def run(arguments, folder, environment=None):
    """scripts/experiments.sh, called from `folder` as its user would, with relative paths."""
    command = [ROOT + "/scripts/experiments.sh", "--build", BUILD_DIR, "--output", folder + "/results"] + arguments
    return subprocess.run(command, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


@unittest.skipUnless(shutil.which("snakemake"), "snakemake is not installed")
class WorkflowTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="workflow_test.")
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name
        shutil.copy(ROOT + "/bags/arena_start.bag", self.folder + "/arena.bag")
        os.makedirs(self.folder + "/other")
        shutil.copy(BUILD_DIR + "/fixture/room.bag", self.folder + "/other/room.bag")
        # A configuration of the researcher's own.
        with open(ROOT + "/config/vo_thesis.yaml") as source, open(self.folder + "/mine.yaml", "w") as copy:
            copy.write(source.read().replace("per_bucket: 15", "per_bucket: 10"))

    def evaluate(self, bags, configs, arguments=(), environment=None):
        result = run(["recordings", *arguments, "--config", "bags=" + bags, "configs=" + configs], self.folder, environment)
        self.assertEqual(result.returncode, 0, result.stdout)
        with open(self.folder + "/results/recordings.csv") as file:
            return list(csv.DictReader(file)), result.stdout


class RecordingsTest(WorkflowTest):
    def test_every_bag_with_every_configuration_in_one_table(self):
        rows, _ = self.evaluate("arena.bag,other/room.bag", "vo.yaml,mine.yaml")
        self.assertEqual({(row["bag"], row["config_file"]) for row in rows},
                         {(bag, config) for bag in ("arena", "room") for config in ("vo", "mine")})
        of = {(row["bag"], row["config_file"]): row for row in rows}
        self.assertEqual(of["arena", "vo"]["frames"], "81")
        self.assertLess(float(of["arena", "vo"]["end_error_percent"]), 5.0)
        self.assertLessEqual(float(of["arena", "mine"]["features_mean"]), 100.0)
        with open(self.folder + "/results/recordings/room/mine/summary.json") as file:
            self.assertEqual(float(of["room", "mine"]["ate_rmse_m"]), json.load(file)["ate_rmse_m"])

        # Incremental: only what is new is evaluated.
        _, output = self.evaluate("arena.bag,other/room.bag", "vo.yaml,mine.yaml")
        self.assertIn("Nothing to be done", output)
        rows, output = self.evaluate("arena.bag,other/room.bag", "vo.yaml,mine.yaml,vo_thesis.yaml")
        self.assertEqual(len(rows), 6)
        self.assertRegex(output, r"(?m)^evaluate_recording +2 ")

    def test_what_fails_is_shown_and_what_is_alike_is_refused(self):
        with open(self.folder + "/broken.bag", "w") as file:
            file.write("no bag")
        result = run(["recordings", "--config", "bags=broken.bag,arena.bag", "configs=vo.yaml"], self.folder)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("evaluate: ", result.stdout)
        self.assertTrue(os.path.exists(self.folder + "/results/recordings/arena/vo/summary.json"), "the others go on")
        shutil.copy(self.folder + "/arena.bag", self.folder + "/other/arena.bag")
        result = run(["recordings", "--config", "bags=arena.bag,other/arena.bag"], self.folder)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("same name", result.stdout)


@unittest.skipIf(one_node_slurm.what_is_missing(), one_node_slurm.what_is_missing())
class SlurmTest(WorkflowTest):
    def test_the_profile_runs_every_step_as_a_job_with_the_same_results(self):
        here, _ = self.evaluate("arena.bag,other/room.bag", ",".join(CONFIGS))
        shutil.rmtree(self.folder + "/results")
        cluster_folder = self.folder + "/cluster"
        os.makedirs(cluster_folder)
        with one_node_slurm.OneNodeSlurm(cluster_folder) as slurm:
            profile = ["--profile", ROOT + "/workflow/profile/slurm"]
            there, _ = self.evaluate("arena.bag,other/room.bag", ",".join(CONFIGS), profile, slurm.environment)
            self.assertEqual(there, here)
            # One job for each evaluation, each in Slurm's own log.
            logs = glob.glob(self.folder + "/results/slurm-*.log")
            self.assertEqual(len(logs), 4, slurm.logs())
            # A drive of the experiments, too.
            signals = self.folder + "/results/signals/arena__imu.kind=perfect__seed1.bag"
            result = run([signals, *profile, "--config", "groups=ideal"], self.folder, slurm.environment)
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertTrue(os.path.exists(signals))
            self.assertEqual(len(glob.glob(self.folder + "/results/slurm-*.log")), 5)


if __name__ == "__main__":
    BUILD_DIR = os.path.abspath(sys.argv.pop(1))
    program = unittest.main(exit=False, verbosity=2)
    if not program.result.wasSuccessful():
        sys.exit(1)
    sys.exit(77 if len(program.result.skipped) == program.result.testsRun else 0)
