#!/usr/bin/env python3
"""make_layouts.py BAG FOLDER: the pairs of a rectified recording as EuRoC and KITTI lay out theirs, in the folders that the
documents name. Left and right images have the same stamps."""
import struct
import sys
import zlib
from pathlib import Path

import rosbag


def png(image):
    """A mono8 message as PNG."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = b''.join(b'\0' + image.data[y * image.step:y * image.step + image.width] for y in range(image.height))
    header = struct.pack('>IIBBBBB', image.width, image.height, 8, 0, 0, 0, 0)
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(rows, 1)) + chunk(b'IEND', b'')


def write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def read(bag_path):
    images, infos = {'left': [], 'right': []}, {}
    with rosbag.Bag(bag_path) as bag:
        for topic, message, _ in bag.read_messages():
            side = 'left' if 'camera/left' in topic else 'right'
            if topic.endswith('image_raw'):
                images[side].append(message)
            elif topic.endswith('camera_info'):
                infos[side] = message
    return images, infos


def write_euroc(folder, images, infos):
    for camera, side in (('cam0', 'left'), ('cam1', 'right')):
        info = infos[side]
        x_m = -info.P[3] / info.P[0]
        write(folder / camera / 'sensor.yaml',
              f'T_BS:\n  data: [1, 0, 0, {x_m}, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n'
              f'resolution: [{info.width}, {info.height}]\ncamera_model: pinhole\n'
              f'intrinsics: [{info.P[0]}, {info.P[5]}, {info.P[2]}, {info.P[6]}]\n'
              'distortion_model: radial-tangential\ndistortion_coefficients: [0, 0, 0, 0]\n')
        stamps = [image.header.stamp.to_nsec() for image in images[side]]
        write(folder / camera / 'data.csv',
              '#timestamp [ns],filename\n' + ''.join(f'{stamp},{stamp}.png\n' for stamp in stamps))
        for stamp, image in zip(stamps, images[side]):
            write(folder / camera / 'data' / f'{stamp}.png', png(image))


def write_kitti(folder, images, infos):
    start = images['left'][0].header.stamp
    write(folder / 'times.txt', ''.join(f'{(image.header.stamp - start).to_sec()}\n' for image in images['left']))
    write(folder / 'calib.txt', ''.join(
        f'P{i}: ' + ' '.join(map(str, infos[side].P)) + '\n' for i, side in enumerate(('left', 'right'))))
    for i, side in enumerate(('left', 'right')):
        for n, image in enumerate(images[side]):
            write(folder / f'image_{i}' / f'{n:06d}.png', png(image))


def main(bag_path, folder):
    images, infos = read(bag_path)
    write_euroc(Path(folder) / 'MH_01_easy' / 'mav0', images, infos)
    write_kitti(Path(folder) / 'sequences' / '06', images, infos)


if __name__ == '__main__':
    main(*sys.argv[1:])
