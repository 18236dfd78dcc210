"""Writes lie_coefficients.json: value, d/dx and d²/dx² of every coefficient function of src/lie, x = theta², to 50 digits.

By other formulas than the crate's: the power series of c_k, and theta/2 cot(theta/2) = c1/(2 c2) divided out by x at 400 digits.
x is the double nearest theta², taken as exact. Run: python3 generate_lie_coefficients.py > lie_coefficients.json (mpmath)
"""
import json
from math import comb

from mpmath import factorial, ff, mp, mpf, nstr, pi

mp.dps = 400
ORDERS = range(4)  # derivatives carried: those of a' need one more


def stumpff(k, x):
    return [sum((-1) ** j * ff(j, n) * x ** (j - n) / factorial(2 * j + k) for j in range(n, 160)) for n in ORDERS]


def quotient(p, q):  # Leibniz
    r = []
    for n in range(len(p)):
        r.append((p[n] - sum(comb(n, i) * r[i] * q[n - i] for i in range(n))) / q[0])
    return r


def row(theta):
    x64 = float(theta * theta)
    x = mpf(x64) or mpf("1e-60")  # the limit at 0, to 60 digits
    c = [stumpff(k, x) for k in range(7)]
    a = quotient(c[1], [2 * d for d in c[2]])
    b = quotient([(1 - a[0])] + [-d for d in a[1:]], [x, mpf(1), mpf(0), mpf(0)])
    named = {f"c{k}": d for k, d in enumerate(c)}
    named |= {f"dexp.d{i}": c[k][1:] for i, k in zip("abc", (1, 2, 3))}
    named |= {"inv.a": a, "inv.c": b, "inv.da": a[1:], "inv.dc": b[1:]}
    return {"theta": float(theta), "x": x64, "values": {k: [nstr(v, 50) for v in d[:3]] for k, d in named.items()}}


thetas = [mpf(0)] + [mpf(10) ** (mpf(k) / 2) for k in range(-24, 0, 2)]
thetas += [mpf(t) / 100 for t in (20, 33, 50, 75, 100, 125, 150, 157, 175, 200, 225, 250, 275, 300, 310)]
thetas += [pi - mpf("1e-8"), pi, mpf("3.1622"), mpf("3.1623"), mpf("3.5"), mpf(4), mpf(5), mpf(6)]
print("[\n" + ",\n".join(json.dumps(row(t)) for t in thetas) + "\n]")
