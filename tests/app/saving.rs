//! Saving presets, also where the system refuses.

use crate::skip;
use std::fs;
use std::process::Command;

use crate::pty::{RIGHT, TO_FORCE, Term, app, plain};
use portable_pty::CommandBuilder;

#[test]
fn a_preset_is_saved_and_replaced_only_when_told() {
    let home = tempfile::tempdir().unwrap();
    let mut command = app(&["tui", "paper-300n"]);
    command.env("XDG_CONFIG_HOME", home.path());
    let mut term = Term::start(command);
    term.wait_for("damage 26 %");
    term.keys(&format!("{TO_FORCE}{RIGHT}"));
    term.wait_for("paper-300n *");
    // Unsaved work is not lost without a question.
    term.keys("q");
    term.wait_for("not saved");
    term.keys("n");
    term.wait_without("not saved");
    term.keys("\x13");
    term.wait_for("Name");
    term.keys("\x15mine\r");
    term.wait_for("saved as mine");
    let file = home.path().join("contrecoup/presets/mine.ron");
    assert!(fs::read_to_string(&file).unwrap().contains("force_n: 310.0"));
    term.keys(RIGHT);
    term.wait_for("320 N");
    term.keys("\x13");
    term.wait_for("Name");
    term.keys("\r");
    term.wait_for("mine already");
    assert!(fs::read_to_string(&file).unwrap().contains("310"));
    term.keys("y");
    term.wait_for("saved as mine");
    assert!(fs::read_to_string(&file).unwrap().contains("force_n: 320.0"));
    term.keys("q");
    assert_eq!(term.exit_code(), 0);
    term.assert_restored();
}

#[test]
fn a_full_disk_is_explained_and_the_old_preset_survives() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("contrecoup/presets");
    fs::create_dir_all(&folder).unwrap();
    let mount = Command::new("mount")
        .args(["-t", "tmpfs", "-o", "size=8k,nr_inodes=16", "tmpfs"])
        .arg(&folder)
        .output();
    if !mount.is_ok_and(|output| output.status.success()) {
        skip::skip("a small file system cannot be mounted here");
        return;
    }
    let text = fs::read_to_string("presets/paper-300n.ron").unwrap();
    fs::write(folder.join("mine.ron"), &text).unwrap();
    // Whatever room is left is taken.
    let _ = fs::write(folder.join("filler"), vec![0; 1 << 20]);
    let mut command = app(&["tui", "mine"]);
    command.env("XDG_CONFIG_HOME", home.path());
    let term = Term::start(command);
    term.wait_for("damage 26 %");
    term.keys(&format!("{TO_FORCE}{RIGHT}"));
    term.wait_for("mine *");
    term.keys("\x13");
    term.wait_for("Name");
    term.keys("\r");
    term.wait_for("mine already");
    term.keys("y");
    term.wait_for("not saved");
    let kept = fs::read_to_string(folder.join("mine.ron")).unwrap();
    let names: Vec<_> =
        fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    drop(term);
    let unmounted = Command::new("umount").arg(&folder).status();
    assert!(unmounted.unwrap().success());
    assert_eq!(kept, text);
    assert_eq!(names.len(), 2, "{names:?}");
}

#[test]
fn a_limit_of_file_sizes_is_explained_and_ends_nothing() {
    let home = tempfile::tempdir().unwrap();
    let mut shell = CommandBuilder::new("bash");
    let line = format!("ulimit -f 0; exec {} tui paper-300n", env!("CARGO_BIN_EXE_contrecoup"));
    shell.args(["-c", &line]);
    plain(&mut shell);
    shell.env("XDG_CONFIG_HOME", home.path());
    let mut term = Term::start(shell);
    term.wait_for("damage 26 %");
    term.keys(&format!("{TO_FORCE}{RIGHT}"));
    term.wait_for("paper-300n *");
    term.keys("\x13");
    term.wait_for("Name");
    term.keys("\x15mine\r");
    term.wait_for("not saved: File too large");
    // What could not be saved is still there, and is asked for.
    term.keys("\x1b");
    term.wait_without("Name");
    term.keys("q");
    term.wait_for("not saved as a preset");
    // They were to be there again next time: who leaves now hears that they are not.
    term.keys("y");
    assert_eq!(term.exit_code(), 1);
    term.wait_for("the changes cannot be kept: File too large");
    term.assert_restored();
    let left = fs::read_dir(home.path().join("contrecoup/presets")).unwrap();
    assert_eq!(left.count(), 0);
    let left = fs::read_dir(home.path().join("contrecoup")).unwrap();
    assert_eq!(left.count(), 1);
}

