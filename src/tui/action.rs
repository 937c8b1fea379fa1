//! What a person can ask of the app, whichever key says so.

use super::screens::Screen;

/// Something asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Leave, after a question if work would be lost.
    Quit,
    /// Leave at once.
    Interrupt,
    /// Listen to the mouse, or no longer.
    Mouse,
    /// Stop until the shell says otherwise.
    Suspend,
    /// Draw everything afresh.
    Repaint,
    /// Show or hide the keys.
    Help,
    /// Switch to a screen.
    Show(Screen),
    /// The next pane of the screen.
    NextPane,
    /// The one before.
    PreviousPane,
    /// Take the last change back.
    Undo,
    /// Make it again.
    Redo,
    /// Ask for a name and save.
    Save,
    /// List the presets.
    Presets,
    /// One row up.
    Up,
    /// One row down.
    Down,
    /// Many rows up, or down.
    Page(bool),
    /// A step of the value, or of the cursor, down or up.
    Step(Step),
    /// Begin to type, or accept.
    Enter,
    /// Begin to type with this character.
    Type,
    /// Give up what is under way.
    Cancel,
    /// Show or hide the advanced fields.
    Advanced,
    /// Turn the blow on the dial.
    Turn(Step),
    /// Widen or narrow the loaded arc.
    Widen(Step),
    /// Play or pause.
    Play,
    /// To the first frame, or row.
    First,
    /// To the last.
    Last,
    /// Halve the speed.
    Slower,
    /// Double it.
    Faster,
    /// To the next peak.
    NextPeak,
    /// To the peak before.
    PreviousPeak,
    /// More displacement than there is.
    Exaggerate,
    /// Edges, nodes or outline.
    Detail,
    /// The next set of curves.
    Curves,
    /// Mark or unmark for the comparison.
    Mark,
    /// Sort by the chosen column.
    Sort,
    /// Measure speed against error.
    Measure,
    /// Another input on an axis of the map: across, or up.
    Axis(bool),
    /// Wider or narrower ranges of the map.
    Reach(bool),
    /// Yes to a question.
    Yes,
    /// No to it.
    No,
}

/// A step of a value or a cursor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Up, not down.
    pub up: bool,
    /// A large step.
    pub coarse: bool,
}

impl Step {
    /// A small step down.
    pub const LESS: Self = Self::new(false, false);
    /// A small step up.
    pub const MORE: Self = Self::new(true, false);
    /// A large step down.
    pub const MUCH_LESS: Self = Self::new(false, true);
    /// A large step up.
    pub const MUCH_MORE: Self = Self::new(true, true);

    const fn new(up: bool, coarse: bool) -> Self {
        Self { up, coarse }
    }

    /// 1 or -1.
    pub fn sign(self) -> f64 {
        if self.up { 1.0 } else { -1.0 }
    }
}
