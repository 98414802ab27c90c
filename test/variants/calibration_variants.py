"""Calibrations as people bring them: wrong units, fields with another meaning, models that are not supported."""
import numpy as np

from recording import INFOS, LEFT_INFO, RIGHT_INFO, IMAGES, rotation
from variant import Variant

REFUSED = r'baseline|focal|R is no rotation|not supported|coefficients|lies outside|sheared|side by side|rectif'


def both(change):
    def apply(recording):
        recording.change(INFOS, change)
    return apply


def right(change):
    def apply(recording):
        recording.change([RIGHT_INFO], change)
    return apply


def assign(**fields):
    """Sets fields, or single entries of a matrix: P3=... is P[3]."""
    def change(info):
        for name, value in fields.items():
            if len(name) > 1 and name[1:].isdigit():
                matrix = list(getattr(info, name[0]))
                matrix[int(name[1:])] = value
                setattr(info, name[0], matrix)
            else:
                setattr(info, name, value)
    return change


def scaled(factor):
    """The focal length and the principal point of another image size."""
    def change(info):
        info.K = [value * factor for value in info.K[:8]] + [1.0]
        info.P = [value * factor for value in info.P[:10]] + [1.0, 0.0]
    return change


def scale_baseline(factor):
    def change(info):
        info.P = [v * factor if i == 3 else v for i, v in enumerate(info.P)]
    return change


def swap(recording):
    left, right_info = recording.of(LEFT_INFO)[0], recording.of(RIGHT_INFO)[0]
    P_left, P_right = list(left.P), list(right_info.P)
    recording.change([LEFT_INFO], lambda info: setattr(info, 'P', P_right))
    recording.change([RIGHT_INFO], lambda info: setattr(info, 'P', P_left))


def swap_images(recording):
    recording.rename(IMAGES[0], 'held')
    recording.rename(IMAGES[1], IMAGES[0])
    recording.rename('held', IMAGES[1])


def zero_until(count):
    def apply(recording):
        for topic in INFOS:
            for info in recording.of(topic)[:count]:
                assign(K=[0.0] * 9, P=[0.0] * 12, R=[0.0] * 9, D=[], distortion_model='')(info)
    return apply


def infos_kept(keep):
    """Leaves the camera_infos whose number fulfils keep(number)."""
    def apply(recording):
        kept = {id(m) for topic in INFOS for i, m in enumerate(recording.of(topic)) if keep(i)}
        recording.drop(lambda topic, message, _: topic in INFOS and id(message) not in kept)
    return apply


def latched(recording):
    """One camera_info of each camera, in front of everything and with stamp 0."""
    infos_kept(lambda i: i == 0)(recording)
    for item in recording.items:
        if item[0] in INFOS:
            item[1].header.stamp.secs = 0
    recording.items.sort(key=lambda item: item[0] not in INFOS)


def crop(x, y, width, height, roi):
    """Cropped images; the calibration stays that of the full sensor with roi, or is moved without."""
    def apply(recording):
        recording.map_images(lambda pixels: ('mono8', pixels[y:y + height, x:x + width]))

        def change(info):
            if roi:
                info.roi.x_offset, info.roi.y_offset = x, y
                info.roi.width, info.roi.height = width, height
                return
            info.width, info.height = width, height
            assign(K2=info.K[2] - x, K5=info.K[5] - y, P2=info.P[2] - x, P6=info.P[6] - y)(info)
        recording.change(INFOS, change)
    return apply


