//! The page that `contrecoup report` writes, as a browser has it.
//!
//! The browser is chromium. Where there is none the tests that need it say so and pass, but not
//! where `CI` is set.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::program::program;

/// Writes a page of these into the folder.
fn written(folder: &Path, name: &str, arguments: &[&str]) -> PathBuf {
    let file = folder.join(name);
    let path = file.to_str().unwrap().to_owned();
    let all = [&["report"], arguments, &["-o", &path]].concat();
    let output = program(&all).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    file
}

fn read(file: &Path) -> String {
    fs::read_to_string(file).unwrap()
}

#[test]
fn a_page_holds_the_answer_and_loads_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let name = "name=<script>alert(1)</script>";
    let short = ["bb-56", "--set", "window_ms=0.3", "--set", name];
    let page = read(&written(folder.path(), "one.html", &short));
    for words in [
        "globe rupture</strong>",
        "found in ",
        "window_short",
        "Cornea pushed in",
        "0.345 g",
        "contrecoup report bb-56 --set 'window_ms=0.3'",
        "doi:10.4172/jcsb.1000128",
        concat!("contrecoup ", env!("CARGO_PKG_VERSION")),
        "&lt;script&gt;alert(1)",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("<script>alert"));
    // Eye, forces, pressure and injury curves.
    assert_eq!(page.matches("<svg").count(), 4);
    for loads in [" src=", " href=", "url(", "@import", "fetch("] {
        assert!(!page.contains(loads), "{loads}");
    }
    assert!(page.contains("default-src 'none'"));
}

#[test]
fn several_are_compared_and_other_ends_of_names_give_other_forms() {
    let folder = tempfile::tempdir().unwrap();
    let two = ["paper-300n", "bb-56", "--set", "window_ms=0.3"];
    let page = read(&written(folder.path(), "two.html", &two));
    assert!(page.contains("Side by side"));
    assert_eq!(page.matches("class=\"replay\"").count(), 2);
    let words = read(&written(folder.path(), "two.md", &two));
    assert!(words.starts_with("# Side by side") && words.contains("| Cornea pushed in |"));
    let picture = read(&written(folder.path(), "two.SVG", &two));
    assert!(picture.starts_with("<svg") && picture.contains("300 N for 0.2 ms"));
    let output = program(&["report", "paper-300n", "-o", "page.pdf"]).output();
    let output = output.unwrap();
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(complaint.contains("allowed .html, .md, .svg"), "{complaint}");
}

#[test]
fn a_file_that_cannot_be_written_is_a_failure_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("none/page.html");
    let output = program(&["report", "paper-300n", "-o", file.to_str().unwrap()]).output();
    assert_eq!(output.unwrap().status.code(), Some(1));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// The browser, if there is one here.
fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let works = |name: &&str| Command::new(name).arg("--version").output().is_ok();
    let found = names.into_iter().find(works);
    assert!(found.is_some() || std::env::var_os("CI").is_none(), "no browser");
    if found.is_none() {
        eprintln!("NOT CHECKED: no chromium here");
    }
    found
}

/// What the browser prints, and what it complains of.
fn browsed(browser: &str, folder: &Path, arguments: &[&str], page: &str) -> (String, String) {
    let profile = format!("--user-data-dir={}", folder.join("profile").display());
    let usual = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr"];
    let mut command = Command::new(browser);
    let output = command.args(usual).args(arguments).args([&profile, page]).output();
    let output = output.unwrap();
    assert!(output.status.success(), "{output:?}");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&output.stdout), text(&output.stderr))
}

#[test]
fn in_a_browser_the_replay_moves_without_a_complaint() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let blow = ["bb-56", "--set", "model=Physiological"];
    let page = written(folder.path(), "one.html", &blow);
    let page = format!("file://{}", page.display());
    let dump = ["--virtual-time-budget=2500", "--dump-dom"];
    let frame = |dom: &str| -> u32 {
        let after = dom.split("data-frame=\"").nth(1).expect("the script has run");
        after.split('"').next().unwrap().parse().unwrap()
    };
    let shell = |dom: &str| dom.split("class=\"globe\" d=\"").nth(1).unwrap()[..200].to_owned();
    let (still, complaints) = browsed(browser, folder.path(), &dump, &page);
    assert!(!complaints.contains("CONSOLE"), "{complaints}");
    let (moved, complaints) = browsed(browser, folder.path(), &dump, &format!("{page}#play"));
    assert!(!complaints.contains("CONSOLE"), "{complaints}");
    assert!(frame(&still) > 0 && frame(&moved) > 10);
    assert_ne!(frame(&still), frame(&moved));
    assert_ne!(shell(&still), shell(&moved));
}

#[test]
fn a_blow_is_printed_on_one_page_of_a4() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let squash = ["squash-ball", "--set", "model=Physiological"];
    for blow in [&["paper-300n"][..], &squash] {
        let page = written(folder.path(), "one.html", blow);
        let pdf = folder.path().join("one.pdf");
        let print = [&format!("--print-to-pdf={}", pdf.display()), "--no-pdf-header-footer"];
        let page = format!("file://{}", page.display());
        browsed(browser, folder.path(), &print, &page);
        let pdf = String::from_utf8_lossy(&fs::read(pdf).unwrap()).into_owned();
        assert_eq!(pdf.matches("/Type /Page\n").count(), 1, "{blow:?}");
        // 595 x 842 points.
        assert!(pdf.contains("/MediaBox [0 0 59") && pdf.contains(" 84"), "no A4");
    }
}

#[test]
fn a_name_of_80_letters_stays_on_the_page_and_in_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let long = format!("name={}", "W".repeat(80));
    let blow = ["bb-56", "--set", "window_ms=0.1", "--set", &long];
    let picture = read(&written(folder.path(), "one.svg", &blow));
    let number = |after: &str| -> f64 {
        let rest = picture.split_once(after).unwrap().1;
        rest.split(['"', ' ']).next().unwrap().parse().unwrap()
    };
    let (wide, name) = (number("viewBox=\"0 0 "), number("textLength=\""));
    assert!(name + 16.0 <= wide, "{name} of {wide}");
    let short = read(&written(folder.path(), "two.svg", &["bb-56", "--set", "window_ms=0.1"]));
    assert!(!short.contains("textLength"), "only what would be too wide is set closer");
    let Some(browser) = browser() else { return };
    let page = written(folder.path(), "one.html", &blow);
    let script = "<script>document.title = document.documentElement.scrollWidth</script></body>";
    let text = read(&page).replace("</body>", script);
    fs::write(&page, text).unwrap();
    let arguments = ["--window-size=400,800", "--dump-dom"];
    let (dom, _) =
        browsed(browser, folder.path(), &arguments, &format!("file://{}", page.display()));
    let wide = dom.split_once("<title>").unwrap().1.split_once('<').unwrap().0;
    assert!(wide.parse::<u32>().unwrap() <= 500, "{wide} pixels in a window of 400");
}
