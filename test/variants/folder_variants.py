"""Recordings that are folders of images, in the layouts of import_sequence."""
import cv2
import numpy as np

from recording import BASELINE, CX, CY, FOCAL_LENGTH, HEIGHT, IMU, LEFT, RIGHT, WIDTH, pixels_of, ros_yaml, rotation
from variant import Variant

CALIB_TXT = f'fx {FOCAL_LENGTH}\nfy {FOCAL_LENGTH}\ncx {CX}\ncy {CY}\nbaseline {BASELINE}\n'
TOE_IN_DEG = 1.0
MATRIX = '{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: {}\n'


def unpadded(i):
    return f'{i}.png'


def padded(i):
    return f'{i:06d}.png'


def write_images(folders, recording, name=padded, keep=lambda side, i: True, convert=lambda pixels: pixels):
    """Images of both cameras; name(i) names number i, keep(side, i) says whether it is there."""
    for side, (topic, folder) in enumerate(zip((LEFT, RIGHT), folders)):
        folder.mkdir(parents=True, exist_ok=True)
        for i, image in enumerate(recording.of(topic)):
            if keep(side, i):
                cv2.imwrite(str(folder / name(i)), convert(pixels_of(image)), [cv2.IMWRITE_PNG_COMPRESSION, 1])


def images(calibration=None, files=None, **arguments):
    """left/ and right/ with calib.txt, or with other calibration files (name -> text)."""
    def make(folder, recording):
        write_images((folder / 'left', folder / 'right'), recording, **arguments)
        for name, text in {**(calibration or {'calib.txt': CALIB_TXT}), **(files or {})}.items():
            (folder / name).write_text(text)
        return ['--format', 'images'], folder
    return make


def swapped_folders(folder, recording):
    arguments = images()(folder, recording)
    (folder / 'left').rename(folder / 'held')
    (folder / 'right').rename(folder / 'left')
    (folder / 'held').rename(folder / 'right')
    return arguments


def kitti(cameras=('image_0', 'image_1'), P1=None, stamps=lambda i: i * 0.1, **arguments):
    def make(folder, recording):
        write_images([folder / camera for camera in cameras], recording, **arguments)
        row = f'{FOCAL_LENGTH} 0 {CX} {{}} 0 {FOCAL_LENGTH} {CY} 0 0 0 1 0'
        (folder / 'calib.txt').write_text(
            f'P0: {row.format(0)}\nP1: {P1 or row.format(-FOCAL_LENGTH * BASELINE)}\n')
        count = len(recording.of(LEFT))
        (folder / 'times.txt').write_text(''.join(f'{stamps(i):e}\n' for i in range(count)))
        return ['--format', 'kitti'], folder
    return make


def sensor_yaml(x_m, model='radial-tangential', baseline_scale=1.0):
    T = f'[0, 0, 1, 0.1, -1, 0, 0, {0.0613 - x_m * baseline_scale}, 0, -1, 0, 0.283, 0, 0, 0, 1]'
    return (f'T_BS:\n  rows: 4\n  cols: 4\n  data: {T}\nresolution: [{WIDTH}, {HEIGHT}]\ncamera_model: pinhole\n'
            f'intrinsics: [{FOCAL_LENGTH}, {FOCAL_LENGTH}, {CX}, {CY}]\ndistortion_model: {model}\n'
            'distortion_coefficients: [0, 0, 0, 0]\n')


