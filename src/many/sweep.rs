//! A grid of runs over some fields of a scenario.
//!
//! Rows are numbered from 0 with the last axis the fastest. Shard i of n (from 1) holds the rows r
//! with r mod n = i - 1, so all shards together are the whole. Every row is checked for its step
//! error and refined to [`crate::answer::brief::promise_percent`]; what is refused is a row too.
//!
//! Left out: axes that move together. A row sets one value of each axis, in the order of the axes.

use crate::answer::brief::{BriefAnswer, checked};
use crate::run::{quantity::Quantity, refusal::Refusal, refusal::unstopped, watch::Watch};
use crate::scenario::{CheckedScenario, Scenario, fields, load::to_ron, problem::Problem};
use crate::scenario::{problem::ScenarioError, set::full_path, set::in_order};
use crate::scenario::{set::set_one_of_several, set::settle};

/// Most rows of a grid.
pub const MAX_ROWS: usize = 10_000_000;
/// Most values of one axis.
pub const MAX_VALUES: usize = 100_000;

/// One field and the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepAxis {
    /// Dotted path of the field.
    pub path: String,
    /// Its values, as they would be typed.
    pub values: Vec<String>,
}

/// `from` to `to` in `count` equal steps, ends included, without the dust of binary fractions.
pub fn spaced(from: f64, to: f64, count: usize) -> Vec<f64> {
    let at = |i: usize| {
        let share = i as f64 / count.saturating_sub(1).max(1) as f64;
        let value = from * (1.0 - share) + to * share;
        // Twelve digits: more would show what 0.1 + 0.2 is.
        format!("{value:.11e}").parse().unwrap_or(value)
    };
    (0..count).map(at).collect()
}

impl SweepAxis {
    /// Reads `path=from:to:n` or `path=a,b,c`.
    ///
    /// # Errors
    /// Says what was expected.
    pub fn read(typed: &str) -> Result<Self, String> {
        let wanted = "expected FIELD=FROM:TO:COUNT or FIELD=A,B,C, as in impact.force_n=100:500:5";
        let (path, text) = typed.split_once('=').ok_or(wanted)?;
        let (path, text) = (path.trim().to_owned(), text.trim());
        // A clock shows an hour as 7:30; a list of such has commas.
        let is_list = text.contains(',') || path.ends_with("clock");
        let mut values: Vec<String> = match text.split(':').collect::<Vec<_>>()[..] {
            [from, to, count] if !text.contains(',') => {
                let number = |text: &str| text.trim().parse().ok().filter(|n: &f64| n.is_finite());
                let (from, to) = number(from).zip(number(to)).ok_or(wanted)?;
                let count = count.trim().parse().ok().filter(|n| (1..=MAX_VALUES).contains(n));
                let count = count.ok_or(format!("the count must be 1 to {MAX_VALUES}"))?;
                if count == 1 && from != to {
                    return Err("a count of 1 leaves no room for two ends".to_owned());
                }
                spaced(from, to, count).iter().map(f64::to_string).collect()
            }
            ref parts if is_list || parts.len() == 1 => {
                text.split(',').map(|v| v.trim().to_owned()).collect()
            }
            _ => return Err(wanted.to_owned()),
        };
        if path.is_empty() || values.iter().any(String::is_empty) {
            return Err(wanted.to_owned());
        }
        if values.len() > MAX_VALUES {
            return Err(format!("at most {MAX_VALUES} values"));
        }
        values.shrink_to_fit();
        Ok(Self { path, values })
    }
}

/// A scenario and the axes of its grid.
#[derive(Debug, Clone)]
pub struct Sweep {
    scenario: Scenario,
    axes: Vec<SweepAxis>,
    /// What files of curves held that stand by their names on an axis.
    files: String,
}

/// One row.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRow {
    /// Its number.
    pub number: usize,
    /// The value of each axis.
    pub values: Vec<String>,
    /// The answer, or why there is none.
    pub outcome: Result<BriefAnswer, String>,
}

impl Sweep {
    /// A grid of checked axes. Values are written as the field itself writes them.
    ///
    /// # Errors
    /// Where a field is not there or given twice, a value is not allowed by itself, or there are
    /// too many rows.
    pub fn new(scenario: Scenario, mut axes: Vec<SweepAxis>) -> Result<Self, ScenarioError> {
        let (mut rows, mut files) = (1_usize, String::new());
        for i in 0..axes.len() {
            let path = full_path(&scenario, &axes[i].path).to_owned();
            axes[i].path.clone_from(&path);
            if axes[..i].iter().any(|axis| axis.path == path) {
                return Err(Problem::new(path, "is varied twice").into());
            }
            for value in &mut axes[i].values {
                let mut changed = scenario.clone();
                set_one_of_several(&mut changed, &path, value)?;
                let plain = fields::find(&path).and_then(|field| field.text(&changed));
                // The word for a recorded curve does not say which; the name of its file does.
                let says_all = |plain: &String| {
                    let mut again = scenario.clone();
                    set_one_of_several(&mut again, &path, plain).is_ok() && again == changed
                };
                match plain.filter(says_all) {
                    Some(plain) => *value = plain,
                    None => files += &to_ron(&changed),
                }
            }
            rows = rows.saturating_mul(axes[i].values.len());
        }
        if rows > MAX_ROWS {
            let paths: Vec<_> = axes.iter().map(|axis| axis.path.as_str()).collect();
            let counts: Vec<_> = axes.iter().map(|axis| axis.values.len().to_string()).collect();
            let (paths, counts) = (paths.join(" and "), counts.join(" x "));
            let message = format!("{counts} = {rows} rows are too many: allowed up to {MAX_ROWS}");
            return Err(Problem::new(paths, message).into());
        }
        Ok(Self { scenario, axes, files })
    }

