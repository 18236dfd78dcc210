//! Lower quartiles of times, and the loop they are compared with. What else a shared machine does makes a call longer, never shorter.

use std::hint::black_box;
use std::time::Instant;

use super::Run;

/// Lower quartile of the time of a call, µs: as many calls as fit into a share of a second, at least three, at most a thousand.
pub fn quartile(run: &Run, mut call: impl FnMut()) -> f64 {
    run.bar.inc(1);
    let budget = run.of(2e3, 2e5);
    let mut times = Vec::new();
    let start = Instant::now();
    while times.len() < 3 || (times.len() < 1000 && start.elapsed().as_secs_f64() * 1e6 < budget) {
        let begin = Instant::now();
        call();
        times.push(begin.elapsed().as_secs_f64() * 1e6);
    }
    lower_quartile(times)
}

fn lower_quartile(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 4]
}

/// The same of several calls that take turns, µs.
pub fn interleaved(rounds: usize, calls: &mut [Box<dyn FnMut() + '_>]) -> Vec<f64> {
    let mut times = vec![Vec::with_capacity(rounds); calls.len()];
    for _ in 0..rounds {
        for (call, times) in calls.iter_mut().zip(&mut times) {
            let begin = Instant::now();
            call();
            times.push(begin.elapsed().as_secs_f64() * 1e6);
        }
    }
    times.into_iter().map(lower_quartile).collect()
}

/// Time of a thousand dependent multiply-adds, µs: the clock of the processor decides it alone. The unit of all ratios.
pub fn tick() -> f64 {
    let mut times = Vec::new();
    for _ in 0..21 {
        let begin = Instant::now();
        let mut x = black_box(1.0_f64);
        for _ in 0..200_000 {
            x = x * 0.999_999 + 1e-6;
        }
        black_box(x);
        times.push(begin.elapsed().as_secs_f64() * 1e6 / 200.0);
    }
    lower_quartile(times)
}
