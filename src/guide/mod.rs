//! The guide: one page a topic, which `contrecoup guide TOPIC` prints and which stands below.
//!
//! A page is a Markdown file beside this one that reads well as plain text in 80 columns: no
//! links, tables only where their rows line up. A new page costs its file and a line in the list
//! of topics; its title is its first line. Tables of figures stand between comments that name
//! where they come from: `tests/program/figures.rs` makes them.

#![allow(clippy::doc_markdown, reason = "pages are prose, in which methods and units are words")]

/// A page of the guide.
#[derive(Debug, Clone, Copy)]
pub struct Topic {
    /// What to ask for.
    pub name: &'static str,
    /// The page, in Markdown.
    pub page: &'static str,
}

macro_rules! topics {
    ($($module:ident = $name:literal),* $(,)?) => {
        /// Every page, in the order in which a newcomer might read them.
        pub static TOPICS: &[Topic] = &[$(Topic {
            name: $name,
            page: include_str!(concat!($name, ".md")),
        }),*];
        $(#[doc = include_str!(concat!($name, ".md"))] pub mod $module {})*
    };
}

topics! {
    install = "install", app = "app", keys = "keys", config = "config", ssh = "ssh",
    scenarios = "scenarios", objects = "objects", model = "model", sides = "sides",
    glossary = "glossary", accuracy = "accuracy", hard_cases = "hard-cases",
    evidence = "evidence", injury = "injury", outcomes = "outcomes",
    look_for = "look-for", doubt = "doubt", sweeps = "sweeps",
    report = "report", json = "json", speed = "speed", symbols = "symbols",
}

/// Whether a line of a page is of use on this system: only a shell of Unix can stop the app and go
/// on with it.
pub fn holds_here(line: &str) -> bool {
    cfg!(unix) || !line.starts_with("Ctrl-Z")
}

impl Topic {
    /// The first line of the page.
    pub fn title(&self) -> &'static str {
        self.page.lines().next().unwrap_or_default().trim_start_matches("# ")
    }

    /// The page without what only a renderer of Markdown needs, comments and fences, and without
    /// what does not hold here.
    pub fn plain(&self) -> String {
        let mut text = String::new();
        let mut blank = true;
        let read = |line: &&str| !["<!--", "```"].iter().any(|mark| line.starts_with(mark));
        for line in self.page.lines().filter(read).filter(|line| holds_here(line)) {
            // Where a comment stood between two blank lines, one of them is enough.
            if !(blank && line.is_empty()) {
                text.extend([line, "\n"]);
            }
            blank = line.is_empty();
        }
        text
    }
}

/// The topics, one a line with the title of its page.
pub fn contents() -> String {
    let width = TOPICS.iter().map(|topic| topic.name.len()).max().unwrap_or_default();
    let line = |topic: &Topic| format!("{:width$}  {}\n", topic.name, topic.title());
    TOPICS.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_page_has_a_title_and_fits_into_80_columns() {
        for topic in TOPICS {
            assert!(topic.page.starts_with("# "), "{}", topic.name);
            for line in topic.plain().lines().chain(contents().lines()) {
                assert!(line.chars().count() <= 80, "{}: {line}", topic.name);
            }
        }
    }

    #[test]
    fn every_file_beside_this_one_is_a_topic() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/guide");
        for file in std::fs::read_dir(folder).unwrap() {
            let path = file.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap();
            let listed = TOPICS.iter().any(|topic| topic.name == name);
            assert!(listed || name == "mod", "{name} is not listed");
        }
    }

    #[test]
    fn fences_and_comments_are_for_markdown_only() {
        let page =
            "# A\n\n<!-- figures: x -->\n\n```text\n  1\n```\n\n<!-- end of figures -->\n\nB\n";
        assert_eq!(Topic { name: "a", page }.plain(), "# A\n\n  1\n\nB\n");
    }
}
