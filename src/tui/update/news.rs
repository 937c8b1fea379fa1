//! What the worker of the form says, and that of the mesh error.

use std::sync::Arc;

use crate::study::{MeshError, Refusal};
use crate::tui::model::{Model, Run, Shown};
use crate::tui::view::heat::hottest;
use crate::tui::worker::Report;

/// Adds a mesh error to the answer on show, if it is that answer's.
pub(super) fn hear_mesh(model: &mut Model, report: Report<MeshError>) {
    let Report::Done(ticket, mesh) = report else {
        return;
    };
    if let (Ok(mesh), Some(shown)) = (*mesh, model.shown.as_mut())
        && shown.ticket == ticket
    {
        Arc::make_mut(&mut shown.answer).add(mesh);
    }
}

/// What the worker of the form says. Late news of superseded jobs is dropped.
pub(super) fn hear(model: &mut Model, report: Report) {
    let Run::Running(awaited, _) = model.run else {
        return;
    };
    match report {
        Report::Progress(ticket, share) if ticket == awaited => {
            model.run = Run::Running(ticket, Some(share));
        }
        Report::Done(ticket, answer) if ticket == awaited => match *answer {
            Ok(answer) => {
                model.run = Run::Settled;
                model.shown = Some(Shown {
                    ticket,
                    scenario: model.work.scenario.clone(),
                    hottest: hottest(&answer),
                    answer: Arc::new(answer),
                });
            }
            Err(Refusal::Cancelled) => {
                let text = "cancelled: the next edit simulates again";
                model.run = Run::Refused(text.to_owned());
            }
            Err(refusal) => model.run = Run::Refused(refusal.to_string()),
        },
        _ => {}
    }
}
