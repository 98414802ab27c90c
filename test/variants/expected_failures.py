"""Variants that fail today, with the reason. The test fails when one of them passes, so that its line is struck out."""

REASONS = {
    'a constant error of the right stamps is taken as true': [
        'right stamps 5 ms late',
        'right stamps 20 ms late',
        'right stamps 0.1 s late',
    ],
}

EXPECTED_FAILURES = {name: reason for reason, names in REASONS.items() for name in names}
