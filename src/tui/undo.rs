//! What was there before, and what was there before it was taken back.
//!
//! Steps on one field in quick succession count as one change, so that holding an arrow key down
//! is undone by one press.

use std::time::Duration;

/// Changes closer together than this are one, if they are of the same thing.
const ONE_CHANGE: Duration = Duration::from_millis(800);
/// Changes that are remembered.
const MAX_CHANGES: usize = 200;

/// The past and the undone future of some state.
#[derive(Debug, Clone)]
pub struct History<T> {
    past: Vec<T>,
    future: Vec<T>,
    last: Option<(&'static str, Duration)>,
}

impl<T> Default for History<T> {
    fn default() -> Self {
        Self { past: Vec::new(), future: Vec::new(), last: None }
    }
}

impl<T> History<T> {
    /// `before` is about to be changed; `what` names the thing that changes, empty if this change
    /// stands for itself.
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

    /// Takes the last change back: gives what was there before it.
    ///
    /// # Errors
    /// Gives the present back where there is nothing to undo.
    pub fn undo(&mut self, present: T) -> Result<T, T> {
        Self::swap(&mut self.past, &mut self.future, &mut self.last, present)
    }

    /// Makes the last undone change again.
    ///
    /// # Errors
    /// Gives the present back where there is nothing to redo.
    pub fn redo(&mut self, present: T) -> Result<T, T> {
        Self::swap(&mut self.future, &mut self.past, &mut self.last, present)
    }

    fn swap(
        from: &mut Vec<T>,
        to: &mut Vec<T>,
        last: &mut Option<(&'static str, Duration)>,
        present: T,
    ) -> Result<T, T> {
        let Some(other) = from.pop() else {
            return Err(present);
        };
        *last = None;
        to.push(present);
        Ok(other)
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

    #[test]
    fn changes_are_undone_and_redone_in_order() {
        let mut history = History::default();
        history.record(1, "", SOON);
        history.record(2, "", SOON);
        assert_eq!(history.undo(3), Ok(2));
        assert_eq!(history.undo(2), Ok(1));
        assert_eq!(history.undo(1), Err(1));
        assert_eq!(history.redo(1), Ok(2));
        assert_eq!(history.redo(2), Ok(3));
        assert_eq!(history.redo(3), Err(3));
    }

    #[test]
    fn a_new_change_forgets_the_undone_ones() {
        let mut history = History::default();
        history.record(1, "", SOON);
        assert_eq!(history.undo(2), Ok(1));
        history.record(1, "", SOON);
        assert_eq!(history.redo(9), Err(9));
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
        assert_eq!(history.undo(12), Ok(11));
        assert_eq!(history.undo(11), Ok(10));
        assert_eq!(history.undo(10), Ok(0));
    }

    #[test]
    fn the_past_is_bounded() {
        let mut history = History::default();
        for i in 0..1000 {
            history.record(i, "", SOON);
        }
        assert_eq!(history.depth().0, MAX_CHANGES);
    }
}
