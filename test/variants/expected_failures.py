"""Variants that fail today, with the reason. The test fails when one of them passes, so that its line is struck out."""

REASONS = {
    'six seconds do not tell such a small error of the right stamps beyond doubt': [
        'right stamps 5 ms late',
    ],
}

EXPECTED_FAILURES = {name: reason for reason, names in REASONS.items() for name in names}
