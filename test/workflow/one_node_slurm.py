"""A Slurm cluster of this one machine, with a configuration, keys and ports of its own; needs root."""
import os
import shutil
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo")

CONFIGURATION = """ClusterName=one_node
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def what_is_missing():
    """Why no cluster can be started here, in words; nothing where it can."""
    missing = [name for name in PROGRAMS if not shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin")]
    if missing:
        return "not installed: " + ", ".join(missing) + " (packages slurm-wlm and munge)"
    return "only root can start munged and slurmd" if os.geteuid() != 0 else None


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class OneNodeSlurm:
    """with OneNodeSlurm(folder) as slurm: commands with slurm.environment use the cluster."""

    def __init__(self, folder):
        self.folder = folder
        self.processes = []
        self.environment = dict(os.environ, SLURM_CONF=folder + "/slurm.conf", PATH=os.environ["PATH"] + ":/usr/sbin")

    def start(self, *command):
        with open("%s/%s.out" % (self.folder, command[0]), "w") as output:
            self.processes.append(subprocess.Popen(command, env=self.environment, stdout=output, stderr=subprocess.STDOUT))

    def logs(self):
        texts = []
        for name in sorted(os.listdir(self.folder)):
            if name.endswith((".log", ".out")):
                with open(os.path.join(self.folder, name)) as file:
                    texts.append("-- %s\n%s" % (name, file.read()))
        return "\n".join(texts)

    def wait_until(self, condition, what):
        for _ in range(600):
            if condition():
                return
            time.sleep(0.2)
        raise RuntimeError("%s: not within two minutes\n%s" % (what, self.logs()))

    def node_is_idle(self):
        answer = subprocess.run(["sinfo", "--noheader", "--format=%T"], env=self.environment, text=True, capture_output=True)
        return answer.stdout.strip() == "idle"

    def __enter__(self):
        try:
            os.chmod(self.folder, 0o755)
            for name in ("state", "spool"):
                os.makedirs(os.path.join(self.folder, name))
            key = self.folder + "/munge.key"
            with open(os.open(key, os.O_CREAT | os.O_WRONLY, 0o600), "wb") as file:
                file.write(os.urandom(1024))
            with open(self.folder + "/slurm.conf", "w") as file:
                file.write(CONFIGURATION.format(folder=self.folder, host=socket.gethostname().split(".")[0],
                                                controller_port=free_port(), node_port=free_port(), cpus=os.cpu_count()))
            with open(self.folder + "/cgroup.conf", "w") as file:
                file.write("CgroupAutomount=no\n")
            munge = self.folder + "/munge."
            self.start("munged", "--foreground", "--force", "--key-file=" + key, "--socket=" + munge + "socket",
                       "--pid-file=" + munge + "pid", "--log-file=" + munge + "log", "--seed-file=" + munge + "seed")
            self.wait_until(lambda: os.path.exists(munge + "socket"), "munged's socket")
            self.start("slurmctld", "-D", "-c")
            self.start("slurmd", "-D", "-c")
            self.wait_until(self.node_is_idle, "an idle node")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
        for process in reversed(self.processes):
            try:
                process.wait(timeout=60)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
