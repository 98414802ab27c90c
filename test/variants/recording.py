"""A clean recording in memory, which a variant changes and writes as a bag."""
import copy
import subprocess

import cv2
import numpy as np
import rosbag
import rospy

LEFT = 'camera/left/image_raw'
RIGHT = 'camera/right/image_raw'
LEFT_INFO = 'camera/left/camera_info'
RIGHT_INFO = 'camera/right/camera_info'
IMAGES = (LEFT, RIGHT)
INFOS = (LEFT_INFO, RIGHT_INFO)
IMU = 'imu/data'
TRUTH = 'ground_truth/odom'
TF_STATIC = 'tf_static'
KEPT = IMAGES + INFOS + (IMU, TRUTH, TF_STATIC)

WIDTH, HEIGHT = 320, 240
FOCAL_LENGTH, CX, CY, BASELINE = 300.0, 159.5, 119.5, 0.12

YAML = """image_width: {width}
image_height: {height}
camera_name: {name}
camera_matrix: {{rows: 3, cols: 3, data: {K}}}
distortion_model: {model}
distortion_coefficients: {{rows: 1, cols: {count}, data: {D}}}
rectification_matrix: {{rows: 3, cols: 3, data: {R}}}
projection_matrix: {{rows: 3, cols: 4, data: {P}}}
"""


def rotation(axis, angle_deg):
    """Row-major rotation matrix as a list."""
    vector = np.zeros(3)
    vector['xyz'.index(axis)] = np.radians(angle_deg)
    return [float(value) for value in cv2.Rodrigues(vector)[0].ravel()]


def ros_yaml(name, x_m=0.0, model='plumb_bob', D=(0, 0, 0, 0, 0), R=None, size=(WIDTH, HEIGHT)):
    """Calibration of one camera of the simulated pair as camera_calibration saves it."""
    K = [FOCAL_LENGTH, 0, CX, 0, FOCAL_LENGTH, CY, 0, 0, 1]
    P = K[:3] + [-FOCAL_LENGTH * x_m] + K[3:6] + [0] + K[6:] + [0]
    return YAML.format(name=name, width=size[0], height=size[1], K=K, model=model, count=len(D), D=list(D),
                       R=list(R or rotation('x', 0)), P=P)


def write_calibration(folder, **right):
    """left.yaml and right.yaml of a rectified pair; arguments change the right camera."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / 'left.yaml').write_text(ros_yaml('left'))
    (folder / 'right.yaml').write_text(ros_yaml('right', x_m=BASELINE, **right))
    return folder


def simulate(programs, drive, bag, calibration=None):
    """Drives through the scenario `drive` with a calibration (default: the thesis' rig, with distortion)."""
    command = [str(programs / 'simulate'), str(drive), '--output', str(bag), '--seed', '3']
    if calibration:
        command += ['--calibration', str(calibration)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


class Recording:
    """Messages as [topic, message, time of recording], in the order of recording."""

    def __init__(self, path):
        with rosbag.Bag(str(path)) as bag:
            self.items = [list(item) for item in bag.read_messages(topics=KEPT)]

    def copy(self):
        return copy.deepcopy(self)

    def of(self, *topics):
        return [item[1] for item in self.items if item[0] in topics]

    def change(self, topics, function):
        """Calls function(message) for each message of the topics."""
        for message in self.of(*topics):
            function(message)

    def drop(self, condition):
        """Leaves out the items (topic, message, time) for which the condition holds."""
        self.items = [item for item in self.items if not condition(*item)]

    def rename(self, old, new):
        for item in self.items:
            if item[0] == old:
                item[0] = new

    def map_images(self, function, topics=IMAGES):
        """Replaces each image by (encoding, pixels) = function(pixels)."""
        for message in self.of(*topics):
            encoding, pixels = function(pixels_of(message))
            put_pixels(message, encoding, pixels)

    def write(self, path):
        with rosbag.Bag(str(path), 'w') as bag:
            for topic, message, time in self.items:
                bag.write(topic, message, time)
        return path


def pixels_of(message):
    return np.frombuffer(message.data, np.uint8).reshape(message.height, message.width)


def put_pixels(message, encoding, pixels):
    message.height, message.width = pixels.shape[:2]
    message.encoding = encoding
    message.step = pixels.strides[0] if pixels.flags.c_contiguous else pixels[0].nbytes
    message.data = np.ascontiguousarray(pixels).tobytes()


def index_of(recording, topic):
    """Message -> its place among the messages of a topic, by identity."""
    return {id(message): i for i, message in enumerate(recording.of(topic))}


def shift(message, seconds):
    message.header.stamp += rospy.Duration.from_sec(seconds)
