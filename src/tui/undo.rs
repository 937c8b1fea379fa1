//! What was there before, and what was there before it was taken back.
//!
//! Quick steps on one field count as one change, so that one press undoes a held arrow key.

use std::time::Duration;

/// Changes closer together than this are one, if they are of the same thing.
const ONE_CHANGE: Duration = Duration::from_millis(800);
/// Changes that are remembered.
const MAX_CHANGES: usize = 200;

/// The past and the undone future of some state.
#[derive(Debug, Clone, Default)]
pub struct History<T> {
    past: Vec<T>,
    future: Vec<T>,
    last: Option<(&'static str, Duration)>,
}

impl<T> History<T> {
    /// `before` is about to change in `what`, empty if this change stands for itself.
    pub fn record(&mut self, before: T, what: &'static str, now: Duration) {
        self.future.clear();
        let same = self.last.is_some_and(|(last, at)| {
            last == what && !what.is_empty() && now.saturating_sub(at) < ONE_CHANGE
        });
        self.last = Some((what, now));
        if !same {
            if self.past.len() == MAX_CHANGES {
                self.past.remove(0);
            }
            self.past.push(before);
        }
    }

    /// Takes the last change back, or makes it again: gives what was there, if there is one.
    pub fn travel(&mut self, back: bool, present: T) -> Option<T> {
        let (mut from, mut to) = (&mut self.past, &mut self.future);
        if !back {
            (from, to) = (to, from);
        }
        let other = from.pop()?;
        to.push(present);
        self.last = None;
        Some(other)
    }

    /// Changes everything that is remembered. What comes next stands for itself.
    pub fn amend(&mut self, change: impl FnMut(&mut T)) {
        self.last = None;
        self.past.iter_mut().chain(&mut self.future).for_each(change);
    }

    /// How many changes can be undone and redone.
    pub fn depth(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOON: Duration = Duration::from_millis(100);

    /// A past of so many changes, the next of which finds this number.
    fn changed(times: i32) -> History<i32> {
        let mut history = History::default();
        (0..times).for_each(|i| history.record(i, "", SOON));
        history
    }

    #[test]
    fn changes_are_undone_and_redone_in_order_and_a_new_one_forgets_the_undone() {
        let mut history = changed(2);
        let mut went = |back, present| history.travel(back, present);
        assert_eq!([went(true, 2), went(true, 1), went(true, 0)], [Some(1), Some(0), None]);
        assert_eq!([went(false, 0), went(false, 1), went(false, 2)], [Some(1), Some(2), None]);
        assert_eq!(history.travel(true, 2), Some(1));
        history.record(1, "", SOON);
        assert_eq!(history.travel(false, 9), None);
    }

    #[test]
    fn a_held_key_is_one_change_and_a_pause_begins_another() {
        let mut history = History::default();
        for i in 0..10 {
            history.record(i, "force", SOON * i);
        }
        assert_eq!(history.depth().0, 1);
        history.record(10, "force", Duration::from_secs(60));
        history.record(11, "angle", Duration::from_secs(60));
        assert_eq!(history.depth().0, 3);
        let undone = [12, 11, 10].map(|present| history.travel(true, present));
        assert_eq!(undone, [Some(11), Some(10), Some(0)]);
    }

    #[test]
    fn the_past_is_bounded() {
        assert_eq!(changed(1000).depth().0, MAX_CHANGES);
    }
}