#[test]
fn a_folder_that_cannot_be_made_is_explained() {
    let mut command = app(&["tui", "paper-300n"]);
    command.env("XDG_CONFIG_HOME", "/dev/null");
    let mut term = Term::start(command);
    term.wait_for("damage 26 %");
    term.keys("\x13");
    term.wait_for("Name");
    let long = "n".repeat(60);
    term.keys(&format!("\x15{long}\r"));
    term.wait_for("1 to 40 ASCII letters");
    term.keys("\x15../mine\r");
    term.wait_for("no / in a name");
    term.keys("\x15mine\r");
    term.wait_for("not saved: ");
    term.keys("\x1b");
    term.wait_without("Name");
    // Nothing is kept without a folder either, and nothing promised.
    term.keys(&format!("{TO_FORCE}{RIGHT}"));
    term.wait_for("paper-300n *");
    term.keys("q");
    term.wait_for("Quit and lose them?");
    term.keys("y");
    assert_eq!(term.exit_code(), 0);
}

#[test]
fn the_app_holds_a_thousand_presets_of_ones_own_and_says_so_of_more() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("contrecoup/presets");
    fs::create_dir_all(&folder).unwrap();
    let first = folder.join("own-0000.ron");
    fs::write(&first, "(name: \"Mine\", impact: ForcePulse(force_n: 42))").unwrap();
    for i in 1..1003 {
        fs::hard_link(&first, folder.join(format!("own-{i:04}.ron"))).unwrap();
    }
    let mut command = app(&["tui", "paper-300n", "--color", "never"]);
    command.env("XDG_CONFIG_HOME", home.path());
    let term = Term::start(command);
    term.wait_for("damage 26 %");
    term.keys("\x13");
    term.wait_for("Name");
    term.keys("\x15another\r");
    term.wait_for("1000 presets of your own are there");
    assert!(!folder.join("another.ron").exists());
    // One that is there already may be replaced.
    term.keys("\x15own-0001\r");
    term.wait_for("own-0001 already");
    term.keys("y");
    term.wait_for("saved as own-0001");
}

#[test]
fn a_preset_of_ones_own_is_renamed_and_removed_in_the_list() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("contrecoup/presets");
    let mut command = app(&["tui", "paper-300n"]);
    command.env("XDG_CONFIG_HOME", home.path());
    let mut term = Term::start(command);
    term.wait_for("damage 26 %");
    term.keys(&format!("{TO_FORCE}{RIGHT}"));
    term.wait_for("paper-300n *");
    term.keys("\x13");
    term.wait_for("Name");
    term.keys("\x15my blow\r");
    term.wait_for("saved as my blow");
    // Own presets stand on top, and the cursor is on the one in hand.
    term.keys("p");
    term.wait_for("own");
    term.keys("\x1bOQ");
    term.wait_for("Another name for my blow");
    term.keys("\x15mine\r");
    term.wait_for("renamed to mine");
    let text = fs::read_to_string(folder.join("mine.ron")).unwrap();
    assert!(text.contains("name: \"mine\"") && text.contains("force_n: 310.0"));
    assert!(!folder.join("my blow.ron").exists());
    term.keys("\x1b[3~");
    term.wait_for("from the disk");
    term.keys("n");
    term.wait_without("from the disk");
    assert!(folder.join("mine.ron").exists());
    term.keys("\x1b[3~");
    term.wait_for("from the disk");
    term.keys("y");
    term.wait_for("removed mine");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
    // The scene keeps its name, and is there again next time.
    term.keys("\x1b");
    term.wait_without("─ Open ─");
    assert!(term.text().contains("mine *"));
    term.keys("q");
    term.wait_for("again next time");
    term.keys("y");
    assert_eq!(term.exit_code(), 0);
    let mut command = app(&[]);
    command.env("XDG_CONFIG_HOME", home.path());
    let term = Term::start(command);
    term.wait_for("what you made of mine is here");
    term.keys("\x1b");
    term.wait_for("310 N");
    term.wait_for("mine *");
}