def euroc(imu='full', arguments=(), **camera):
    """imu: 'full', 'empty' (a data.csv with no line but its heading) or 'none'."""
    def make(folder, recording):
        def stamp(i):
            return recording.of(LEFT)[i].header.stamp.to_nsec()
        write_images([folder / name / 'data' for name in ('cam0', 'cam1')], recording, lambda i: f'{stamp(i)}.png')
        listing = ''.join(f'{stamp(i)},{stamp(i)}.png\n' for i in range(len(recording.of(LEFT))))
        for name, x_m in (('cam0', 0.0), ('cam1', BASELINE)):
            (folder / name / 'data.csv').write_text('#timestamp [ns],filename\n' + listing)
            (folder / name / 'sensor.yaml').write_text(sensor_yaml(x_m, **camera))
        if imu == 'none':
            return ['--format', 'euroc', *arguments], folder
        (folder / 'imu0').mkdir()
        (folder / 'imu0' / 'sensor.yaml').write_text(
            'T_BS:\n  rows: 4\n  cols: 4\n  data: [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]\nrate_hz: 100\n'
            'gyroscope_noise_density: 0.001\naccelerometer_noise_density: 0.01\n')
        rows = ''
        for m in recording.of(IMU) if imu == 'full' else []:
            w, a = m.angular_velocity, m.linear_acceleration
            rows += f'{m.header.stamp.to_nsec()},{w.x},{w.y},{w.z},{a.x},{a.y},{a.z}\n'
        (folder / 'imu0' / 'data.csv').write_text('#timestamp,w_x,w_y,w_z,a_x,a_y,a_z\n' + rows)
        return ['--format', 'euroc', *arguments], folder
    return make


def ros_pair(**right):
    return {'left.yaml': ros_yaml('left'), 'right.yaml': ros_yaml('right', x_m=BASELINE, **right)}


def relative_pose():
    """R and t of the toed-in pair, from left to right camera coordinates."""
    R = np.reshape(rotation('y', -TOE_IN_DEG), (3, 3)).T
    return R, R @ [-BASELINE, 0, 0]


def kalibr(model='radtan', scale=1.0, coefficients=4):
    R, t = relative_pose()
    camera = (f'  camera_model: pinhole\n  distortion_model: {model}\n  distortion_coeffs: {[0.0] * coefficients}\n'
              f'  intrinsics: [{FOCAL_LENGTH}, {FOCAL_LENGTH}, {CX}, {CY}]\n  resolution: [{WIDTH}, {HEIGHT}]\n')
    rows = ''.join(f'  - {[float(v) for v in R[i]] + [float(t[i] * scale)]}\n' for i in range(3))
    return {'camchain.yaml': f'cam0:\n{camera}cam1:\n{camera}  T_cn_cnm1:\n{rows}  - [0.0, 0.0, 0.0, 1.0]\n'}


