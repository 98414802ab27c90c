"""Images of other encodings, and stamps that are lost, doubled or set back."""
import cv2
import genpy
import numpy as np
from sensor_msgs.msg import CompressedImage

from recording import IMAGES, IMU, INFOS, LEFT, LEFT_INFO, RIGHT, RIGHT_INFO, pixels_of, shift
from variant import Variant


def sixteen_bits(bits, big_endian=False):
    """mono16 whose values fill `bits` bits."""
    def apply(recording):
        order = '>u2' if big_endian else '<u2'
        scale = (2**bits - 1) / 255.0
        recording.map_images(lambda pixels: ('mono16', np.round(pixels * scale).astype(order)))
        if big_endian:
            recording.change(IMAGES, lambda image: setattr(image, 'is_bigendian', 1))
    return apply


def bytes_exchanged(recording):
    """Twelve bits, written with exchanged bytes and not said so."""
    recording.map_images(lambda pixels: ('mono16', (pixels.astype('u2') * 16).astype('>u2')))


def converted(encoding, code):
    def apply(recording):
        recording.map_images(lambda pixels: (encoding, cv2.cvtColor(pixels, code)))
    return apply


def labelled(encoding):
    """The same bytes under another name: a grey mosaic for Bayer."""
    def apply(recording):
        recording.change(IMAGES, lambda image: setattr(image, 'encoding', encoding))
    return apply


def padded(recording):
    """Rows that end with unused bytes."""
    def change(image):
        pixels = np.pad(pixels_of(image), ((0, 0), (0, 16)), constant_values=200)
        image.step, image.data = pixels.shape[1], pixels.tobytes()
    recording.change(IMAGES, change)


def compressed(extension, colour=False, suffix='/compressed'):
    def apply(recording):
        for item in recording.items:
            if item[0] not in IMAGES:
                continue
            pixels = pixels_of(item[1])
            if colour:
                pixels = cv2.cvtColor(pixels, cv2.COLOR_GRAY2BGR)
            image = CompressedImage(header=item[1].header)
            kind = 'jpeg' if extension == '.jpg' else 'png'
            image.format = f"{'bgr8' if colour else 'mono8'}; {kind} compressed {'bgr8' if colour else 'mono8'}"
            image.data = cv2.imencode(extension, pixels, [cv2.IMWRITE_JPEG_QUALITY, 95])[1].tobytes()
            item[0], item[1] = item[0] + suffix, image
    return apply


