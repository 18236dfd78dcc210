//! The page of results, in Markdown, with an invisible key before each number that may be quoted.

use std::collections::BTreeMap;

/// `<!-- key: NAME -->VALUE` on the page, `<!-- quote: NAME -->VALUE` where it is quoted.
pub struct Page {
    text: String,
    keys: BTreeMap<String, String>,
}

impl Page {
    pub fn new() -> Self {
        let text = "# Speed against error\n\n".to_string();
        Self { text, keys: BTreeMap::new() }
    }

    pub fn heading(&mut self, title: &str) {
        self.text += &format!("## {title}\n\n");
    }

    pub fn paragraph(&mut self, text: &str) {
        self.text += text.trim();
        self.text += "\n\n";
    }

    /// A number under a name; spaces of the name become underscores.
    pub fn key(&mut self, name: &str, value: &str) -> String {
        let name = name.replace([' ', ','], "_").replace("__", "_");
        self.keys.insert(name.clone(), value.to_string());
        format!("<!-- key: {name} -->{value}")
    }

    /// The first column is text, the others are numbers.
    pub fn table(&mut self, header: &[&str], rows: &[Vec<String>]) {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        self.text += &line(&header.iter().map(|h| h.to_string()).collect::<Vec<_>>());
        self.text += &format!("|---|{}\n", "---:|".repeat(header.len() - 1));
        rows.iter().for_each(|row| self.text += &line(row));
        self.text += "\n";
    }

    pub fn figure(&mut self, file: &str, alt: &str) {
        self.text += &format!("![{alt}](figures/{file})\n\n");
    }

    pub fn text(&self) -> String {
        self.text.trim_end().to_string() + "\n"
    }

    pub fn keys(&self) -> &BTreeMap<String, String> {
        &self.keys
    }
}

/// Two digits, which is what a time on a shared machine has.
pub fn digits(value: f64) -> String {
    match value {
        v if !v.is_finite() => "—".into(),
        v if v >= 99.5 => {
            let unit = 10.0_f64.powf(v.log10().floor() - 1.0);
            format!("{:.0}", (v / unit).round() * unit)
        }
        v if v >= 9.95 => format!("{v:.0}"),
        v if v >= 0.995 => format!("{v:.1}"),
        v if v >= 0.0995 => format!("{v:.2}"),
        v if v >= 0.00995 => format!("{v:.3}"),
        v => scientific(v),
    }
}

/// An error.
pub fn scientific(value: f64) -> String {
    if !value.is_finite() {
        return "—".into();
    }
    if value == 0.0 { "0".into() } else { format!("{value:.1e}") }
}
