//! The rooms of the house: which may import which, which foreign crates live where, and that no
//! number stands naked in an expression.
//!
//! Source is read as text. Comments, strings and test code do not count.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Every room with the rooms that it may import. `lib.rs` is the hall, `bin` lives outside and
/// sees the public interface only.
const ROOMS: [(&str, &[&str]); 10] = [
    ("geom", &[]),
    ("tolerance", &[]),
    ("error", &["geom"]),
    ("boundary", &["geom", "error", "tolerance"]),
    ("mat", &["boundary", "geom", "error", "tolerance"]),
    ("offset", &["mat", "boundary", "geom", "error", "tolerance"]),
    ("toolpath", &["offset", "mat", "boundary", "geom", "error", "tolerance"]),
    // The judge shares no code with the accused.
    ("verify", &["geom", "error", "tolerance"]),
    ("io", &["toolpath", "verify", "offset", "mat", "boundary", "geom", "error", "tolerance"]),
    ("convert", &["boundary", "geom", "error", "tolerance"]),
];

/// Foreign crates with the rooms that they may appear in.
const FOREIGN: [(&str, &[&str]); 9] = [
    ("dxf", &[]),
    ("cavalier_contours", &["verify", "convert"]),
    ("robust", &["geom", "boundary"]),
    ("geo_types", &["convert"]),
    ("clap", &["bin"]),
    ("indicatif", &["bin"]),
    ("toml", &["bin"]),
    ("anyhow", &[]),
    ("log", &[]),
];

/// A source file without comments, strings and test code.
struct Source {
    path: PathBuf,
    /// Modules from the root: `["mat", "face"]` for `src/mat/face.rs`.
    module: Vec<String>,
    code: String,
}

impl Source {
    fn room(&self) -> &str {
        self.module.first().map_or("lib", String::as_str)
    }
}

/// All files of `src`, but for those that are test code as a whole.
fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    let mut folders = vec![root.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    let mut sources = Vec::new();
    let mut test_modules = Vec::new();
    for path in files {
        let plain = without_comments(&fs::read_to_string(&path).unwrap());
        let module = module_of(path.strip_prefix(&root).unwrap());
        let (code, tests) = without_tests(&plain);
        test_modules.extend(tests.into_iter().map(|name| [module.clone(), vec![name]].concat()));
        sources.push(Source { path, module, code });
    }
    // `write_tests` is the test module of `write`, named by a `#[path]`.
    sources.retain(|s| !s.module.last().is_some_and(|name| name.ends_with("_tests")));
    sources.retain(|s| !test_modules.iter().any(|test| s.module.starts_with(test)));
    sources
}

fn module_of(path: &Path) -> Vec<String> {
    let mut module: Vec<String> =
        path.with_extension("").components().map(|c| c.as_os_str().to_string_lossy().into_owned()).collect();
    if module.last().is_some_and(|last| last == "mod" || last == "lib") {
        module.pop();
    }
    module
}

/// Comments and the contents of strings and characters become blanks; lines stay.
fn without_comments(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let mut i = 0;
    while i < chars.len() {
        let end = match (at(i), at(i + 1)) {
            ('/', '/') => end_of_line(&chars, i),
            ('/', '*') => end_of_block(&chars, i),
            ('"', _) => end_of_string(&chars, i),
            ('r', '"' | '#') if i == 0 || !is_word(at(i - 1)) => end_of_raw(&chars, i),
            ('\'', '\\') => (i + 3..).find(|&j| at(j) == '\'' || j >= chars.len()).unwrap() + 1,
            ('\'', _) if at(i + 2) == '\'' => i + 3,
            _ => i,
        };
        if end > i {
            out.extend(chars[i..end.min(chars.len())].iter().map(|&c| if c == '\n' { c } else { ' ' }));
            i = end;
        } else {
            out.push(at(i));
            i += 1;
        }
    }
    out
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn end_of_line(chars: &[char], start: usize) -> usize {
    chars[start..].iter().position(|&c| c == '\n').map_or(chars.len(), |n| start + n)
}

fn end_of_block(chars: &[char], start: usize) -> usize {
    let (mut i, mut depth) = (start, 0);
    while i < chars.len() {
        match (chars[i], chars.get(i + 1)) {
            ('/', Some('*')) => (depth, i) = (depth + 1, i + 2),
            ('*', Some('/')) => (depth, i) = (depth - 1, i + 2),
            _ => i += 1,
        }
        if depth == 0 {
            break;
        }
    }
    i
}

fn end_of_string(chars: &[char], start: usize) -> usize {
    let mut i = start + 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

/// The end of `r"..."` or `r#"..."#`; `start` itself if it is a raw identifier.
fn end_of_raw(chars: &[char], start: usize) -> usize {
    let hashes = chars[start + 1..].iter().take_while(|&&c| c == '#').count();
    if chars.get(start + 1 + hashes) != Some(&'"') {
        return start;
    }
    let closing: Vec<char> = std::iter::once('"').chain(std::iter::repeat_n('#', hashes)).collect();
    let body = start + 2 + hashes;
    (body..chars.len()).find(|&i| chars[i..].starts_with(&closing)).map_or(chars.len(), |i| i + closing.len())
}

/// Takes out every item under `#[cfg(test)]`; also answers the names of modules in files of their
/// own among them.
fn without_tests(code: &str) -> (String, Vec<String>) {
    const MARK: &str = "#[cfg(test)]";
    let (mut out, mut rest, mut modules) = (String::new(), code, Vec::new());
    while let Some(at) = rest.find(MARK) {
        out.push_str(&rest[..at]);
        let item = &rest[at + MARK.len()..];
        let end = end_of_item(item);
        let words: Vec<&str> = item[..end].split_whitespace().collect();
        if let Some(name) = words.iter().skip_while(|&&w| w != "mod").nth(1).and_then(|w| w.strip_suffix(';'))
        {
            modules.push(name.to_owned());
        }
        rest = &item[end..];
    }
    out.push_str(rest);
    (out, modules)
}

/// Length of an item: to its first `;` or the end of its first block, outside of any brackets.
fn end_of_item(code: &str) -> usize {
    let mut depth = 0;
    for (i, c) in code.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => {
                depth -= 1;
                if depth == 0 && c == '}' {
                    return i + 1;
                }
            }
            ';' if depth == 0 => return i + 1,
            _ => {}
        }
    }
    code.len()
}

