//! A sweep as it runs on a cluster: GNU parallel shares it out, jobs are killed and started again,
//! and the parts are put together by the command of the guide.

#![cfg(unix)]

use crate::skip;
use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const APP: &str = env!("CARGO_BIN_EXE_contrecoup");
const PATIENCE: Duration = Duration::from_secs(120);
/// Long enough to be killed in the middle, short enough for a test.
const SWEEP: [&str; 8] = [
    "sweep",
    "paper-300n",
    "--set",
    "window=1",
    "--vary",
    "impact.force_n=50:500:120",
    "--vary",
    "impact.angle_deg=0,10,20,30",
];

fn rows(path: &Path) -> usize {
    fs::read_to_string(path).map_or(0, |text| text.lines().count())
}

/// The process that works on a shard, such as `3/8`, in this folder.
fn worker(folder: &Path, shard: &str) -> Option<u32> {
    let pids = fs::read_dir("/proc").ok()?.flatten();
    let mut pids = pids.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
    pids.find(|pid| {
        let words = fs::read(format!("/proc/{pid}/cmdline")).unwrap_or_default();
        let mut words = words.split(|byte| *byte == 0);
        let place = fs::read_link(format!("/proc/{pid}/cwd"));
        words.next() == Some(APP.as_bytes())
            && words.any(|word| word == shard.as_bytes())
            && place.is_ok_and(|place| place == folder)
    })
}

#[test]
fn eight_shards_by_gnu_parallel_with_two_killed_are_the_whole() {
    let version = Command::new("parallel").arg("--version").output();
    if !version.is_ok_and(|v| v.stdout.starts_with(b"GNU parallel")) {
        skip::skip("GNU parallel is not installed");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().canonicalize().unwrap();
    let mut jobs = Command::new("parallel");
    jobs.args(["--will-cite", "--retries=3", "-j2", APP]);
    jobs.args(SWEEP).args(["--shard", "{}/8", "--out", "part-{}.csv", ":::"]);
    jobs.args((1..=8).map(|i| i.to_string()));
    jobs.current_dir(&folder).env("HOME", &folder).env("XDG_CONFIG_HOME", &folder);
    let mut jobs = jobs.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begun = Instant::now();
    let mut killed = HashSet::new();
    while killed.len() < 2 {
        assert!(begun.elapsed() < PATIENCE, "only {killed:?} killed");
        for i in (1..=8).filter(|i| i % 3 == 0) {
            let shard = format!("{i}/8");
            // It has begun, and has much to do yet: 60 rows and a heading.
            let there = rows(&folder.join(format!("part-{i}.csv")));
            if (10..50).contains(&there)
                && !killed.contains(&shard)
                && let Some(pid) = worker(&folder, &shard)
            {
                let kill = Command::new("kill").args(["-9", &pid.to_string()]).status();
                assert!(kill.unwrap().success());
                killed.insert(shard);
            }
        }
        thread::sleep(Duration::from_millis(1));
    }
    assert!(jobs.wait().unwrap().success());
    // As the guide says it.
    let together = Command::new("sh")
        .args(["-c", "grep -hv '^[#r]' part-*.csv | sort -t, -k1,1n"])
        .env("LC_ALL", "C")
        .current_dir(&folder)
        .output()
        .unwrap();
    let whole = Command::new(APP).args(SWEEP).output().unwrap();
    let whole = String::from_utf8(whole.stdout).unwrap();
    let whole: Vec<&str> = whole.lines().filter(|line| !line.starts_with(['#', 'r'])).collect();
    assert_eq!(whole.len(), 480);
    let together = String::from_utf8(together.stdout).unwrap();
    assert!(together.lines().eq(whole), "the parts are not the whole");
}
