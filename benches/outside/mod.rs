//! The plain loop in C, built by the compiler of the machine: what a user would write by hand.

use contrecoup::models::paper::case::PaperCase;
use std::fmt::Write as _;
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

const SOURCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/outside/plain.c");

/// A program that solves one case whenever it is asked to.
pub struct PlainC {
    child: Child,
    ask: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl PlainC {
    /// None where there is no C compiler.
    pub fn new(case: &PaperCase, step: f64) -> Option<Self> {
        let mut child =
            Command::new(compiled()?).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().ok()?;
        let mut ask = child.stdin.take()?;
        let answers = BufReader::new(child.stdout.take()?);
        ask.write_all(problem(case, step).as_bytes()).ok()?;
        Some(Self { child, ask, answers })
    }

    /// Solves the case once: the seconds it took, and the sum of all coordinates at the end, in m.
    pub fn solve(&mut self) -> Option<(f64, f64)> {
        self.ask.write_all(b"\n").ok()?;
        self.ask.flush().ok()?;
        let mut line = String::new();
        self.answers.read_line(&mut line).ok()?;
        let (seconds, sum) = line.trim().split_once(' ')?;
        Some((seconds.parse().ok()?, sum.parse().ok()?))
    }
}

impl Drop for PlainC {
    fn drop(&mut self) {
        // It may have ended by itself, which is as good.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn compiled() -> Option<PathBuf> {
    let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("plain-loop-in-c");
    let built = Command::new("cc")
        .args(["-O3", "-march=native", "-o"])
        .arg(&program)
        .args([SOURCE, "-lm"])
        .status();
    built.is_ok_and(|s| s.success()).then_some(program)
}

/// The case in the order in which the program reads it, steps and forces as `Plain::run` takes
/// them.
fn problem(case: &PaperCase, step: f64) -> String {
    let (eye, load, pulse) = (&case.eye, &case.load, &case.system.pulse);
    let segments = pulse.segments(case.window);
    let mut text = format!(
        "{} {} {} {}\n",
        eye.nodes.len(),
        eye.springs.len(),
        load.shares.len(),
        segments.len()
    );
    let mut line = |numbers: &[f64]| {
        for number in numbers {
            let _ = write!(text, "{number:.17e} ");
        }
        text.push('\n');
    };
    for node in &eye.nodes {
        let inverse_mass = if node.fixed() { 0.0 } else { 1.0 / node.mass };
        let place = node.position;
        line(&[inverse_mass, node.drag / node.mass, place.x, place.y]);
    }
    for spring in &eye.springs {
        line(&[spring.a as f64, spring.b as f64, spring.stiffness, spring.rest_length]);
    }
    for &(node, share) in &load.shares {
        line(&[node as f64, share * load.direction.x, share * load.direction.y]);
    }
    for segment in segments {
        let length = segment.end - segment.start;
        let steps = (length / step).ceil().max(1.0);
        let h = length / steps;
        line(&[steps, h]);
        let at = |i: usize| pulse.force(segment.piece, segment.start + h * i as f64);
        line(&(0..=steps as usize).map(at).collect::<Vec<f64>>());
    }
    text
}
