//! `contrecoup guide`, as a shell and as a terminal see it.

use crate::pty;
use crate::pty::Term;
use contrecoup::guide::{TOPICS, contents};
use portable_pty::CommandBuilder;
use predicates::prelude::*;
use predicates::str::{contains, is_empty};

fn guide(arguments: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = assert_cmd::Command::cargo_bin("contrecoup").unwrap();
    command.arg("guide").args(arguments).env("PAGER", "false").assert()
}

/// The guide on a terminal of 24 rows with this pager.
fn on_terminal(topic: &str, pager: &str) -> Term {
    let mut command: CommandBuilder = pty::app(&["guide", topic]);
    command.env("PAGER", pager);
    Term::start(command)
}

#[test]
fn without_a_topic_it_lists_them() {
    guide(&[]).success().stdout(contains(contents()).and(contains("glossary")));
}

#[test]
fn every_topic_is_printed_plainly_through_a_pipe() {
    for topic in TOPICS {
        let plain = contains("\u{1b}").or(contains("```")).or(contains("<!--")).not();
        let page = guide(&[topic.name]).success().stderr(is_empty());
        page.stdout(plain.and(contains(topic.title())));
    }
}

#[test]
fn an_unknown_topic_is_bad_input_and_leads_to_the_nearest() {
    guide(&["acuracy"])
        .code(2)
        .stdout(is_empty())
        .stderr(contains("acuracy").and(contains("a similar value exists: 'accuracy'")));
}

#[test]
fn on_a_terminal_the_page_goes_through_the_pager_that_is_asked_for() {
    let mut term = on_terminal("glossary", "sed -n '1s/Glossary/paged by & of/p'");
    term.wait_for("paged by Glossary of: the words");
    assert_eq!(term.exit_code(), 0);
}

#[test]
fn a_pager_runs_without_a_shell_and_may_run_no_programs_of_its_own() {
    let mut term = on_terminal("ssh", "sh -c 'echo secure=$LESSSECURE; cat >/dev/null; exit 3'");
    term.wait_for("secure=1");
    // What the pager thinks of the page is not what the page was asked for.
    assert_eq!(term.exit_code(), 0);
    let mut term = on_terminal("ssh", "echo one; echo two");
    term.wait_for("one; echo two");
    assert_eq!(term.exit_code(), 0);
}

#[test]
fn without_a_pager_the_page_is_printed_all_the_same() {
    let last = TOPICS.iter().find(|topic| topic.name == "injury").unwrap().plain();
    let last = last.lines().last().unwrap().to_owned();
    for pager in ["", "/nonexistent/pager -x", "an 'open quote"] {
        let mut term = on_terminal("injury", pager);
        term.wait_for(&last);
        assert_eq!(term.exit_code(), 0);
    }
}

#[test]
fn a_reader_who_leaves_early_is_no_failure() {
    let mut term = on_terminal("accuracy", "true");
    assert_eq!(term.exit_code(), 0);
    assert_eq!(term.text(), "");
}

#[test]
fn the_readme_asks_of_each_screen_what_the_app_does() {
    let readme = include_str!("../../README.md");
    for (i, screen) in contrecoup::tui::screens::SCREENS.iter().enumerate() {
        let row = format!("| `F{}` | {} | {}", i + 1, screen.title, screen.question);
        assert!(readme.contains(&row), "{row}");
    }
}
