"""Distribution of chi2."""

from __future__ import annotations

import math


def chi2_below(value: float, degrees: int) -> float:
    """Probability that chi2 with so many degrees of freedom is below a value: the regularised incomplete gamma function
    P(degrees/2, value/2), by its series, or beyond the bulk by its continued fraction."""
    a, x = 0.5 * degrees, 0.5 * value
    if x <= 0:
        return 0.0
    front = math.exp(-x + a * math.log(x) - math.lgamma(a))
    if x < a + 1:
        term = total = 1.0 / a
        n = a
        while term > 1e-17 * total:
            n += 1
            term *= x / n
            total += term
        return front * total
    # Lentz's method.
    b = x + 1 - a
    c, d = 1e300, 1 / b
    fraction = d
    for i in range(1, 1000):
        an = -i * (i - a)
        b += 2
        d = 1 / (an * d + b)
        c = b + an / c
        fraction *= c * d
        if abs(c * d - 1) < 1e-15:
            break
    return 1 - front * fraction


def chi2_above(value: float, degrees: int) -> float:
    """Probability that chi2 with so many degrees of freedom is above a value."""
    return 1 - chi2_below(value, degrees)


def chi2_quantile(probability: float, degrees: int) -> float:
    """Value that chi2 with so many degrees of freedom is below with a probability, by bisection."""
    low, high = 0.0, 1.0
    while chi2_below(high, degrees) < probability:
        high *= 2
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if chi2_below(middle, degrees) < probability else (low, middle)
    return 0.5 * (low + high)
