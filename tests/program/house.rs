//! The rules of the house: which room may import which, how files of a room hang together, what
//! only the app knows, how many names mean two things, and how wide a comment is.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Rooms from the lowest; those of one row do not import each other.
const ROOMS: [&[&str]; 10] = [
    &["normal", "files", "plain_text"],
    &["whole_file", "scenario"],
    &["run"],
    &["models", "injury"],
    &["answer"],
    &["many"],
    &["verify"],
    &["report", "error", "guide"],
    &["tui"],
    &["cli"],
];

/// Files that import each other in a circle, at most.
const LARGEST_CIRCLE: usize = 3;
/// Names of public types that stand more than once, at most.
const MOST_TWICE: usize = 8;

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
}

/// Every file of `folder` with its text.
fn files(folder: &str) -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut found = Vec::new();
    sources(&root, &mut found);
    found.sort();
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        (path.strip_prefix(&root).unwrap().to_owned(), text)
    };
    found.into_iter().map(read).collect()
}

/// A file of the library as a module, such as `["run", "flags"]`.
fn module(file: &Path) -> Vec<String> {
    let names = file.with_extension("");
    let mut names: Vec<String> =
        names.iter().map(|name| name.to_str().unwrap().to_owned()).collect();
    if names.last().is_some_and(|name| name == "mod") {
        names.pop();
    }
    names
}

/// Modules of the library with their code: neither comments nor tests.
fn modules() -> BTreeMap<Vec<String>, String> {
    let code = |text: &str| {
        let (code, _) = text.split_once("#[cfg(test)]\nmod tests {").unwrap_or((text, ""));
        let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
        lines.collect::<Vec<_>>().join("\n")
    };
    let is_test = |names: &[String]| names.iter().any(|name| name.ends_with("tests"));
    files("src")
        .into_iter()
        .map(|(file, text)| (module(&file), code(&text)))
        .filter(|(names, _)| !is_test(names) && names != &["lib"] && names != &["main"])
        .collect()
}

/// The paths that a tree such as `a::{b, c::d}` stands for.
fn spread(tree: &str) -> Vec<String> {
    let Some((head, rest)) = tree.split_once('{') else {
        return vec![tree.to_owned()];
    };
    let (mut paths, mut depth, mut part) = (Vec::new(), 0, String::new());
    for sign in rest.chars() {
        match sign {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            _ => {}
        }
        if sign == ',' && depth == 0 {
            paths.extend(spread(part.trim()));
            part.clear();
        } else {
            part.push(sign);
        }
    }
    paths.extend(spread(part.trim()));
    paths.retain(|path| !path.is_empty());
    paths.iter().map(|path| format!("{head}{path}")).collect()
}

/// What follows each `crate::` or `super::` in some code, whole trees of braces included.
fn named(code: &str, word: &str) -> Vec<String> {
    let ends = |rest: &str| {
        let mut depth = 0;
        let end = rest.find(|sign: char| {
            depth += i32::from(sign == '{') - i32::from(sign == '}');
            let of_path = sign.is_alphanumeric() || "_:{}".contains(sign);
            !(of_path || depth > 0) || depth < 0
        });
        end.unwrap_or(rest.len())
    };
    let begin = |at: usize| !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
    let trees = code.match_indices(word).filter(|(at, _)| begin(*at));
    trees
        .flat_map(|(at, _)| {
            let rest = &code[at + word.len()..];
            spread(&rest[..ends(rest)])
        })
        .collect()
}

/// Names that a module hands on, each with where it comes from.
fn handed_on(modules: &BTreeMap<Vec<String>, String>) -> BTreeMap<String, String> {
    let of = |(from, code): (&Vec<String>, &String)| {
        let uses = code.match_indices("pub use ").map(|(at, word)| {
            let tree = &code[at + word.len()..];
            let tree = &tree[..tree.find(';').unwrap()];
            let whole = tree.strip_prefix("crate::");
            whole.map_or_else(|| format!("{}::{tree}", from.join("::")), str::to_owned)
        });
        let paths = uses.flat_map(|tree| spread(&tree.replace('\n', " ")));
        let pairs = paths.map(|path| {
            let (_, name) = path.rsplit_once("::").unwrap();
            (format!("{}::{name}", from.join("::")), path)
        });
        pairs.collect::<Vec<_>>()
    };
    modules.iter().flat_map(of).collect()
}

/// The modules that each imports: the file where what it names is written.
fn imports() -> BTreeMap<Vec<String>, BTreeSet<Vec<String>>> {
    let modules = modules();
    let elsewhere = handed_on(&modules);
    let of = |(from, code): (&Vec<String>, &String)| {
        let handed = |line: &&str| !line.starts_with("pub use ");
        let code: String =
            code.split(';').map(str::trim_start).filter(handed).collect::<Vec<_>>().join(";\n");
        let whole = named(&code, "crate::").into_iter();
        // Further in it stands for a module within the file.
        let tops: String =
            code.lines().filter(|line| !line.starts_with(' ')).collect::<Vec<_>>().join("\n");
        let above = &from[..from.len() - 1];
        let above =
            named(&tops, "super::").into_iter().map(|path| format!("{}::{path}", above.join("::")));
        let held = |path: String| {
            let names: Vec<&str> = path.split("::").collect();
            let known =
                (1..=names.len()).find_map(|count| elsewhere.get(&names[..count].join("::")));
            let path = known.unwrap_or(&path);
            let mut names: Vec<String> = path.split("::").map(str::to_owned).collect();
            while !names.is_empty() && !modules.contains_key(&names) {
                names.pop();
            }
            (!names.is_empty() && &names != from).then_some(names)
        };
        (from.clone(), whole.chain(above).filter_map(held).collect())
    };
    modules.iter().map(of).collect()
}

