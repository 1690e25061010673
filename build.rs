//! Turns the cells of the literate notebooks into programs, one function a notebook.

// The titles and hidden cells that it also reads are for pages.
#[path = "src/lesson/source.rs"]
#[allow(dead_code)]
mod source;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// Other sources of the same kind.
const HANDOUT: &str = "reports/chapter.md";

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("set by cargo"));
    let out = PathBuf::from(env::var("OUT_DIR").expect("set by cargo"));
    println!("cargo:rerun-if-changed=notebooks");
    println!("cargo:rerun-if-changed=src/lesson/source.rs");
    // Lessons have a number; the others are pages around them.
    let is_lesson = |path: &PathBuf| {
        path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(char::is_numeric))
    };
    let (lessons, around): (Vec<_>, Vec<_>) =
        files(&root.join("notebooks"), "md")?.into_iter().partition(is_lesson);
    write_programs(&lessons, &out.join("lessons.rs"))?;
    write_programs(&around, &out.join("around.rs"))?;
    println!("cargo:rerun-if-changed={HANDOUT}");
    write_programs(&[root.join(HANDOUT)], &out.join("handout.rs"))
}

/// The files of a folder that end so, in the order of their names.
fn files(folder: &Path, kind: &str) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut files: Vec<PathBuf> = entries.collect::<io::Result<_>>()?;
    files.retain(|path| path.extension().is_some_and(|own| own == kind));
    files.sort();
    Ok(files)
}

/// A function for each notebook, and the list of them.
fn write_programs(sources: &[PathBuf], to: &Path) -> io::Result<()> {
    let (mut functions, mut list) = (String::new(), String::new());
    for (k, path) in sources.iter().enumerate() {
        let text = fs::read_to_string(path)?;
        let source = source::Source::read(&text);
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let folder = path.parent().expect("a file in a folder");
        let drawings: String = text
            .split("](drawings/")
            .skip(1)
            .filter_map(|rest| rest.split(')').next())
            .map(|name| {
                format!("({name:?}, include_str!({:?})), ", folder.join("drawings").join(name))
            })
            .collect();
        let digits = name.split('_').next().unwrap_or_default();
        let problems = folder.join("problems").join(format!("{digits}.toml"));
        let problems = if problems.exists() {
            format!("include_str!({problems:?})")
        } else {
            "\"\"".to_string()
        };
        let _ = writeln!(
            list,
            "    lcplab::lesson::Program {{ name: {name:?}, text: include_str!({path:?}), cells: program_{k}, \
             drawings: &[{drawings}], problems: {problems} }},"
        );
        let _ = writeln!(functions, "\nfn program_{k}() -> lcplab::lesson::Ran {{");
        for (c, code) in source.cells().enumerate() {
            let _ = writeln!(functions, "    lcplab::lesson::cell({c});\n{code}");
        }
        functions += "    Ok(())\n}\n";
    }
    // Output goes to the page under the cell; in a Jupyter kernel the usual macro is in force.
    let println = "#[allow(unused_macros)]\nmacro_rules! println {\n    \
                   ($($words:tt)*) => { lcplab::lesson::say(&format!($($words)*)) };\n}\n";
    let text =
        format!("{println}\npub const ALL: &[lcplab::lesson::Program] = &[\n{list}];\n{functions}");
    fs::write(to, text)
}
