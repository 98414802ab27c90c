"""Variants that fail today, with the reason. The test fails when one of them passes, so that its line is struck out."""

REASONS = {
    'a constant error of the right stamps is taken as true': [
        'right stamps 5 ms late',
        'right stamps 20 ms late',
        'right stamps 0.1 s late',
    ],
    'an orientation that stands still from mid-drive holds back the turn of the images before it is suspected': [
        'IMU stuck from mid-drive',
    ],
}

EXPECTED_FAILURES = {name: reason for reason, names in REASONS.items() for name in names}
