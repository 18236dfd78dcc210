//! What the compiler says where a scene lacks something: the texts of `messages/*.rs` against `messages/*.txt`.
//!
//! Each file is handed to the compiler that built this test, with the library this test is linked to. What is compared are the texts that
//! are ours: the error, the label at its place, and the notes without one.
//! With `HYPERROD_RENEW_MESSAGES=1` the `.txt` files are written instead.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use serde_json::Value;

/// The newest build of the library among what this test was linked from.
fn library() -> PathBuf {
    let deps = std::env::current_exe().unwrap().parent().unwrap().to_path_buf();
    let built = |path: &Path| path.metadata().and_then(|m| m.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let files = std::fs::read_dir(deps).unwrap().map(|entry| entry.unwrap().path());
    let ours = files.filter(|p| name(p).starts_with("libhyperrod-") && name(p).ends_with(".rlib"));
    ours.max_by_key(|path| built(path)).unwrap()
}

/// The errors of a file, as we wrote them.
fn compile(file: &Path, library: &Path) -> String {
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    let out = std::env::temp_dir().join(format!("hyperrod-{}", std::process::id()));
    let output = Command::new(compiler)
        .args([
            "--edition",
            "2024",
            "--crate-type",
            "bin",
            "--emit",
            "metadata",
            "--error-format",
            "json",
            "-A",
            "warnings",
        ])
        .arg("-L")
        .arg(format!("dependency={}", library.parent().unwrap().display()))
        .arg("--extern")
        .arg(format!("hyperrod={}", library.display()))
        .arg("-o")
        .arg(&out)
        .arg(file)
        .output()
        .unwrap();
    let _ = std::fs::remove_file(out);
    let mut text = String::new();
    for line in String::from_utf8_lossy(&output.stderr).lines() {
        let diagnostic: Value = serde_json::from_str(line).unwrap_or_else(|_| panic!("{line}"));
        if diagnostic["level"] != "error" || diagnostic["code"].is_null() {
            continue;
        }
        text += &format!(
            "error[{}]: {}\n",
            diagnostic["code"]["code"].as_str().unwrap(),
            diagnostic["message"].as_str().unwrap()
        );
        for span in diagnostic["spans"].as_array().unwrap().iter().filter(|s| s["is_primary"] == true) {
            text += &format!("  at: {}\n", span["label"].as_str().unwrap_or_default());
        }
        for child in diagnostic["children"].as_array().unwrap() {
            // the compiler's own notes are its own affair
            let ours = !child["message"].as_str().unwrap_or_default().starts_with("required for");
            if ours && child["level"] == "note" && child["spans"].as_array().unwrap().is_empty() {
                text += &format!("  note: {}\n", child["message"].as_str().unwrap());
            }
        }
    }
    text
}

#[test]
fn a_scene_that_lacks_something_is_told_what_to_add() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/loads/messages");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "rs"));
    files.sort();
    assert!(files.len() >= 5);
    let library = library();
    for file in files {
        let (said, snapshot) = (compile(&file, &library), file.with_extension("txt"));
        if std::env::var_os("HYPERROD_RENEW_MESSAGES").is_some() {
            std::fs::write(snapshot, said).unwrap();
            continue;
        }
        let expected = std::fs::read_to_string(&snapshot).unwrap_or_default();
        assert_eq!(said, expected, "{}", file.display());
    }
}