/// Words and punctuation, with `::` as one.
fn tokens(code: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = code.trim_start();
    while let Some(c) = rest.chars().next() {
        let length = if is_word(c) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else if rest.starts_with("::") {
            2
        } else {
            c.len_utf8()
        };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

/// All paths from the root that a file names through `crate` or `super`, groups included.
fn paths(source: &Source) -> Vec<Vec<String>> {
    let tokens = tokens(&source.code);
    let mut found = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        let begins = matches!(tokens[i], "crate" | "super") && tokens.get(i + 1) == Some(&"::");
        if begins && (i == 0 || tokens[i - 1] != "::") {
            i = path_tree(&tokens, i, source.module.clone(), &mut found);
        } else {
            i += 1;
        }
    }
    found
}

/// Reads one path with its groups from `tokens[i]`, relative to a module; answers where it ends.
fn path_tree(tokens: &[&str], mut i: usize, mut base: Vec<String>, found: &mut Vec<Vec<String>>) -> usize {
    loop {
        match tokens.get(i) {
            Some(&"{") => {
                i += 1;
                while !matches!(tokens.get(i), None | Some(&"}")) {
                    let end = path_tree(tokens, i, base.clone(), found);
                    i = end.max(i + 1);
                }
                return i + 1;
            }
            Some(&"crate") => base.clear(),
            Some(&"super") => drop(base.pop()),
            Some(&"self") => {}
            Some(word) if word.starts_with(is_word) => base.push((*word).to_owned()),
            _ => return i,
        }
        i += 1;
        if tokens.get(i) != Some(&"::") {
            found.push(base);
            return i;
        }
        i += 1;
    }
}

/// The room that each name lives in that `lib.rs` exports at the root.
fn exports() -> BTreeMap<String, String> {
    let lib = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs")).unwrap();
    let code = without_comments(&lib);
    let tokens = tokens(&code);
    let mut found = Vec::new();
    for i in 2..tokens.len() {
        if tokens[i - 2..i] == ["pub", "use"] {
            path_tree(&tokens, i, Vec::new(), &mut found);
        }
    }
    found.retain(|path| path.len() > 1);
    found.into_iter().map(|path| (path[path.len() - 1].clone(), path[0].clone())).collect()
}

#[test]
fn every_room_is_listed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for entry in fs::read_dir(root).unwrap() {
        let name =
            entry.unwrap().path().with_extension("").file_name().unwrap().to_string_lossy().into_owned();
        let known = name == "lib" || name == "bin" || ROOMS.iter().any(|(room, _)| *room == name);
        assert!(known, "src/{name} is no room of the house; tests/layers.rs lists them");
    }
}

