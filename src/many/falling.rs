//! Where a harder blow does less: blows that are the same but for their speed, or force.
//!
//! An injury falls where its tissue felt less by more than the step errors of both blows, and its
//! risk is less by [`LEAST`] too: a wave more or less moves what no reader sees.
//!
//! Left out: why it falls (bone may stop what is faster sooner, a ball may slip off), and of one
//! blow by itself whether it does: that takes another run.

use crate::injury::Injury;
use crate::many::sweep::{Sweep, SweepRow};
use crate::many::threshold::usual;
use crate::run::{quantity::Quantity, results::Results};
use crate::scenario::{Scenario, doubt::number, fields, set::put_number};
use std::collections::VecDeque;

/// Neighbours that lie more rows apart are not compared.
const FARTHEST: usize = 4096;
/// A smaller loss of risk is none, in % of eyes.
const LEAST: f64 = 1.0;

/// An injury that is likelier after the weaker of two blows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// The injury.
    pub injury: Injury,
    /// Its risk after the weaker blow and after the harder one, in %.
    pub risks: (f64, f64),
}

/// What falls from the weaker of two blows to the harder one; `error` gives what both may be off
/// by in a result, in % of it.
pub fn falls(
    (weaker, harder): (&Results, &Results),
    error: impl Fn(Quantity) -> Option<f64>,
) -> Vec<Fall> {
    let falls = |injury: &Injury| {
        let (risk, felt) = (injury.result(), injury.measure());
        let risks = (weaker[risk]?, harder[risk]?);
        let less = harder[felt]? < weaker[felt]? * (1.0 - 0.01 * error(felt)?);
        (less && risks.0 - risks.1 >= LEAST).then_some(Fall { injury: *injury, risks })
    };
    Injury::ALL.iter().filter_map(falls).collect()
}

/// The rows of a sweep in which a harder blow does less than its neighbour in the grid.
pub struct FallingRows<'a> {
    sweep: &'a Sweep,
    /// The place of the axis of strength, and how many rows lie between neighbours on it.
    axis: Option<(usize, usize)>,
    /// The rows that have neighbours yet to come.
    rows: VecDeque<SweepRow>,
    /// How many there are.
    pub count: usize,
    /// The first of them with its weaker neighbour and what falls.
    pub first: Option<(usize, usize, Fall)>,
}

impl<'a> FallingRows<'a> {
    /// Of rows that are taken in their order, of one shard or of all.
    pub fn new(sweep: &'a Sweep) -> Self {
        let strength = usual(sweep.base()).0;
        let at = sweep.axes().iter().position(|axis| axis.path == strength);
        let rest = |at: usize| sweep.axes()[at + 1..].iter().map(|axis| axis.values.len());
        let axis = at.map(|at| (at, rest(at).product())).filter(|(_, apart)| *apart <= FARTHEST);
        Self { sweep, axis, rows: VecDeque::new(), count: 0, first: None }
    }

    /// Takes the next row.
    pub fn take(&mut self, row: &SweepRow) {
        let Some((axis, apart)) = self.axis else { return };
        let is_near = |earlier: &SweepRow| earlier.number + apart >= row.number;
        while self.rows.front().is_some_and(|earlier| !is_near(earlier)) {
            self.rows.pop_front();
        }
        let begins = (row.number / apart).is_multiple_of(self.sweep.axes()[axis].values.len());
        let before = self.rows.front().filter(|earlier| earlier.number + apart == row.number);
        if let Some(before) = before.filter(|_| !begins) {
            let strength = |row: &SweepRow| row.values[axis].parse::<f64>().ok();
            let rises = strength(before) < strength(row);
            let (weaker, harder) = if rises { (before, row) } else { (row, before) };
            if let (Ok(a), Ok(b)) = (&weaker.outcome, &harder.outcome)
                && let (Some(of_a), Some(of_b)) = (a.check, b.check)
                && let [fall, ..] =
                    falls((&a.values, &b.values), |_| Some(of_a.last + of_b.last))[..]
            {
                self.count += 1;
                self.first.get_or_insert((harder.number, weaker.number, fall));
            }
        }
        self.rows.push_back(row.clone());
    }
}

