//! Publishes a page: to docs, and wherever one of its numbers is quoted.

use std::path::{Path, PathBuf};

use super::figure::{Outcome, Output, copy_to_docs};
use super::page::Page;

const MARK: &str = "<!-- quote: ";

/// Copies page and figures to `docs`, and renews the quotes.
pub fn publish(output: &Output, page: &Page) -> Outcome {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    std::fs::copy(output.path("work-precision.md"), root.join("docs/work-precision.md"))?;
    for entry in std::fs::read_dir(output.path("figures"))? {
        let path = entry?.path();
        let name = path.file_name().ok_or("a figure without a name")?.to_string_lossy().into_owned();
        copy_to_docs(&path, &name)?;
    }
    let mut files = vec![root.join("README.md"), root.join("src/lib.rs")];
    for folder in ["docs", "src/guide"] {
        files.extend(texts_in(&root.join(folder))?);
    }
    for file in files {
        let text = std::fs::read_to_string(&file)?;
        let renewed = renewed(&text, page).map_err(|error| format!("{}: {error}", file.display()))?;
        if renewed != text {
            std::fs::write(&file, renewed)?;
            println!("quotes renewed in {}", file.display());
        }
    }
    Ok(())
}

fn texts_in(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let entries: Result<Vec<_>, _> = std::fs::read_dir(folder)?.collect();
    let paths = entries?.into_iter().map(|entry| entry.path());
    Ok(paths.filter(|path| path.extension().is_some_and(|e| e == "md" || e == "rs")).collect())
}

/// The text with the number after every mark replaced by the page's. Keys of other pages are left alone.
fn renewed(text: &str, page: &Page) -> Outcome<String> {
    let mut pieces = text.split(MARK);
    let mut out = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let (key, rest) = piece.split_once(" -->").ok_or("a quote that does not end")?;
        let number = rest.find(|c: char| !(c.is_ascii_digit() || ".e+-".contains(c))).unwrap_or(rest.len());
        let old = rest[..number].trim_end_matches('.');
        let new = page.keys().get(key).map_or(old, String::as_str);
        out += &format!("{MARK}{key} -->{new}{}", &rest[old.len()..]);
    }
    Ok(out)
}
