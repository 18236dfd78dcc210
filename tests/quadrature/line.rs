//! Gauss and Legendre's rules on a line, against 25-digit nodes from mpmath and polynomials to degree 199.

use hyperrod::quadrature::{MAX_NODES, gauss_legendre};

#[test]
fn gauss_legendre_agrees_with_25_digit_values() {
    let table = include_str!("../data/gauss_legendre.txt");
    let mut rows = 0;
    let (mut worst_node, mut worst_weight) = (0.0f64, 0.0f64);
    for line in table.lines().filter(|l| !l.starts_with('#')) {
        let field: Vec<&str> = line.split_whitespace().collect();
        let n: usize = field[0].parse().unwrap();
        let (x, w): (f64, f64) = (field[1].parse().unwrap(), field[2].parse().unwrap());
        let rule = gauss_legendre(n).unwrap();
        let nearest = rule.iter().min_by(|p, q| (p.0 - x).abs().total_cmp(&(q.0 - x).abs())).unwrap();
        worst_node = worst_node.max((nearest.0 - x).abs());
        worst_weight = worst_weight.max((nearest.1 / w - 1.0).abs());
        rows += 1;
    }
    println!("nodes {worst_node:e}, weights {worst_weight:e}");
    assert_eq!(rows, 203);
    // one ulp of 1 for the nodes; the recurrence's n roundings for the weights, mostly cancelling
    assert!(
        worst_node <= f64::EPSILON && worst_weight <= 20.0 * f64::EPSILON,
        "{worst_node:e}, {worst_weight:e}"
    );
}

/// In Legendre polynomials, ∫ P_k = 0 for k ≥ 1: a sharp test to degree 199, where x^198 would hide everything inside.
#[test]
fn gauss_legendre_is_exact_to_degree_2n_minus_1_and_no_further() {
    for n in 1..=100 {
        let rule = gauss_legendre(n).unwrap();
        assert!(rule.nodes().windows(2).all(|x| x[0] < x[1]) && rule.nodes()[0] > -1.0);
        let integral = |k: usize| -> f64 {
            let legendre = |x: f64| {
                (1..k)
                    .fold((1.0, x), |(b, p), j| {
                        (p, ((2 * j + 1) as f64 * x * p - j as f64 * b) / (j + 1) as f64)
                    })
                    .1
            };
            rule.iter().map(|(x, w)| w * legendre(x)).sum()
        };
        assert!((rule.weights().iter().sum::<f64>() - 2.0).abs() < 1e-14);
        for k in 1..2 * n {
            // |P_k| ≤ 1, Σ w = 2, and P_k varies by k²·ε/2 at most over the rounding of a node near the ends, where the
            // weights are of size 1/k²
            assert!(integral(k).abs() < 2e-14, "n = {n}, degree {k}: {:e}", integral(k));
        }
        assert!(integral(2 * n).abs() > 1e-3, "n = {n}");
    }
}

#[test]
fn an_interval_rule_keeps_its_symmetry() {
    for n in [2, 7, 30, MAX_NODES] {
        let rule = gauss_legendre(n).unwrap();
        for i in 0..n {
            assert_eq!(rule.nodes()[i], -rule.nodes()[n - 1 - i]);
            assert_eq!(rule.weights()[i], rule.weights()[n - 1 - i]);
        }
    }
}
