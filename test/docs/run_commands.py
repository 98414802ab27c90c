#!/usr/bin/env python3
"""Executes the commands of the documents as they are written: run_commands.py ROOT BUILD_DIR [DOCUMENT...].

test/docs/commands.yaml says which and how (there). Each runs in a folder that looks like the top folder of the package
with what the documents speak of: recordings, a rig file, a home. The commands of a document share a graph, whose master
is made again when the next launch file starts.
"""
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / 'scripts' / 'lib'))
import doc_commands  # noqa: E402

LONG_S = 120  # for a loaded machine


def prepare(root, build, work):
    """What the documents' commands find around them."""
    for name in ('bags', 'config', 'docs', 'launch', 'scripts', 'test'):
        (work / name).symlink_to(root / name)
    (work / 'build').symlink_to(build)
    (work / 'home').mkdir()
    shutil.copy(root / 'config' / 'rigs' / 'thesis.yaml', work / 'home' / 'my_rig.yaml')
    (work / 'drive.bag').symlink_to(build / 'fixture' / 'room.bag')
    tuning = (root / 'docs' / 'tuning.md').read_text()
    (work / 'my_vo.yaml').write_text(re.search(r'```yaml\n(.*?)```', tuning, re.DOTALL).group(1))


def free_port():
    with socket.socket() as probe:
        probe.bind(('localhost', 0))
        return probe.getsockname()[1]


class Runner:
    def __init__(self, work):
        self.work = work
        self.environment = {**os.environ, 'HOME': str(work / 'home'), 'ROS_HOSTNAME': 'localhost',
                            'ROS_HOME': str(work / 'ros_home'), 'PATH': '/usr/bin:' + os.environ['PATH']}
        for name in ('ROS_IP', 'ROS_NAMESPACE', 'DISPLAY'):
            self.environment.pop(name, None)
        self.graph, self.screen = [], None

    def start(self, command):
        """In a process group of its own."""
        log = tempfile.NamedTemporaryFile(mode='w+', dir=self.work, prefix='log_', suffix='.txt', delete=False)
        process = subprocess.Popen(['bash', '-c', f'source build/devel/setup.bash && {command}'], cwd=self.work,
                                   env=self.environment, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        process.log = log.name
        return process

    def finish(self, process, timeout_s):
        """Exit status; None when it had to be killed."""
        try:
            return process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return None

    def run(self, command, timeout_s=LONG_S):
        process = self.start(command)
        status = self.finish(process, timeout_s)
        return status, Path(process.log).read_text(errors='replace')

    def new_graph(self):
        self.end_graph()
        port = free_port()
        self.environment['ROS_MASTER_URI'] = f'http://localhost:{port}'
        self.graph = [self.start(f'exec roscore -p {port}')]
        if not self.wait_for('/rosout'):
            raise RuntimeError('no roscore: ' + Path(self.graph[0].log).read_text())

    def end_graph(self):
        for process in reversed(self.graph):
            for one in (signal.SIGINT, signal.SIGTERM):
                if process.poll() is None:
                    os.killpg(process.pid, one)
                    try:
                        process.wait(20)
                    except subprocess.TimeoutExpired:
                        pass
            self.finish(process, 1)
        self.graph = []

    def show_screen(self):
        """A virtual one, for programs with windows."""
        if self.screen is None:
            read_end, write_end = os.pipe()
            self.screen = subprocess.Popen(['Xvfb', '-displayfd', str(write_end), '-screen', '0', '1280x1024x24'],
                                           pass_fds=[write_end], stderr=subprocess.DEVNULL)
            os.close(write_end)
            with os.fdopen(read_end) as pipe:
                self.environment['DISPLAY'] = ':' + pipe.readline().strip()

    def wait_for(self, what, process=None):
        """Until a topic (/name) has a message, or a node's name holds `what`. False when it does not come."""
        end = time.monotonic() + LONG_S
        while time.monotonic() < end and (process is None or process.poll() is None):
            if what.startswith('/'):
                status, _ = self.run(f'rostopic echo -n 1 {what}' if what != '/rosout' else 'rosnode list', 20)
            else:
                status, _ = self.run(f'rosnode list | grep -q {what}', 20)
            if status == 0:
                return True
            time.sleep(0.5)
        return False

    @staticmethod
    def died_of_a_signal(process, program):
        """Whether rviz, say, has: by the status of the shell, or in the words of roslaunch."""
        said = Path(process.log).read_text(errors='replace')
        return (program in ('rviz', 'image_view', 'cameracalibrator') and
                ((process.poll() or 0) > 128 or
                 re.search(rf'has died \[pid \d+, exit code -\d+, cmd \S*/{program}\S* ', said) is not None))

    def execute(self, command, entry):
        """What went wrong, or nothing."""
        for old, new in entry.get('with', {}).items():
            command = command.replace(old, new)
        if entry.get('screen'):
            self.show_screen()
        if entry.get('needs') and len(self.graph) < 2:
            self.new_graph()
            self.graph.append(self.start('exec roslaunch stereo_nav robot.launch simulated:=true'))
            if not self.wait_for('/odom', self.graph[-1]):
                return 'no odometry beside it: ' + Path(self.graph[-1].log).read_text()
        if 'run' in entry:
            status, output = self.run(command)
            return None if status in (0, entry.get('status', 0)) else f'exit status {status}\n{output}'
        if not entry.get('beside'):
            self.new_graph()
        self.graph.append(self.start(re.sub(r'\s*&$', '', command)))
        good = self.wait_for(entry['until'], self.graph[-1])
        if not good and self.died_of_a_signal(self.graph[-1], entry['until']):
            print(f'{entry["until"]}, which is not ours, has died of a signal; it is started once more', flush=True)
            self.graph[-1] = self.start(re.sub(r'\s*&$', '', command))
            good = self.wait_for(entry['until'], self.graph[-1])
        return None if good else f'no {entry["until"]}\n' + Path(self.graph[-1].log).read_text(errors='replace')

    def close(self):
        self.end_graph()
        if self.screen is not None:
            self.screen.terminate()
            self.screen.wait()


def main(root, build, chosen):
    root, build = Path(root).resolve(), Path(build).resolve()
    entries, done, failures = doc_commands.table(root), set(), 0
    with tempfile.TemporaryDirectory(prefix='stereo_nav_docs_') as folder:
        work = Path(folder)
        prepare(root, build, work)
        runner = Runner(work)
        try:
            status, output = runner.run(f'python3 {root}/test/docs/make_layouts.py build/fixture/room.bag .')
            assert status == 0, output
            for document in doc_commands.documents(root):
                if chosen and document.name not in chosen:
                    continue
                for command in doc_commands.commands(document.read_text()):
                    entry = entries[command]
                    if command in done or not ({'run', 'until'} & set(entry)):
                        continue
                    if entry.get('data') and 'STEREO_NAV_DATA' not in os.environ:
                        continue
                    done.add(command)
                    start = time.monotonic()
                    problem = runner.execute(command, entry)
                    failures += problem is not None
                    print(f'{"ok" if problem is None else "NOT OK"} {time.monotonic() - start:5.1f} s '
                          f'{document.relative_to(root)}: {command}', flush=True)
                    if problem:
                        print(problem, flush=True)
                runner.end_graph()
        finally:
            runner.close()
    print(f'{len(done)} commands executed, {failures} failed')
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
