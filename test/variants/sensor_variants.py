"""IMUs that contradict the images, transforms that are elsewhere or missing, several rigs."""
import genpy
import numpy as np

from recording import IMAGES, IMU, INFOS, LEFT_INFO, TF_STATIC, TRUTH, shift
from variant import Variant

AXES = 'xyz'


def rates(function):
    """angular velocity = function(x, y, z), orientation unchanged and said to be unknown."""
    def change(imu):
        vector = imu.angular_velocity
        vector.x, vector.y, vector.z = function(vector.x, vector.y, vector.z)
        imu.orientation_covariance = [-1.0] + [0.0] * 8
    return lambda recording: recording.change([IMU], change)


def axes(permutation, signs):
    """An IMU whose axes lie otherwise than tf says: rates, acceleration and attitude in its own axes."""
    turn = np.zeros((3, 3))
    for row, (column, sign) in enumerate(zip(permutation, signs)):
        turn[row, column] = sign

    def change(imu):
        for vector in (imu.angular_velocity, imu.linear_acceleration):
            vector.x, vector.y, vector.z = turn @ [vector.x, vector.y, vector.z]
        q = imu.orientation
        q.x, q.y, q.z = turn @ [q.x, q.y, q.z]
    return lambda recording: recording.change([IMU], change)


def dead_orientation(recording):
    def change(imu):
        q = imu.orientation
        q.x, q.y, q.z, q.w = 0.0, 0.0, 0.0, 1.0
        imu.angular_velocity_covariance = [-1.0] + [0.0] * 8
    recording.change([IMU], change)


def zero_quaternion(recording):
    recording.change([IMU], lambda imu: setattr(imu.orientation, 'w', 0.0) or [
        setattr(imu.orientation, axis, 0.0) for axis in AXES])


def rates_absent(recording):
    """Rates are zero and marked absent."""
    def change(imu):
        imu.angular_velocity.x = imu.angular_velocity.y = imu.angular_velocity.z = 0.0
        imu.angular_velocity_covariance = [-1.0] + [0.0] * 8
    recording.change([IMU], change)


def both_absent(recording):
    rates_absent(recording)
    recording.change([IMU], lambda imu: setattr(imu, 'orientation_covariance', [-1.0] + [0.0] * 8))


def frame(name):
    return lambda recording: recording.change([IMU], lambda imu: setattr(imu.header, 'frame_id', name))


def stamps(function):
    return lambda recording: recording.change([IMU], function)


def zero_stamp(imu):
    imu.header.stamp = genpy.Time()


