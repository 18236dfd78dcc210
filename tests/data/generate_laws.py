"""Writes laws.json: u, ∂u/∂γ and ∂²u/∂γ² of the laws that the integrals over sections (A_section_response.json) leave out, to 50 digits.

Each law is its textbook formula of F = I + γ ⊗ e₃, with I₁ − 3 and the like formed by subtraction and differentiated numerically, both with
150 digits. Run: python3 generate_laws.py > laws.json (mpmath)
"""
import json

from mpmath import cos, diff, exp, log, mp, mpf, nstr, sin, sqrt

mp.dps = 150
X, Y = mpf(0.004), mpf(-0.007)
MU, LAMBDA, KAPPA = mpf(170e3), mpf(400e3), mpf(500e3)


def invariants(a, b, e):
    """I₁, I₂ and J."""
    i1 = 2 + a**2 + b**2 + (1 + e) ** 2
    j = 1 + e
    # C = [[1, 0, a], [0, 1, b], [a, b, |f|²]]: I₂ = (tr² C − tr C²)/2
    f = a**2 + b**2 + (1 + e) ** 2
    return i1, (i1**2 - (2 + 2 * a**2 + 2 * b**2 + f**2)) / 2, j


def stretches(a, b, e):
    i1, _, j = invariants(a, b, e)
    # the two that are not 1: λ₊λ₋ = J, λ₊² + λ₋² = I₁ − 1
    plus, minus = sqrt(i1 - 1 + 2 * j), sqrt(i1 - 1 - 2 * j)
    return [mpf(1), (plus + minus) / 2, (plus - minus) / 2]


def isochoric(a, b, e):
    i1, _, j = invariants(a, b, e)
    return i1 * j ** (mpf(-2) / 3) - 3, j


def isochoric_neo_hookean(*g):
    x, j = isochoric(*g)
    return MU / 2 * x + KAPPA / 2 * (j - 1) ** 2


def yeoh(*g):
    x, j = isochoric(*g)
    y = (j - 1) ** 2
    return mpf(85e3) * x - mpf(4e3) * x**2 + mpf(1e3) * x**3 + mpf(250e3) * y + mpf(1e3) * y**2


def arruda_boyce(*g):
    x, j = isochoric(*g)
    c = [mpf(1) / 2, mpf(1) / 20, mpf(11) / 1050, mpf(19) / 7000, mpf(519) / 673750]
    chains = sum(c[i] / mpf(3) ** (2 * i) * ((x + 3) ** (i + 1) - mpf(3) ** (i + 1)) for i in range(5))
    return MU * chains + KAPPA / 2 * ((j**2 - 1) / 2 - log(j))


def ogden(*g):
    j = 1 + g[2]
    u = LAMBDA / 2 * log(j) ** 2
    for mu, alpha in [(100e3, 1.3), (2e3, 5.0), (-40e3, -2.0)]:
        mu, alpha = mpf(mu), mpf(alpha)
        u += mu / alpha * (sum(l**alpha for l in stretches(*g)) - 3 - alpha * log(j))
    return u


def fung(*g):
    x, j = isochoric(*g)
    b = mpf(2.5)
    return MU / (2 * b) * (exp(b * x) - 1) + KAPPA / 2 * (j - 1) ** 2


def hencky(*g):
    return MU * sum(log(l) ** 2 for l in stretches(*g)) + LAMBDA / 2 * log(1 + g[2]) ** 2


def blatz_ko(nu, f):
    def u(*g):
        i1, i2, j = invariants(*g)
        beta = nu / (1 - 2 * nu)
        solid = i1 - 3 + (j ** (-2 * beta) - 1) / beta
        foam = i2 / j**2 - 3 + (j ** (2 * beta) - 1) / beta
        return MU * f / 2 * solid + MU * (1 - f) / 2 * foam

    return u


def fibre(d, k1, k2, a, b, e):
    moved = [d[0] + a * d[2], d[1] + b * d[2], d[2] + e * d[2]]
    strain = sum(m**2 for m in moved) - 1
    return k1 / (2 * k2) * (exp(k2 * strain**2) - 1) if strain > 0 else mpf(0)


def along(d):
    size = sqrt(sum(x**2 for x in d))
    return [x / size for x in d]


def artery(*g):
    beta, r = mpf(0.5), sqrt(X**2 + Y**2)
    u = isochoric_neo_hookean(*g)
    for sign in (1, -1):
        s = sign * sin(beta) / r
        u += fibre([-s * Y, s * X, cos(beta)], mpf(80e3), mpf(1.2), *g)
    return u


def neo_hookean(*g):
    i1, _, j = invariants(*g)
    return MU / 2 * (i1 - 3 - 2 * log(j)) + LAMBDA / 2 * log(j) ** 2


def yarn(*g):
    return neo_hookean(*g) + fibre(along([-40 * Y, 40 * X, mpf(1)]), mpf(80e3), mpf(1.2), *g)


def axial_fibres(*g):
    return fibre([mpf(0), mpf(0), mpf(1)], mpf(80e3), mpf(1.2), *g)


LAWS = {
    "isochoric neo-Hookean": isochoric_neo_hookean,
    "Yeoh": yeoh,
    "Arruda-Boyce": arruda_boyce,
    "Ogden": ogden,
    "Fung": fung,
    "Hencky": hencky,
    "Blatz-Ko": blatz_ko(mpf(0.3), mpf(0.4)),
    "Blatz-Ko foam": blatz_ko(mpf(1) / 4, mpf(0)),
    "Holzapfel-Gasser-Ogden": artery,
    "yarn": yarn,
    "fibres alone": axial_fibres,
    "scaled": lambda *g: neo_hookean(*g) / 4,
}
DIRECTIONS = [(0.6, -0.4, 0.7), (-0.3, 0.9, -0.5), (0.2, 0.1, 0.95)]
SIZES = [0.3, 1e-2, 1e-5, 1e-9]
ORDERS = [(2, 0, 0), (1, 1, 0), (1, 0, 1), (0, 2, 0), (0, 1, 1), (0, 0, 2)]


def digits(x):
    return nstr(x, 50)


rows = []
for name, u in LAWS.items():
    for direction in DIRECTIONS:
        for size in SIZES:
            gamma = [size * d for d in direction]  # doubles, taken as exact
            g = tuple(mpf(x) for x in gamma)
            first = [diff(u, g, tuple(int(i == k) for k in range(3))) for i in range(3)]
            second = [diff(u, g, order) for order in ORDERS]
            rows.append([name, gamma, digits(u(*g)), [digits(x) for x in first], [digits(x) for x in second]])

print('{"x": %r, "y": %r, "rows": [' % (float(X), float(Y)))
print(",\n".join(json.dumps(row) for row in rows))
print("]}")