    /// The axes.
    pub fn axes(&self) -> &[SweepAxis] {
        &self.axes
    }

    /// What every row changes.
    pub fn base(&self) -> &Scenario {
        &self.scenario
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// The value of each axis in a row.
    pub fn values(&self, row: usize) -> Vec<&str> {
        let mut stride = self.rows();
        let values = self.axes.iter().map(|axis| {
            stride /= axis.values.len();
            axis.values[row / stride % axis.values.len()].as_str()
        });
        values.collect()
    }

    /// The scenario of a row.
    ///
    /// # Errors
    /// Where the values together are not allowed.
    pub fn scenario(&self, row: usize) -> Result<CheckedScenario, ScenarioError> {
        let mut scenario = self.scenario.clone();
        let mut changes: Vec<(&SweepAxis, &str)> = self.axes.iter().zip(self.values(row)).collect();
        in_order(&scenario, &mut changes, |(axis, _)| &axis.path);
        for (axis, value) in changes {
            set_one_of_several(&mut scenario, &axis.path, value)?;
        }
        settle(&mut scenario);
        scenario.check()
    }

    /// Runs a row; nothing if the watch stopped it.
    pub fn run(&self, number: usize, watch: Watch) -> Option<SweepRow> {
        let scenario = self.scenario(number).map_err(Refusal::from);
        let outcome = unstopped(scenario.and_then(|scenario| checked(&scenario, watch)))?;
        let outcome = outcome.map_err(|refusal| refusal.to_string());
        let values = self.values(number).into_iter().map(str::to_owned).collect();
        Some(SweepRow { number, values, outcome })
    }

    /// What tells this sweep from any other: FNV-1a of scenario, grid, results and version.
    pub fn fingerprint(&self) -> u64 {
        let mut text = to_ron(&self.scenario) + &self.files;
        text.extend(self.axes.iter().map(|axis| format!("{}={:?}\n", axis.path, axis.values)));
        let keys = Quantity::ALL.iter().map(|quantity| quantity.key());
        text.extend(keys.chain([env!("CARGO_PKG_VERSION")]).flat_map(|part| [part, "\n"]));
        fnv1a(&text)
    }
}

/// The 64-bit hash FNV-1a of a text, the same on every machine.
pub fn fnv1a(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(axes: &[&str]) -> Result<Sweep, ScenarioError> {
        let axes = axes.iter().map(|a| SweepAxis::read(a).unwrap()).collect();
        let scenario = Scenario { window_ms: Some(0.3), ..Scenario::default() };
        Sweep::new(scenario, axes)
    }

    #[test]
    fn axes_are_read_as_ranges_and_lists() {
        let values = |text: &str| SweepAxis::read(text).unwrap().values;
        assert_eq!(values("a=0:0.3:4"), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(values("a=5:-5:3"), ["5", "0", "-5"]);
        assert_eq!(values("a=2:2:1"), ["2"]);
        assert_eq!(values("a=x, y"), ["x", "y"]);
        assert_eq!(values("angle_clock=1:30, 2:30"), ["1:30", "2:30"]);
        assert_eq!(values("angle_clock=7:30"), ["7:30"]);
        assert_eq!(values("angle_clock=1:2:3"), ["1", "1.5", "2"]);
        for bad in ["", "=", "=1:2", "=1:2:0", "=1:2:x", "=1:2:1", "=1,,2", "=nan:1:2"] {
            assert!(SweepAxis::read(&format!("a{bad}")).is_err(), "{bad}");
        }
        assert!(SweepAxis::read("=1").is_err());
    }

    #[test]
    fn rows_go_through_the_grid_with_the_last_axis_fastest() {
        let axes = ["impact.force_n=100:300:3", "impact.shape=triangle,half-sine"];
        let sweep = sweep(&axes).unwrap();
        assert_eq!(sweep.rows(), 6);
        assert_eq!(sweep.values(0), ["100", "Triangle"]);
        assert_eq!(sweep.values(3), ["200", "HalfSine"]);
    }

    #[test]
    fn what_is_varied_twice_and_too_many_rows_are_refused() {
        let refused = |axes: &[&str]| sweep(axes).unwrap_err().to_string();
        assert!(refused(&["window_ms=1,2", "window=3"]).contains("twice"));
        assert_eq!(
            refused(&["window_ms=1:2:9999", "impact.force_n=1:2:9999"]),
            "window_ms and impact.force_n: 9999 x 9999 = 99980001 rows are too many: allowed up to \
             10000000"
        );
    }

    #[test]
    fn fingerprints_tell_sweeps_apart() {
        let of = |axes: &[&str]| sweep(axes).unwrap().fingerprint();
        let one = of(&["impact.force_n=100:300:3"]);
        assert_eq!(one, of(&["impact.force_n=100, 200, 3e2"]));
        assert_eq!(one, of(&["force=100:300:3"]));
        assert_ne!(one, of(&["impact.force_n=100:300:4"]));
        assert_ne!(one, of(&["window_ms=1:3:3"]));
    }
}
