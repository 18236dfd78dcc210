"""Gauss-Legendre nodes x >= 0 and weights on [-1, 1] to 25 digits, for tests/quadrature/line.rs.

    python3 gauss_legendre.py > gauss_legendre.txt
"""

from mpmath import mp, mpf, cos, legendre, nstr, pi

mp.dps = 40
print("# n x weight")
for n in (1, 2, 3, 5, 8, 13, 20, 50, 100, 200):
    for k in range((n + 1) // 2):
        x = mpf(0) if 2 * k + 1 == n else cos(pi * (k + mpf(3) / 4) / (n + mpf(1) / 2))
        slope = lambda t: n * (legendre(n - 1, t) - t * legendre(n, t)) / (1 - t * t)
        for _ in range(7):
            x -= legendre(n, x) / slope(x)
        print(n, nstr(x, 25), nstr(2 / ((1 - x * x) * slope(x) ** 2), 25))
