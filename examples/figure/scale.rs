/// A map from data to pixels, linear or logarithmic, with its ticks.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Data at both ends (their decimal logarithms on a logarithmic scale).
    data: [f64; 2],
    pixel: [f64; 2],
    log: bool,
}

impl Scale {
    pub fn new([low, high]: [f64; 2], pixel: [f64; 2], log: bool) -> Self {
        let data = if log { [low.log10(), high.log10()] } else { [low, high] };
        Self { data, pixel, log }
    }

    /// The smallest round range around the values.
    pub fn fit(values: impl Iterator<Item = f64>, log: bool) -> [f64; 2] {
        let usable = values.filter(|v| v.is_finite() && (!log || *v > 0.0));
        let [low, high] = usable.fold([f64::MAX, f64::MIN], |[a, b], v| [v.min(a), v.max(b)]);
        if low > high {
            return if log { [0.1, 1.0] } else { [0.0, 1.0] };
        }
        if log {
            // half a digit of room, so that no point lies on the box
            return [low / 1.6, high * 1.6];
        }
        let span = if high > low { high - low } else { high.abs().max(1.0) };
        let step = nice_step(span, 5.0);
        [(low / step + 1e-9).floor() * step, (high / step - 1e-9).ceil() * step]
    }

    pub fn px(&self, value: f64) -> f64 {
        let value = if self.log { value.log10() } else { value };
        let t = (value - self.data[0]) / (self.data[1] - self.data[0]);
        self.pixel[0] + t * (self.pixel[1] - self.pixel[0])
    }

    pub fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    /// Where the labelled ticks are, with their labels; about one in `spacing` pixels.
    pub fn ticks(&self, spacing: f64) -> Vec<(f64, String)> {
        let [low, high] = self.data;
        if self.log && high - low < 3.2 {
            return one_two_five(low, high);
        }
        let wanted = ((self.pixel[1] - self.pixel[0]).abs() / spacing).max(1.0);
        let step = nice_step(high - low, wanted);
        let step = if self.log { step.max(1.0).round() } else { step };
        let decimals = (-step.log10() - 1e-9).ceil().max(0.0) as usize;
        let first = (low / step - 1e-6).ceil() as i64;
        let last = (high / step + 1e-6).floor() as i64;
        (first..=last)
            .map(|k| {
                let value = k as f64 * step;
                match self.log {
                    true => (10.0_f64.powf(value), power_of_ten(value.round() as i64)),
                    false => (value, format!("{value:.decimals$}").replace('-', "−")),
                }
            })
            .collect()
    }
}

/// The 1, 2 or 5 times a power of ten that divides a span into about so many parts.
fn nice_step(span: f64, parts: f64) -> f64 {
    let raw = span / parts;
    let decade = 10.0_f64.powf(raw.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * decade >= raw * 0.999);
    factor.unwrap_or(10.0) * decade
}

/// 1, 2 and 5 times every power of ten between two logarithms, written out.
fn one_two_five(low: f64, high: f64) -> Vec<(f64, String)> {
    let decades = low.floor() as i32..=high.ceil() as i32;
    let values = decades.flat_map(|k| [1, 2, 5].map(|digit| (digit, k)));
    let label = |digit: i32, k: i32| match k {
        -3..=4 => format!("{}", f64::from(digit) * 10.0_f64.powi(k)),
        _ => format!("{digit}·{}", power_of_ten(k.into())),
    };
    let ticks = values.map(|(digit, k)| (f64::from(digit) * 10.0_f64.powi(k), label(digit, k)));
    ticks.filter(|(v, _)| (low..=high).contains(&v.log10())).collect()
}

fn power_of_ten(exponent: i64) -> String {
    let superscript = |c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => char::from_u32('⁰' as u32 + (c as u32 - '0' as u32)).unwrap_or(c),
    };
    format!("10{}", exponent.to_string().chars().map(superscript).collect::<String>())
}
