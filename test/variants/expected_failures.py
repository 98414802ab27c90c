"""Variants that fail today, with the reason. The test fails when one of them passes, so that its line is struck out."""

EXPECTED_FAILURES = {
}
