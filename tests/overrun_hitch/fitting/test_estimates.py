"""Standard errors against those of linear least squares, and parameters without effect."""

from __future__ import annotations

import numpy as np

from overrun_hitch.fitting.estimates import correlation, covariance

N = 4000
TIME = np.linspace(0.0, 1.0, N)
J = np.column_stack([np.ones(N), TIME, np.sin(40.0 * TIME)])


def test_of_white_residuals_it_is_that_of_least_squares() -> None:
    residuals = 3.0 * np.random.default_rng(0).normal(size=N)
    found = np.sqrt(np.diag(covariance([J], [residuals], 1)[0]))
    np.testing.assert_allclose(found, 3.0 * np.sqrt(np.diag(np.linalg.inv(J.T @ J))), rtol=0.05)


def test_residuals_that_hang_together_say_less() -> None:
    """As if there were one sample for each ten."""
    residuals = np.repeat(np.random.default_rng(0).normal(size=N // 10), 10)
    found = np.sqrt(np.diag(covariance([J], [residuals], 60)[0]))
    np.testing.assert_allclose(found, np.sqrt(10.0 * np.diag(np.linalg.inv(J.T @ J))), rtol=0.2)


def test_what_has_no_effect_is_not_told() -> None:
    """A column of zeros, and two that are the same; the third beside them is."""
    residuals = np.random.default_rng(0).normal(size=N)
    for columns, lost in (([0, 1, 2, None], [False, False, False, True]), ([0, 1, 1], [False, True, True])):
        made = np.column_stack([np.zeros(N) if column is None else J[:, column] for column in columns])
        found, _ = covariance([made], [residuals], 1)
        assert np.isinf(np.diag(found)).tolist() == lost
        assert np.isfinite(correlation(found)).all()


def test_what_rests_on_few_samples_has_few_degrees_of_freedom() -> None:
    """As many as the samples in which a parameter has an effect; all of them for one that has the same in each."""
    few = np.column_stack([np.ones(N), np.arange(N) % (N // 8) == 0])
    freedom = covariance([few], [np.random.default_rng(0).normal(size=N)], 1)[1]
    np.testing.assert_allclose(freedom, [N, 8.0], rtol=0.01)