#[test]
fn rooms_import_downwards_only() {
    let exports = exports();
    let mut wrong = Vec::new();
    for source in sources() {
        let Some((room, allowed)) = ROOMS.iter().find(|(room, _)| *room == source.room()) else { continue };
        for path in paths(&source) {
            let Some(first) = path.first() else { continue };
            let target = exports.get(first).unwrap_or(first);
            if target != room && !allowed.contains(&target.as_str()) {
                wrong.push(format!("{}: {room} may not import {}", source.path.display(), path.join("::")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn foreign_crates_stay_in_their_rooms() {
    let mut wrong = Vec::new();
    for source in sources() {
        let tokens = tokens(&source.code);
        // `use medial::io::dxf` makes `dxf` a name of our own.
        let own = |name: &str| tokens.windows(3).any(|w| w == ["io", "::", name]);
        for (i, &name) in tokens.iter().enumerate() {
            let Some((_, rooms)) = FOREIGN.iter().find(|(krate, _)| *krate == name) else { continue };
            let leading = i > 0 && tokens[i - 1] == "::";
            // After `::` it is foreign only at the head of a path: `::dxf`, but not `io::dxf`.
            let head = !leading || i < 2 || !tokens[i - 2].starts_with(is_word) || tokens[i - 2] == "use";
            let path = tokens.get(i + 1) == Some(&"::") && head;
            if path && !rooms.contains(&source.room()) && !own(name) {
                wrong.push(format!("{}: {name} does not belong in {}", source.path.display(), source.room()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Small numbers in a code, with their lines, but for those in `const` items.
fn naked_epsilons(code: &str) -> Vec<(usize, String)> {
    let mut kept = String::new();
    let mut rest = code;
    while let Some(at) = rest.find("const ") {
        let item = &rest[at..];
        let named = item["const ".len()..].trim_start().starts_with(|c: char| c.is_uppercase() || c == '_');
        let end = if named { const_end(item) } else { "const ".len() };
        kept.push_str(&rest[..at]);
        kept.extend(item[..end].chars().filter(|&c| c == '\n'));
        rest = &item[end..];
    }
    kept.push_str(rest);
    let mut found = Vec::new();
    for (number, line) in kept.lines().enumerate() {
        let words = line.split(|c: char| !(is_word(c) || c == '.' || c == '-' || c == '+'));
        for word in words.flat_map(literals) {
            found.push((number + 1, word));
        }
    }
    found
}

/// Length of a `const` item: its semicolon outside of brackets and blocks.
fn const_end(item: &str) -> usize {
    let mut depth = 0;
    for (i, c) in item.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' if depth == 0 => return i,
            ')' | ']' | '}' => depth -= 1,
            ';' if depth == 0 => return i + 1,
            _ => {}
        }
    }
    item.len()
}

/// The float literals of a word without blanks that are suspiciously small.
fn literals(word: &str) -> Vec<String> {
    /// Below this a number is a tolerance, whatever it says.
    const SMALL: f64 = 1e-5;
    let mut found = Vec::new();
    let bytes = word.as_bytes();
    let mut i = 0;
    while i < bytes.len() {
        let begins = bytes[i].is_ascii_digit() && (i == 0 || !is_word(char::from(bytes[i - 1])));
        let mut end = i;
        while begins && end < bytes.len() {
            let exponent =
                end > i && matches!(bytes[end - 1], b'e' | b'E') && matches!(bytes[end], b'-' | b'+');
            if !(bytes[end].is_ascii_alphanumeric() || matches!(bytes[end], b'.' | b'_') || exponent) {
                break;
            }
            end += 1;
        }
        let literal: String = word[i..end].chars().filter(|&c| c != '_').collect();
        let literal = literal.trim_end_matches("f64").trim_end_matches("f32");
        let small = literal.parse().is_ok_and(|x: f64| x > 0.0 && x < SMALL);
        if small || literal.to_lowercase().contains("e-") {
            found.push(literal.to_owned());
        }
        i = end.max(i + 1);
    }
    found
}

#[test]
fn no_number_is_a_naked_epsilon() {
    let mut wrong = Vec::new();
    for source in sources() {
        for (line, literal) in naked_epsilons(&source.code) {
            wrong.push(format!(
                "{}, near line {line} (test code not counted): {literal} needs a name, a `const` and a reason",
                source.path.display()
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_reader_of_sources_sees_through_groups_and_comments() {
    let text = r##"
        // use crate::mat;
        use crate::{error::{Defect, Error}, geom::point};
        use super::super::{offset::Level, mat};
        /* crate::verify */ fn f<'a>(c: char) -> bool { c == '"' || "crate::io" == r#"crate::io "# }
        #[cfg(test)]
        mod tests { use crate::toolpath; fn g() { assert!(x < 1e-9); } }
        #[cfg(test)]
        mod cases;
        pub(crate) fn h() { crate::tolerance::Tolerance::MM; }
    "##;
    let (code, tests) = without_tests(&without_comments(text));
    assert_eq!(tests, ["cases"]);
    let source = Source { path: PathBuf::new(), module: vec!["mat".into(), "face".into()], code };
    let rooms: Vec<String> = paths(&source).into_iter().map(|path| path[0].clone()).collect();
    assert_eq!(rooms, ["error", "error", "geom", "offset", "mat", "tolerance"]);
    assert!(naked_epsilons(&source.code).is_empty());
}

#[test]
fn naked_epsilons_are_found() {
    let code =
        "const TINY: [f64; 2] = [1e-9, 2e-9];\nlet x = y.abs() < 1.5e-9;\nif z<0.000_000_1{}\nx-1e-3+2.0e5;";
    let found: Vec<_> = naked_epsilons(code);
    assert_eq!(found, [(2, "1.5e-9".to_owned()), (3, "0.0000001".to_owned()), (4, "1e-3".to_owned())]);
}

#[test]
fn the_exports_of_the_root_are_known() {
    let exports = exports();
    assert_eq!(exports.get("Mat").map(String::as_str), Some("mat"));
    assert_eq!(exports.get("ArcSpline").map(String::as_str), Some("geom"));
}