def short_data(recording):
    recording.change([RIGHT], lambda image: setattr(image, 'data', image.data[:len(image.data) // 2]))


def other_size_right(recording):
    recording.map_images(lambda p: ('mono8', cv2.resize(p, (160, 120))), topics=[RIGHT])


def image_variants():
    grey_to = {'bgr8': cv2.COLOR_GRAY2BGR, 'rgb8': cv2.COLOR_GRAY2RGB, 'bgra8': cv2.COLOR_GRAY2BGRA}
    formats = [Variant(f'mono16 of {bits} bits', sixteen_bits(bits), right=True) for bits in (8, 10, 12, 14, 16)]
    formats += [Variant(f'mono16 of {bits} bits, big endian', sixteen_bits(bits, True), right=True)
                for bits in (10, 16)]
    formats += [Variant(f'{name} images', converted(name, code), right=True) for name, code in grey_to.items()]
    formats += [Variant(f'{name} images', labelled(name), right=True)
                for name in ('bayer_rggb8', 'bayer_grbg8')]
    return formats + [
        Variant('mono16 with exchanged bytes', bytes_exchanged, right=True),
        Variant('rows with unused bytes', padded, right=True),
        Variant('compressed jpeg', compressed('.jpg'), right=True),
        Variant('compressed jpeg, colour', compressed('.jpg', colour=True), right=True),
        Variant('compressed png', compressed('.png'), right=True),
        Variant('8UC1 images', labelled('8UC1'), names='8UC1'),
        Variant('unknown encoding', labelled('fancy8'), names='fancy8|encoding'),
        Variant('image data cut off', short_data, names='bytes|data|lost|step'),
        Variant('right images of another size', other_size_right, names='size|160'),
        Variant('images all black', names='lost|dark|black|features',
                change=lambda r: r.map_images(lambda p: ('mono8', p * 0))),
        Variant('right camera covered', names='lost|match|right',
                change=lambda r: r.map_images(lambda p: ('mono8', p * 0 + 3), topics=[RIGHT])),
        Variant('images upside down', names='lost|rectif|upside|IMU',
                change=lambda r: r.map_images(lambda p: ('mono8', p[::-1, ::-1].copy()))),
        Variant('right image upside down', names='lost|rectif|epipolar',
                change=lambda r: r.map_images(lambda p: ('mono8', p[::-1, ::-1].copy()), topics=[RIGHT])),
    ]


def camera_stamps(function):
    """stamp of each image and its camera_info = function(number, message)."""
    def apply(recording):
        for topic in IMAGES + INFOS:
            for number, message in enumerate(recording.of(topic)):
                function(number, message)
    return apply


def stamp_zero(_, message):
    message.header.stamp = genpy.Time()


def some_zero(number, message):
    if number % 10 == 5:
        message.header.stamp = genpy.Time()


def duplicated(recording):
    """Every tenth image is recorded twice."""
    items = []
    for item in recording.items:
        items.append(item)
        if item[0] in IMAGES and item[1].header.seq % 10 == 3:
            items.append(list(item))
    recording.items = items


def same_stamp_twice(recording):
    """Frame 30 carries the stamp of frame 29."""
    for topic in IMAGES + INFOS:
        messages = recording.of(topic)
        messages[30].header.stamp = messages[29].header.stamp


def out_of_order(recording):
    """Messages 20 and 21 of the left camera were recorded in exchanged order."""
    places = [i for i, item in enumerate(recording.items) if item[0] == LEFT]
    a, b = places[20], places[21]
    recording.items[a], recording.items[b] = recording.items[b], recording.items[a]


def set_back(seconds, at_s=3.3, topics=IMAGES + INFOS + (IMU, 'ground_truth/odom')):
    """The host's clock is set back: stamps and times of recording jump, the order stays."""
    def apply(recording):
        start = recording.items[0][2]
        for item in recording.items:
            if (item[2] - start).to_sec() < at_s or item[0] not in topics:
                continue
            shift(item[1], -seconds)
            item[2] -= genpy.Duration.from_sec(seconds)
    return apply


def right_shifted(seconds):
    def apply(recording):
        recording.change([RIGHT, RIGHT_INFO], lambda message: shift(message, seconds))
    return apply


def dropped(topic, condition):
    def apply(recording):
        numbers = {id(message): i for i, message in enumerate(recording.of(topic))}
        recording.drop(lambda t, message, _: t == topic and condition(numbers[id(message)]))
    return apply


def cut_off(share):
    def damage(path):
        data = path.read_bytes()
        path.write_bytes(data[:int(len(data) * share)])
    return damage


def overwritten(path):
    """A kilobyte of zeros in the middle, as a failing disk leaves it."""
    data = bytearray(path.read_bytes())
    data[len(data) // 2:len(data) // 2 + 1024] = bytes(1024)
    path.write_bytes(data)


def stamp_variants():
    back = r'set back|goes back|begun anew|backwards|stretch'
    return [
        Variant('stamps zero', camera_stamps(stamp_zero), names='stamp'),
        Variant('every tenth stamp zero', camera_stamps(some_zero), names='stamp|lost'),
        Variant('images recorded twice', duplicated, names='twice|duplicate|stamp'),
        Variant('one stamp twice', same_stamp_twice, names='twice|duplicate|stamp|lost'),
        Variant('messages out of order', out_of_order, right=True),
        Variant('clock set back by 0.5 s', set_back(0.5), right=True, stamps='end'),
        Variant('clock set back by 1 s', set_back(1.0), right=True, stamps='end'),
        Variant('clock set back by 60 s', set_back(60.0), names=back, stamps='end'),
        Variant('clock set forward by 60 s', set_back(-60.0), names='gap|lost|stamp|begun', stamps='end'),
        Variant('right stamps 5 ms late', right_shifted(0.005), names='stamp|offset|pair'),
        Variant('right stamps 20 ms late', right_shifted(0.02), names='stamp|offset|pair|apart'),
        Variant('right stamps 0.1 s late', right_shifted(0.1), names='stamp|offset|pair|apart|one frame'),
        Variant('right stamps an hour late', right_shifted(3600.0), names='stamp|pair|apart'),
        Variant('left images dropped', dropped(LEFT, lambda i: i % 9 == 4), right=True),
        Variant('right images dropped', dropped(RIGHT, lambda i: i % 9 == 4), right=True),
        Variant('images of both dropped in turn', names='lost|pair|partner',
                change=lambda r: (dropped(LEFT, lambda i: i % 2 == 0)(r), dropped(RIGHT, lambda i: i % 2 == 1)(r))),
        Variant('no right images', dropped(RIGHT, lambda _: True), names='right'),
        Variant('one second without images', names='lost|gap',
                change=lambda r: [dropped(topic, lambda i: 30 <= i < 40)(r) for topic in IMAGES]),
        Variant('cut off in mid-record', damage=cut_off(0.6), names='cut off|index|end'),
        Variant('cut off behind the first tenth', damage=cut_off(0.1), names='cut off|index|end'),
        Variant('cut off in the index', damage=cut_off(0.999), names='cut off|index|end'),
        Variant('empty file', damage=cut_off(0.0), names='empty|bag|index'),
        Variant('a kilobyte of zeros in the middle', damage=overwritten, names='damaged|read|bag|record|lost'),
    ]