/// How strong a blow is, in the unit of the field that says so.
pub fn strength(scenario: &Scenario) -> Option<f64> {
    Some(number(fields::find(usual(scenario).0)?, scenario)?.0)
}

/// Whether two blows are the same but for their strength and their names.
pub fn is_alike(a: &Scenario, b: &Scenario) -> bool {
    let bare = |scenario: &Scenario| {
        let mut bare = Scenario { name: String::new(), ..scenario.clone() };
        if let Some(field) = fields::find(usual(scenario).0) {
            put_number(&mut bare, field, 1.0);
        }
        bare
    };
    bare(a) == bare(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::brief::{BriefAnswer, Check};
    use crate::many::sweep::SweepAxis;
    use crate::run::flags::FlagKinds;
    use crate::scenario::library::tests::preset;

    #[test]
    fn rows_of_a_sweep_are_set_beside_the_next_weaker_one() {
        let axes = ["speed=60,20,40", "offset_mm=0,3"].map(|axis| SweepAxis::read(axis).unwrap());
        let sweep = Sweep::new(preset("bb-62", &[]), axes.to_vec()).unwrap();
        let mut falling = FallingRows::new(&sweep);
        // Risk and what was felt in %, by speed and offset: at 3 mm it falls from 20 to 60 m/s.
        for (number, felt) in [40.0, 10.0, 20.0, 30.0, 30.0, 31.0].into_iter().enumerate() {
            let mut values = Results::default();
            values[Injury::Hyphema.measure()] = Some(felt);
            values[Injury::Hyphema.result()] = Some(felt);
            let (first, tried) = (1.0, 1e-6);
            let (last, leading) = (first, first);
            let check = Check { first, last, leading, missed: false, tried, good_step: tried };
            let flags = FlagKinds::default();
            let answer = BriefAnswer { values, flags, check: Some(check), ranges: None };
            let values = sweep.values(number).into_iter().map(str::to_owned).collect();
            falling.take(&SweepRow { number, values, outcome: Ok(answer) });
        }
        assert_eq!(falling.count, 1);
        let fall = Fall { injury: Injury::Hyphema, risks: (30.0, 10.0) };
        assert_eq!(falling.first, Some((1, 3, fall)));
    }

    #[test]
    fn an_injury_falls_where_it_felt_less_by_more_than_the_error() {
        let of = |felt, risk| {
            let mut results = Results::default();
            results[Injury::Hyphema.measure()] = Some(felt);
            results[Injury::Hyphema.result()] = Some(risk);
            results
        };
        let (weaker, harder) = (of(1.0, 30.0), of(0.9, 20.0));
        let found = |error| falls((&weaker, &harder), |_| Some(error));
        assert_eq!(found(5.0), [Fall { injury: Injury::Hyphema, risks: (30.0, 20.0) }]);
        assert_eq!(found(15.0), [], "the error holds it");
        assert_eq!(falls((&harder, &weaker), |_| Some(5.0)), [], "it rises");
        assert_eq!(falls((&of(1.0, 1.2), &of(0.5, 0.3)), |_| Some(5.0)), [], "nobody sees it");
        assert_eq!(falls((&weaker, &harder), |_| None), [], "nothing is known of its error");
    }

    #[test]
    fn blows_are_alike_but_for_speed_and_name() {
        let (bb, fast) = (preset("bb-62", &[]), preset("bb-62", &[("speed", "80"), ("name", "x")]));
        assert!(is_alike(&bb, &fast) && strength(&bb) < strength(&fast));
        assert!(!is_alike(&bb, &preset("bb-62", &[("angle_deg", "10")])));
        assert!(!is_alike(&bb, &preset("paper-300n", &[])));
    }
}
