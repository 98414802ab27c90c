#!/usr/bin/env python3
"""camera_calibration's cameracalibrator.py with somebody at the mouse: CALIBRATE is pressed when its button is lit, then
COMMIT.

usage: press_buttons.py ARGUMENT...    those of cameracalibrator.py
"""
import runpy
import sys
import threading
import time

import cv2
from camera_calibration.camera_calibrator import OpenCVCalibrationNode

CALIBRATOR = "/usr/lib/camera_calibration/cameracalibrator.py"
# Rows of the buttons, which stand in a column right of the images.
CALIBRATE_ROW, COMMIT_ROW = 230, 430


def press_buttons(node):
    def wait_until(condition):
        while not condition():
            time.sleep(0.2)

    def click(row):
        node.on_mouse(cv2.EVENT_LBUTTONDOWN, node.displaywidth + 50, row, 0, None)

    wait_until(lambda: node.c is not None and node.c.goodenough)
    click(CALIBRATE_ROW)
    wait_until(lambda: node.c.calibrated)
    click(COMMIT_ROW)


def main():
    create = OpenCVCalibrationNode.__init__

    def create_and_press(node, *args, **kwargs):
        create(node, *args, **kwargs)
        threading.Thread(target=press_buttons, args=(node,), daemon=True).start()

    OpenCVCalibrationNode.__init__ = create_and_press
    sys.argv[0] = CALIBRATOR
    runpy.run_path(CALIBRATOR, run_name="__main__")


main()
