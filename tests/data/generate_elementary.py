"""Writes elementary.json: ln, ln_1p, x − ln(1+x), exp, exp_m1 and powf over their whole ranges, each to 106 bits.

A row is [x, high, low], or [x, p, high, low]: high is the double nearest the value, low the double nearest the rest. x and p are
doubles and taken as exact. Run: python3 generate_elementary.py > elementary.json (mpmath)
"""
import json
import math
import random
import sys

from mpmath import expm1, log, log1p, mp, mpf, power

mp.dps = 800  # 1 − ln(1+x)/x at x = 1e-320 and 106 bits
random.seed(20240607)

SMALLEST, LARGEST = 5e-324, sys.float_info.max
NORMAL = sys.float_info.min


def beside(x, n=2):
    """x and its neighbours."""
    row = [x]
    for direction in (math.inf, -math.inf):
        y = x
        for _ in range(n):
            y = math.nextafter(y, direction)
            row.append(y)
    return row


def decades(low, high, n):
    return [10.0 ** random.uniform(low, high) for _ in range(n)]


def pair(value):
    high = float(value)
    return [high, float(value - mpf(high))]


def table(f, xs):
    return [[x] + pair(f(mpf(x))) for x in sorted(set(xs))]


root = 2**0.5
positive = decades(-307, 308, 60) + decades(-323, -308, 20) + [SMALLEST, NORMAL, LARGEST] + beside(NORMAL)
positive += [random.uniform(0.3, 3) for _ in range(100)] + [random.uniform(0.69, 1.42) for _ in range(80)]
positive += beside(root) + beside(root / 2) + beside(2.0) + beside(0.5)
positive += [1 + s * 2.0**-k for k in range(2, 53) for s in (1, -1)]

above = decades(-307, 308, 60) + decades(-323, -308, 15) + [SMALLEST, LARGEST] + beside(root - 1) + [1.0, 3.0]
above += [random.uniform(0, 3) for _ in range(100)] + [random.uniform(0.35, 0.6) for _ in range(60)]
below = [-x for x in decades(-307, -0.01, 50) + decades(-323, -308, 15)] + beside(root / 2 - 1)
below += [-random.uniform(0, 1) for _ in range(100)] + [-1 + 2.0**-k for k in range(1, 54)]

exponents = [random.uniform(-708, 709) for _ in range(120)] + [random.uniform(-2, 2) for _ in range(120)]
exponents += [s * x for x in decades(-307, 2.8, 50) for s in (1, -1)]
exponents += [s * x for s in (1, -1) for x in beside(float(log(2)) / 2) + beside(float(log(2)))]
exponents += [707.9 + 0.05 * k for k in range(22)] + beside(708.9999) + [-707.9999, -707.5, SMALLEST, -SMALLEST]

powers = [-2 / 3, 1 / 3, -4 / 3, 0.5, 1.5, 2.5, 1.3, 5.0, -2.0, 10.7, 1.0, 2.0, 3.0, -1.0, 100.5, -37.2, 1000.25]
bases = decades(-300, 300, 12) + [random.uniform(0.3, 3) for _ in range(20)] + [SMALLEST, NORMAL, LARGEST, root]
bases += [1 - 2.0**-40, 1 + 2.0**-30, 0.75]
rows = []
for p in powers:
    # by hand, the ends of the range
    ends = [float(power(10, mpf(d) / p)) for d in (-307, 307.7)] if abs(p) > 1 else []
    for x in bases + ends:
        exponent = mpf(p) * log(mpf(x))
        if -707.99 < exponent < 708.99:
            rows.append([x, p] + pair(power(mpf(x), mpf(p))))

tables = {
    "ln": table(log, positive),
    "ln_1p": table(log1p, above + below),
    "x_minus_ln_1p": table(lambda x: x - log1p(x), above + below),
    "exp": table(mp.exp, exponents),
    "exp_m1": table(expm1, exponents),
    "powf": rows,
}
lines = [f'"{name}": [\n' + ",\n".join(map(json.dumps, rows)) + "\n]" for name, rows in tables.items()]
print("{\n" + ",\n".join(lines) + "\n}")