#[test]
fn trees_of_imports_are_spread() {
    let code = "use crate::run::{flags, kept::{Keep, Spacing}};\nlet x = crate::files::open(y);";
    let all = ["run::flags", "run::kept::Keep", "run::kept::Spacing", "files::open"];
    assert_eq!(named(code, "crate::"), all);
}

#[test]
fn a_lower_room_imports_no_higher_one() {
    let floor = |room: &str| {
        let floor = ROOMS.iter().position(|floor| floor.contains(&room));
        floor.unwrap_or_else(|| panic!("{room} has no place in the house"))
    };
    let imports = imports();
    assert!(imports.len() > 250);
    for (from, others) in &imports {
        for other in others.iter().filter(|other| other[0] != from[0]) {
            assert!(floor(&from[0]) > floor(&other[0]), "{from:?} imports {other:?}");
        }
    }
}

/// The names that stand after some words at the beginning of a line, each with its room.
fn headed(words: &[&str]) -> Vec<(String, String)> {
    let of = |(names, code): (Vec<String>, String)| {
        let name = |line: &str| {
            let bare = line.trim_start();
            let bare = bare.strip_prefix("pub").map_or(bare, |rest| {
                let rest = rest.strip_prefix('(').and_then(|rest| rest.split_once(')'));
                rest.map_or(&bare["pub".len()..], |(_, rest)| rest).trim_start()
            });
            let rest = words.iter().find_map(|word| bare.strip_prefix(word))?;
            // Behind the parameters of an implementation.
            let rest = match rest.strip_prefix('<') {
                Some(rest) => rest.split_once("> ").map(|(_, rest)| rest)?,
                None => rest.strip_prefix(' ')?,
            };
            let is_of_trait = words == ["impl"] && rest.contains(" for ");
            let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()?;
            (!is_of_trait && !name.is_empty()).then(|| name.to_owned())
        };
        code.lines().filter_map(name).map(|name| (names[0].clone(), name)).collect::<Vec<_>>()
    };
    modules().into_iter().flat_map(of).collect()
}

#[test]
fn what_a_type_can_do_stands_in_its_own_room() {
    let mut types: BTreeSet<_> =
        headed(&["struct", "enum", "trait", "union"]).into_iter().collect();
    // Another name for a type is of its room too.
    for (names, code) in modules() {
        let aliases = code.lines().filter_map(|line| line.split_once("type ")?.1.split_once(" = "));
        for (name, target) in aliases {
            let target = target.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
            if types.contains(&(names[0].clone(), target.to_owned())) {
                types.insert((names[0].clone(), name.to_owned()));
            }
        }
    }
    let done = headed(&["impl"]);
    assert!(types.len() > 300 && done.len() > 250, "{} {}", types.len(), done.len());
    for held in done {
        assert!(types.contains(&held), "{} does something to {} of another room", held.0, held.1);
    }
}

#[test]
fn no_more_than_three_files_import_each_other() {
    let imports = imports();
    let reached = |from: &Vec<String>| {
        let (mut seen, mut next) = (BTreeSet::new(), vec![from.clone()]);
        while let Some(module) = next.pop() {
            for other in imports.get(&module).into_iter().flatten() {
                if seen.insert(other.clone()) {
                    next.push(other.clone());
                }
            }
        }
        seen
    };
    let reach: BTreeMap<_, _> = imports.keys().map(|from| (from, reached(from))).collect();
    for (from, others) in &reach {
        let circle: Vec<_> = others
            .iter()
            .filter(|other| reach.get(other).is_some_and(|back| back.contains(*from)))
            .collect();
        assert!(circle.len() <= LARGEST_CIRCLE, "{circle:?}");
    }
}

#[test]
fn nothing_below_the_app_knows_its_screen() {
    for (names, code) in modules() {
        if names[0] != "tui" {
            assert!(!code.contains("ratatui::"), "{names:?}");
            assert!(!code.contains("crossterm::"), "{names:?}");
        }
    }
}

#[test]
fn few_names_of_public_types_stand_more_than_once() {
    let kinds = ["pub struct ", "pub enum ", "pub trait ", "pub type "];
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for code in modules().values() {
        for line in code.lines() {
            let rest = kinds.iter().find_map(|kind| line.trim_start().strip_prefix(kind));
            let name =
                |rest: &str| rest.split(|c: char| !c.is_alphanumeric()).next().map(str::to_owned);
            if let Some(name) = rest.and_then(name) {
                *counts.entry(name).or_default() += 1;
            }
        }
    }
    assert!(counts.len() > 300, "{}", counts.len());
    counts.retain(|_, count| *count > 1);
    assert!(counts.len() <= MOST_TWICE, "{counts:?}");
}

#[test]
fn no_comment_is_wider_than_100_columns() {
    for folder in ["src", "tests", "benches", "examples"] {
        for (file, text) in files(folder) {
            for (i, line) in text.lines().enumerate() {
                let is_comment = line.trim_start().starts_with("//");
                let width = line.chars().count();
                assert!(!is_comment || width <= 100, "{}:{}", file.display(), i + 1);
            }
        }
    }
}
