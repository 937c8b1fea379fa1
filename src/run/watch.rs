//! Who looks on while a run goes through its window.

use std::ops::ControlFlow;

/// Is told the share of the window that has been simulated, now and then, and may stop the run.
pub type Watch<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// A watch that lets everything run.
pub fn unwatched(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// What a watch says that stops a run on some condition.
pub fn stop_if(condition: bool) -> ControlFlow<()> {
    if condition { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
