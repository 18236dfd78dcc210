use hyperrod::material::*;
use hyperrod::*;
use nalgebra::SVector;
use num_dual::*;
use std::time::Instant;
struct Plain {
    c: [f64; 5],
}
impl Isotropic for Plain {
    #[inline]
    fn energy_density<D: Scalar>(&self, i: &Invariants<D>, _at: &Point<D>) -> D {
        let c = self.c;
        let (a, b, e) = (i.i1(), i.i2(), i.j());
        a * c[0] + b * c[1] + a * a * c[2] + a * b * c[3] + e * e * c[4]
    }
}
fn main() {
    let plain = Plain { c: [1e5, 3e4, 2e4, -5e3, 5e5] };
    let (c10, c01, c20, c11, d1) = (1e5, 3e4, 2e4, -5e3, 5e5);
    let iso = hyperrod::isotropic!([c10:f64,c01:f64,c20:f64,c11:f64,d1:f64] degree 8; |i,_at| { let (a,b,e)=(i.i1(),i.i2(),i.j()); a*c10+b*c01+a*a*c20+a*b*c11+e*e*d1 });
    let loc = hyperrod::local!([c10:f64,c01:f64,c20:f64,c11:f64,d1:f64] degree 8; |f,_at| { let g=f.gamma(); let e=g.z; let s=g.x*g.x+g.y*g.y; let q=e*e+e*2.0; let (a,b)=(s+q,s+q*2.0); a*c10+b*c01+a*a*c20+a*b*c11+e*e*d1 });
    let sec = hyperrod::sectional!([c10:f64,c01:f64,c20:f64,c11:f64,d1:f64] degree 8; |x,at| { let (w,n)=(x.angular,x.linear); let a=n.x-w.z*at.y; let b=n.y+w.z*at.x; let e=n.z+w.x*at.y-w.y*at.x; let s=a*a+b*b; let q=e*e+e*2.0; let (a,b)=(s+q,s+q*2.0); a*c10+b*c01+a*a*c20+a*b*c11+e*e*d1 });
    let clo = isotropic(move |i, _| {
        let (a, b, e) = (i.i1(), i.i2(), i.j());
        a * c10 + b * c01 + a * a * c20 + a * b * c11 + e * e * d1
    });
    let nh = NeoHookean::new(1.7e5, 4e5).unwrap();
    // 3x8 product points
    let mut pts = Points::default();
    for k in 0..3 {
        let t = [0.1127016653792583, 0.5, 0.8872983346207417][k];
        let r = 0.01 * f64::sqrt(t);
        for j in 0..8 {
            let th = j as f64 * std::f64::consts::TAU / 8.0;
            pts.x.push(r * th.cos());
            pts.y.push(r * th.sin());
            pts.weight.push(std::f64::consts::PI * 1e-4 * [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0][k] / 8.0);
        }
    }
    let mut seed = 1u64;
    let mut rnd = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let strains: Vec<Strain> = (0..10000)
        .map(|_| {
            Strain::from_array([
                20.0 * rnd(),
                20.0 * rnd(),
                20.0 * rnd(),
                0.1 * rnd(),
                0.1 * rnd(),
                0.1 * rnd(),
            ])
        })
        .collect();
    let at = Station::straight(0.0);
    for (name, m) in [
        ("iso", &iso as &dyn Material),
        ("local", &loc),
        ("sectional", &sec),
        ("neo", &nh),
        ("plain", &plain),
        ("closure", &clo),
    ] {
        for req in [Request::Energy, Request::Wrench, Request::Tangent, Request::Rate] {
            let mut best = f64::INFINITY;
            let mut acc = 0.0;
            for _ in 0..7 {
                let t = Instant::now();
                for s in &strains {
                    let r = m.integrate(&pts, &at, s, req).unwrap();
                    acc += r.energy + r.wrench.force.x + r.tangent[(2, 3)];
                }
                best = best.min(t.elapsed().as_secs_f64() * 1e9 / strains.len() as f64);
            }
            println!("{name} {req:?} {best:.0} ns {acc:e}");
        }
    }
    // num-dual 6 variables
    let mut best = f64::INFINITY;
    let mut acc = 0.0;
    for _ in 0..3 {
        let t = Instant::now();
        for s in &strains {
            let xi = s.to_vector();
            let (u, g, h) = hessian(
                |v: SVector<Dual2SVec64<6>, 6>| {
                    let mut sum = Dual2SVec64::<6>::from(0.0);
                    for q in 0..24 {
                        let p = Point {
                            x: Dual2SVec64::from(pts.x[q]),
                            y: Dual2SVec64::from(pts.y[q]),
                            s: Dual2SVec64::from(0.0),
                        };
                        sum += Sectional::energy_density(&sec, &Strain::from_vector(&v), &p) * pts.weight[q];
                    }
                    sum
                },
                &xi,
            );
            acc += u + g[3] + h[(2, 3)];
        }
        best = best.min(t.elapsed().as_secs_f64() * 1e9 / strains.len() as f64);
    }
    println!("num-dual 6 {best:.0} {acc:e}");
}
