//! A table that goes through a CSV file, so that the page can be made from files alone.

use std::path::Path;

use super::figure::Outcome;

pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// A row of a [`Table`], read by the names of its columns.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    header: &'a [String],
    cells: &'a [String],
}

impl Table {
    /// Names of columns carry the unit.
    pub fn new(header: &[&str]) -> Self {
        Self { header: header.iter().map(|name| name.to_string()).collect(), rows: Vec::new() }
    }

    /// Adds texts, then numbers with all their digits.
    pub fn push(&mut self, texts: &[&str], numbers: &[f64]) {
        let texts = texts.iter().map(|text| text.to_string());
        self.rows.push(texts.chain(numbers.iter().map(|value| format!("{value:?}"))).collect());
    }

    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> + Clone {
        self.rows.iter().map(|cells| Row { header: &self.header, cells })
    }

    pub fn save(&self, path: &Path) -> Outcome {
        let line = |cells: &[String]| cells.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",");
        let lines = std::iter::once(line(&self.header)).chain(self.rows.iter().map(|row| line(row)));
        Ok(std::fs::write(path, lines.collect::<Vec<_>>().join("\n") + "\n")?)
    }

    pub fn load(path: &Path) -> Outcome<Self> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let mut lines = text.lines().map(split);
        let header = lines.next().ok_or("an empty table")?;
        Ok(Self { header, rows: lines.collect() })
    }
}

impl Row<'_> {
    pub fn text(&self, column: &str) -> &str {
        let place = self.header.iter().position(|name| name == column);
        place.and_then(|i| self.cells.get(i)).map_or("", String::as_str)
    }

    /// NaN where it is none.
    pub fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or(f64::NAN)
    }

    pub fn is(&self, column: &str, text: &str) -> bool {
        self.text(column) == text
    }
}

fn quoted(cell: &str) -> String {
    if cell.contains(',') { format!("\"{cell}\"") } else { cell.to_string() }
}

/// The cells of a line: commas inside quotes do not end one.
fn split(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut inside = false;
    for c in line.chars() {
        match c {
            '"' => inside = !inside,
            ',' if !inside => cells.push(String::new()),
            c => {
                if let Some(cell) = cells.last_mut() {
                    cell.push(c);
                }
            }
        }
    }
    cells
}
