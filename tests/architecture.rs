//! The shape of the source: imports go only toward the ground, every layer says what it is, no file is long, and nothing prints.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use std::fs;
use std::path::{Path, PathBuf};

/// From the ground up.
const LAYERS: [&str; 12] = [
    "error",
    "scalar",
    "lie",
    "quadrature",
    "material",
    "section",
    "body",
    "load",
    "rod",
    "solve",
    "output",
    "guide",
];

/// Lines a file may have, tests not counted.
const LONGEST: usize = 400;

struct Source {
    path: PathBuf,
    layer: String,
    /// Without tests.
    text: String,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// Every file of the library but its tests.
fn sources() -> Vec<Source> {
    let (mut folders, mut sources) = (vec![root()], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs")
                && path.file_stem().is_none_or(|s| s != "tests")
            {
                let text = without_tests(&fs::read_to_string(&path).unwrap());
                let inside = path.strip_prefix(root()).unwrap().with_extension("");
                let layer = inside.iter().next().unwrap().to_string_lossy().into_owned();
                sources.push(Source { path, layer, text });
            }
        }
    }
    assert!(sources.len() > 40, "only {} files found", sources.len());
    sources
}

/// The text up to the unit tests, which end a file.
fn without_tests(text: &str) -> String {
    text.split("#[cfg(test)]").next().unwrap_or_default().to_string()
}

/// Code alone: comments and docs may point anywhere.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(|line| line.split("//").next().unwrap_or_default())
}

fn height(layer: &str) -> Option<usize> {
    LAYERS.iter().position(|l| *l == layer)
}

/// The names that follow `crate::`, also those in braces.
fn imported(text: &str) -> Vec<String> {
    let code: String = code(text).collect::<Vec<_>>().join(" ");
    let name =
        |s: &str| s.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut names = Vec::new();
    for (at, pattern) in code.match_indices("crate::") {
        if code[..at].ends_with('$') {
            continue; // $crate in a macro: code of the user
        }
        let rest = &code[at + pattern.len()..];
        match rest.strip_prefix('{') {
            None => names.push(name(rest)),
            Some(list) => names.extend(top_level_items(list).iter().map(|item| name(item))),
        }
    }
    names
}

/// The items of a braced list that ends where its brace closes, without what they have in braces themselves.
fn top_level_items(list: &str) -> Vec<String> {
    let (mut depth, mut flat) = (0, String::new());
    for c in list.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            c if depth == 0 => flat.push(c),
            _ => {}
        }
    }
    flat.split(',').filter(|item| !item.trim().is_empty()).map(str::to_string).collect()
}

/// Types the crate root re-exports, by the layer they come from.
fn home(name: &str) -> String {
    let lib = fs::read_to_string(root().join("lib.rs")).unwrap();
    for line in code(&lib).filter_map(|line| line.trim().strip_prefix("pub use ")) {
        let (layer, items) = line.split_once("::").unwrap_or((line, ""));
        let exports = |item: &str| item.trim_matches(|c: char| !c.is_alphanumeric() && c != '_') == name;
        if items.split(',').any(exports) {
            return layer.to_string();
        }
    }
    name.to_string()
}

#[test]
fn imports_go_only_toward_the_ground() {
    let mut checked = 0;
    for source in sources().iter().filter(|s| s.layer != "lib") {
        let place = source.path.display();
        let here = height(&source.layer).unwrap_or_else(|| panic!("{place}: {} is no layer", source.layer));
        for name in imported(&source.text) {
            let layer = home(&name);
            let there = height(&layer).unwrap_or_else(|| panic!("{place}: crate::{name} is in no layer"));
            assert!(there <= here, "{place} imports crate::{name}: {layer} lies above {}", source.layer);
            checked += 1;
        }
    }
    assert!(checked > 50, "only {checked} imports found");
}

#[test]
fn every_layer_says_in_a_paragraph_what_it_is() {
    for layer in LAYERS.iter().filter(|l| **l != "error") {
        let path = root().join(layer).join("mod.rs");
        let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let docs: Vec<&str> = text.lines().take_while(|line| line.starts_with("//!")).collect();
        assert!(docs.len() >= 3, "{}: {} lines of //!", path.display(), docs.len());
    }
}

#[test]
fn no_file_is_long() {
    for source in sources() {
        let lines = source.text.lines().count();
        assert!(lines <= LONGEST, "{}: {lines} lines without tests", source.path.display());
    }
}

#[test]
fn the_library_never_prints() {
    for source in sources() {
        for (number, line) in code(&source.text).enumerate() {
            for word in ["println!", "print!", "dbg!", "io::stdout", "io::stderr"] {
                assert!(!line.contains(word), "{}:{}: {word}", source.path.display(), number + 1);
            }
        }
    }
}

/// The reading of imports itself, so that it cannot pass by finding nothing.
#[test]
fn an_import_is_found_however_it_is_written() {
    let text = "use crate::{a::{b, c}, d}; // crate::no\nfn f() -> crate::e::F { $crate::g() }\n/// crate::h\nuse crate::I;";
    assert_eq!(imported(text), ["a", "d", "e", "I"]);
    assert_eq!(home("Rod"), "rod");
    assert_eq!(home("Twist"), "lie");
}