def from_mid_drive(function):
    """The IMU goes wrong in the middle of the recording."""
    def apply(recording):
        messages = recording.of(IMU)
        for imu in messages[len(messages) // 2:]:
            function(imu)
    return apply


def negated(imu):
    imu.angular_velocity.z = -imu.angular_velocity.z
    imu.orientation_covariance = [-1.0] + [0.0] * 8


def stuck(imu):
    imu.angular_velocity.z = 0.0
    imu.orientation.x = imu.orientation.y = imu.orientation.z = 0.0
    imu.orientation.w = 1.0


def not_a_number(imu):
    imu.angular_velocity.z = float('nan')
    imu.orientation.z = float('nan')


def imu_variants():
    degrees = np.degrees(1.0)
    said = r'IMU|imu'
    return [
        Variant('rates in deg/s', rates(lambda x, y, z: (x * degrees, y * degrees, z * degrees)), names=said),
        Variant('rates negated', rates(lambda x, y, z: (-x, -y, -z)), names=said),
        Variant('rate of z negated', rates(lambda x, y, z: (x, y, -z)), names=said),
        Variant('rates twice too large', rates(lambda x, y, z: (2 * x, 2 * y, 2 * z)), names=said),
        Variant('axes permuted', axes((1, 2, 0), (1, 1, 1)), names=said),
        Variant('IMU upside down, tf level', axes((0, 1, 2), (1, -1, -1)), names=said),
        Variant('IMU in optical axes, tf level', axes((1, 2, 0), (-1, -1, 1)), names=said),
        Variant('orientation dead', dead_orientation, names=said),
        Variant('quaternion of zeros', zero_quaternion, names=said),
        Variant('IMU without a frame', frame(''), names=said),
        Variant('IMU in an unknown frame', frame('imu_mount'), names=said),
        Variant('IMU stamps zero', stamps(zero_stamp), names=said),
        Variant('IMU an hour off', stamps(lambda imu: shift(imu, -3600.0)), names=said),
        Variant('IMU 50 ms late', stamps(lambda imu: shift(imu, 0.05)), names=said),
        Variant('IMU 200 ms late', stamps(lambda imu: shift(imu, 0.2)), names=said),
        Variant('IMU 200 ms early', stamps(lambda imu: shift(imu, -0.2)), names=said),
        Variant('rates marked absent', rates_absent, names=said),
        Variant('rates and orientation marked absent', both_absent, names=said),
        Variant('rates negated from mid-drive', from_mid_drive(negated), names=said),
        Variant('IMU stuck from mid-drive', from_mid_drive(stuck), names=said),
        Variant('IMU not a number from mid-drive', from_mid_drive(not_a_number), names=said),
        Variant('IMU ends in mid-drive', names=said,
                change=lambda r: r.drop(lambda t, m, s: t == IMU and m.header.stamp.to_sec() > 1e9 + 2.5)),
        Variant('IMU at 5 Hz', names=said,
                change=lambda r: r.drop(lambda t, m, s: t == IMU and round(m.header.stamp.to_sec() * 100) % 20 != 0)),
        Variant('no IMU', change=lambda r: r.drop(lambda t, *_: t == IMU), right=True),
    ]


def only_on_tf(recording):
    """The transforms are published again and again on /tf."""
    message = recording.of(TF_STATIC)[0]
    recording.rename(TF_STATIC, 'tf')
    for item in [item for item in recording.items if item[0] == LEFT_INFO]:
        recording.items.append(['tf', message, item[2]])
    recording.items.sort(key=lambda item: item[2])


def transforms(function):
    return lambda recording: recording.change([TF_STATIC], lambda m: [function(t) for t in m.transforms])


def other_root(transform):
    if transform.header.frame_id == 'base_link':
        transform.header.frame_id = 'base_footprint'


def without(child):
    def apply(recording):
        for message in recording.of(TF_STATIC):
            message.transforms = [t for t in message.transforms if t.child_frame_id != child]
    return apply


def zero_rotation(transform):
    rotation = transform.transform.rotation
    rotation.x = rotation.y = rotation.z = rotation.w = 0.0


def second_rig(complete):
    """The rig is /a; /b holds the same images, with or without camera_info."""
    def apply(recording):
        for item in list(recording.items):
            if item[0] in IMAGES + INFOS:
                if complete or item[0] in IMAGES:
                    recording.items.append(['/b/' + item[0], item[1], item[2]])
                item[0] = '/a/' + item[0]
        recording.items.sort(key=lambda item: item[2])
    return apply


def rig_variants():
    said = r'tf|base_link|transform|mounting'
    return [
        Variant('transforms only on /tf', only_on_tf, right=True),
        Variant('no transforms', change=lambda r: r.drop(lambda t, *_: t == TF_STATIC), names=said),
        Variant('transforms to another root', transforms(other_root), names=said),
        Variant('no transform of the cameras', without('camera_left_optical'), names=said),
        Variant('no transform of the IMU', without('imu_link'), names=r'imu_link|IMU'),
        Variant('transforms with a rotation of zeros', transforms(zero_rotation), names=said + '|rotation'),
        Variant('two complete rigs', second_rig(True), names='several stereo rigs'),
        Variant('two complete rigs, one chosen', second_rig(True), right=True, arguments=['--namespace', '/b']),
        Variant('two rigs, one without camera_info', second_rig(False), names='several stereo rigs|camera_info'),
        Variant('two rigs, the incomplete one chosen', second_rig(False), names='camera_info',
                arguments=['--namespace', '/b']),
        Variant('a rig that is not there', names='/c', arguments=['--namespace', '/c']),
        Variant('no ground truth', change=lambda r: r.drop(lambda t, *_: t == TRUTH), right=True),
    ]