#[test]
fn the_first_start_asks_what_hit_the_eye_and_later_ones_go_on_where_one_left_off() {
    let home = tempfile::tempdir().unwrap();
    let open = || {
        let mut command = app(&[]);
        command.env("XDG_CONFIG_HOME", home.path());
        Term::start(command)
    };
    let mut term = open();
    term.wait_for("What hit the eye?");
    term.keys("squash");
    term.wait_for("24 g");
    term.keys("\r");
    term.wait_without("What hit the eye?");
    // What is typed first is how fast it was.
    term.wait_for("▸Speed");
    term.keys("55\r");
    term.wait_for("55 m/s");
    term.keys("\x1b3");
    term.wait_for("cursor");
    term.keys("q");
    term.wait_for("again next time");
    term.keys("y");
    assert_eq!(term.exit_code(), 0);
    // The last blow is on top of what can be opened, and Enter goes on with it.
    let mut term = open();
    term.wait_for("squash-ball@55");
    term.keys("\r");
    term.wait_for("cursor");
    term.keys("\x1b1");
    term.wait_for("55 m/s");
    term.wait_for("squash-ball *");
    term.keys("\x03");
    assert_eq!(term.exit_code(), 130);
    // A damaged file is told and costs nothing but the place.
    let file = home.path().join("contrecoup/last.ron");
    fs::write(&file, "(screen: ").unwrap();
    let term = open();
    term.wait_for("where you left off cannot be read");
    term.keys("\x1b");
    term.wait_without("What hit the eye?");
    term.wait_for("squash-ball");
}

#[test]
fn hostile_files_in_the_folder_of_the_app_reach_no_terminal() {
    let hostile = "\u{9b}2J\u{7f}\u{61c}\u{202e}\u{200b}\u{feff}\u{e0041}";
    // No command of the app itself, which has colours in its pictures.
    let blink = "\x1b[5m";
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("contrecoup");
    fs::create_dir_all(folder.join("presets")).unwrap();
    let own = "(name: \"Mine\", impact: ForcePulse(force_n: 42))";
    fs::write(folder.join(format!("presets/a{hostile}{blink}.ron")), own).unwrap();
    let broken = format!("(name: \"{hostile}\", {hostile}");
    fs::write(folder.join("presets/b.ron"), broken).unwrap();
    let changed = format!("Some(\"(name: \\\"{hostile}\\\", impact: ForcePulse())\")");
    let left = |source: &str, changed: &str| {
        format!("(screen: \"{hostile}\", source: \"{source}\", changed: {changed})")
    };
    for (file, said) in [
        (left(hostile, "None"), "cannot be opened any more: \\u{9b}2J"),
        (left("/dev/zero", "None"), "any more: /dev/zero"),
        (left(&"x".repeat(200_000), "None"), "any more: xxx"),
        (left("bb-56", &changed), "where you left off cannot be read"),
        (hostile.repeat(1000), "where you left off cannot be read"),
        ("(".repeat(100_000), "where you left off cannot be read"),
        (" ".repeat(300_000), "where you left off cannot be read"),
    ] {
        fs::write(folder.join("last.ron"), file).unwrap();
        let mut command = app(&[]);
        command.env("XDG_CONFIG_HOME", home.path());
        let mut term = Term::start(command);
        term.wait_for(said);
        // The list of presets finds it by its title.
        term.keys("mine");
        term.wait_for("a\\u{9b}2J");
        term.keys("\x03");
        assert_eq!(term.exit_code(), 130);
        term.assert_restored();
        let raw = String::from_utf8(term.raw()).unwrap();
        let through = |c: &char| !c.is_ascii() && raw.contains(*c);
        assert_eq!(hostile.chars().find(through), None);
        assert!(!raw.contains(blink), "{raw:?}");
        // What cannot be read makes room for what can.
        let kept = fs::read_to_string(folder.join("last.ron")).unwrap();
        assert!(kept.contains("source: \"squash-ball\""), "{kept}");
    }
}