def opencv(scale=1.0, coefficients=5):
    def matrix(name, values, cols):
        values = [float(value) for value in np.ravel(values)]
        return MATRIX.format(name, len(values) // cols, cols, values)
    R, t = relative_pose()
    M = [FOCAL_LENGTH, 0, CX, 0, FOCAL_LENGTH, CY, 0, 0, 1]
    D = [0.0] * coefficients
    return {'intrinsics.yml': '%YAML:1.0\n---\n' + matrix('M1', M, 3) + matrix('D1', D, coefficients) +
                              matrix('M2', M, 3) + matrix('D2', D, coefficients),
            'extrinsics.yml': '%YAML:1.0\n---\n' + matrix('R', R, 3) + matrix('T', t * scale, 1)}


def sixteen(shift):
    return lambda pixels: pixels.astype(np.uint16) << shift


def layout_variants():
    def dates(i):
        return f'{1500000000000000000 + i * 100000000}.png'
    gaps = images(keep=lambda side, i: (side, i) not in ((0, 18), (1, 6), (1, 40)))
    return [
        Variant('images, numbers without zeros', make=images(name=unpadded), right=True),
        Variant('images, numbers that begin at 95', make=images(name=lambda i: f'img{95 + i}.png'), right=True),
        Variant('images, numbers in steps of 5', make=images(name=lambda i: f'{5 * i}.png'), right=True),
        Variant('images with gaps', make=gaps, right=True),
        Variant('images, names are dates', make=images(name=dates), right=True, stamps='end'),
        Variant('images, jpeg', make=images(name=lambda i: f'{i}.jpg'), right=True),
        Variant('images, 12 bits', make=images(convert=sixteen(4)), right=True),
        Variant('images, 16 bits with exchanged bytes', right=True,
                make=images(convert=lambda p: (p.astype(np.uint16) << 4).byteswap())),
        Variant('images, folders exchanged', make=swapped_folders, names='swapped|exchanged'),
        Variant('images, baseline in mm', names='baseline',
                make=images({'calib.txt': CALIB_TXT.replace(str(BASELINE), str(BASELINE * 1000))})),
        Variant('images, times.txt too short', make=images(files={'times.txt': '0.0\n0.1\n'}), names='stamps'),
        Variant('images, times.txt runs backwards', names='stamp|times.txt|increas',
                make=images(files={'times.txt': ''.join(f'{10 - i * 0.1}\n' for i in range(100))})),
        Variant('images, no calibration', make=images({'notes.txt': 'nothing'}), names='calib.txt'),
        Variant('kitti, numbers without zeros', make=kitti(name=unpadded), right=True),
        Variant('kitti, colour cameras', make=kitti(('image_2', 'image_3')), names='colour'),
        Variant('kitti, image missing', make=kitti(keep=lambda s, i: s == 0 or i != 9), names='partner|complete'),
        Variant('kitti, P1 without baseline', names='P1|baseline',
                make=kitti(P1=f'{FOCAL_LENGTH} 0 {CX} 0 0 {FOCAL_LENGTH} {CY} 0 0 0 1 0')),
        Variant('kitti, stamps all equal', make=kitti(stamps=lambda i: 1.0), names='stamp|times.txt'),
        Variant('euroc', make=euroc(), right=True),
        Variant('euroc, empty imu0', make=euroc('empty'), names='--no-imu'),
        Variant('euroc, empty imu0 left out', make=euroc('empty', ['--no-imu']), right=True),
        Variant('euroc, baseline in mm', make=euroc(baseline_scale=1000.0), names='baseline'),
        Variant('euroc, model equidistant', make=euroc(model='equidistant'), names='equidistant|model'),
    ]


def dialect_variants():
    def toed_in(name, calibration, **judgement):
        return Variant(name, base='toe_in', make=images(calibration), **judgement)
    R = rotation('y', -TOE_IN_DEG)
    fisheye = {name: text.replace('camera_matrix', 'camera_model: fisheye\ncamera_matrix')
               for name, text in ros_pair().items()}
    return [
        toed_in('ROS calibration, coefficients 0 with R', ros_pair(R=R), right=True),
        toed_in('ROS calibration, equidistant with 5 coefficients', ros_pair(R=R, model='equidistant'),
                names='coefficients'),
        toed_in('ROS calibration, camera_model fisheye', fisheye, names='fisheye'),
        toed_in('ROS calibration of one camera', {'left.yaml': ros_yaml('left')}, names='right.yaml'),
        toed_in('ROS calibration of another size', ros_pair(R=R, size=(640, 480)), names='size|640'),
        toed_in('Kalibr calibration', kalibr(), right=True),
        toed_in('Kalibr calibration, translation in mm', kalibr(scale=1000.0), names='baseline'),
        toed_in('Kalibr calibration, cameras exchanged', kalibr(scale=-1.0), names='swapped'),
        toed_in('Kalibr calibration, model fov', kalibr(model='fov', coefficients=1), names='fov'),
        toed_in('Kalibr calibration, 5 coefficients', kalibr(coefficients=5), names='distortion_coeffs'),
        toed_in('OpenCV calibration', opencv(), right=True),
        toed_in('OpenCV calibration, board in mm', opencv(scale=1000.0), names='baseline'),
        toed_in('OpenCV calibration, 6 coefficients', opencv(coefficients=6), names='coefficients'),
        toed_in('two calibrations', {**kalibr(), **opencv()}, names='leave one'),
        toed_in('yaml that is none', {'camchain.yaml': 'cam0: [1, 2\n'}, names='camchain.yaml'),
    ]