def binned(by_fields):
    """Images of half the size; the calibration is that of the full sensor with binning, or unchanged."""
    def apply(recording):
        recording.map_images(lambda p: ('mono8', p.reshape(p.shape[0] // 2, 2, -1, 2).mean((1, 3)).astype(np.uint8)))
        if by_fields:
            recording.change(INFOS, assign(binning_x=2, binning_y=2))
    return apply


def roi_again(recording):
    crop(40, 20, 240, 200, False)(recording)

    def change(info):
        info.roi.x_offset, info.roi.y_offset, info.roi.width, info.roi.height = 40, 20, 240, 200
    recording.change(INFOS, change)


def calibration_variants():
    blank = assign(distortion_model='', D=[])
    none = assign(distortion_model='none', D=[])
    return [
        Variant('baseline in mm', right(scale_baseline(1000.0)), names='baseline'),
        Variant('baseline in cm', right(scale_baseline(100.0)), names='baseline'),
        Variant('baseline in inches', right(scale_baseline(39.37)), names='baseline'),
        Variant('baseline in metres without the focal length', right(scale_baseline(1 / 300.0)), names='baseline'),
        Variant('baseline of the wrong sign', right(scale_baseline(-1.0)), names='swapped|right of'),
        Variant('baseline zero', right(assign(P3=0.0)), names='baseline|P\\[3\\]'),
        Variant('baseline vertical', right(assign(P3=0.0, P7=-36.0)), names='side by side|vertical'),
        Variant('calibrations exchanged', swap, names='swapped|exchanged'),
        Variant('image topics exchanged', swap_images, names='swapped|exchanged'),
        Variant('D zero with R, toed in', base='toe_in', right=True),
        Variant('D zero with R, right camera rolled', base='rolled', right=True),
        Variant('raw images, plumb_bob', base='raw', right=True),
        Variant('raw images, plumb_bob with 4 coefficients', base='raw', right=True,
                change=both(lambda info: setattr(info, 'D', info.D[:4]))),
        Variant('raw images, rational_polynomial', base='raw', right=True, change=both(
            lambda info: assign(distortion_model='rational_polynomial', D=list(info.D) + [0.0] * 3)(info))),
        Variant('plumb_bob with 8 coefficients', both(assign(D=[0.01] * 8)), names=REFUSED),
        Variant('plumb_bob with 3 coefficients', both(assign(D=[0.01] * 3)), names=REFUSED),
        Variant('rational_polynomial with 5 coefficients', names=REFUSED,
                change=both(assign(distortion_model='rational_polynomial', D=[0.01] * 5))),
        Variant('equidistant with 5 coefficients', names=REFUSED,
                change=both(assign(distortion_model='equidistant', D=[0.01] * 5))),
        Variant('model mei', both(assign(distortion_model='mei', D=[0.1] * 4)), names=REFUSED),
        Variant('model fov', both(assign(distortion_model='fov', D=[0.9])), names=REFUSED),
        Variant('model thin_prism', right(assign(distortion_model='thin_prism', D=[0.0] * 8)), names=REFUSED),
        Variant('blank model, rectified', both(blank), right=True),
        Variant('model none, rectified', both(none), right=True),
        Variant('blank model, not rectified', both(blank), base='raw', names='rectif|model'),
        Variant('blank model of one camera, not rectified', right(blank), base='raw', names='rectif|model'),
        Variant('R of zeros', both(assign(R=[0.0] * 9)), names='rotation|R is'),
        Variant('R mirrored', right(assign(R0=-1.0)), names='rotation'),
        Variant('R scaled', right(assign(R0=1.05, R4=1.05, R8=1.05)), names='rotation'),
        Variant('R transposed', base='raw', names='rotation|epipolar|rectif|rows|lost',
                change=right(lambda i: setattr(i, 'R', list(np.reshape(i.R, (3, 3)).T.ravel())))),
        Variant('R rolled by 90 degrees', right(assign(R=rotation('z', 90))), names='R|lost'),
        Variant('P sheared', both(assign(P1=12.0)), names='shear'),
        Variant('P with a last row of zeros', both(assign(P10=0.0)), names='row|P'),
        Variant('P with NaN', right(assign(P0=float('nan'))), names='NaN'),
        Variant('K of zeros', both(assign(K=[0.0] * 9)), names='K|calibrated|focal'),
        Variant('D infinite', right(assign(D=[float('inf')] * 5)), names='NaN|infinity'),
        Variant('P in normalised units', both(scaled(1 / 320.0)), names='focal|px'),
        Variant('calibration of twice the image size', both(scaled(2.0)), names='focal|image size|outside'),
        Variant('calibration of four times the image size', both(scaled(4.0)), names='focal|image size|outside'),
        Variant('calibration of half the image size', both(scaled(0.5)), names='focal|image size|outside|principal'),
        Variant('width and height of another image', both(assign(width=640, height=480)), names='size|640'),
        Variant('width and height zero', both(assign(width=0, height=0)), names='size|width|0'),
        Variant('width and height exchanged', both(assign(width=240, height=320)), names='size|240'),
        Variant('principal point outside', both(assign(K2=400.0, P2=400.0)), names='outside'),
        Variant('principal point negative', both(assign(K5=-20.0, P6=-20.0)), names='outside'),
        Variant('focal lengths of P differ', right(assign(P0=330.0)), names='focal|P'),
        Variant('roi of full-size calibration', crop(40, 20, 240, 200, True), right=True),
        Variant('cropped, calibration moved', crop(40, 20, 240, 200, False), right=True),
        Variant('cropped, roi given on top', roi_again, names='roi|crop|lie'),
        Variant('cropped far from the middle', crop(120, 0, 200, 240, False), names='outside|principal'),
        Variant('binning 2', binned(True), right=True),
        Variant('images halved, calibration not', binned(False), names='size|160'),
        Variant('binning 3 of an image that is not', both(assign(binning_x=3, binning_y=3)), names='binning|size'),
        Variant('first five infos zero', zero_until(5), right=True),
        Variant('first forty infos zero', zero_until(40), right=True),
        Variant('all infos zero', zero_until(1000), names='calibrated'),
        Variant('infos begin late', infos_kept(lambda i: i >= 20), right=True),
        Variant('infos at a seventh of the rate', infos_kept(lambda i: i % 7 == 0), right=True),
        Variant('infos latched', latched, right=True),
        Variant('no info at all', infos_kept(lambda _: False), names='camera_info'),
        Variant('no info of the right camera', names='camera_info',
                change=lambda r: r.drop(lambda topic, *_: topic == RIGHT_INFO)),
    ]
