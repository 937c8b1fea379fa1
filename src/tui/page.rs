//! A page of one blow or several, written for a browser on another thread.

use std::sync::Arc;

use crate::answer::solve::Answer;
use crate::many::comparison::{Entry, Found};
use crate::report::page::html;
use crate::run::{refusal::Refusal, watch::Watch};
use crate::scenario::Scenario;
use crate::tui::{request::TaskQuestion, task::Task};

pub struct WritePage {
    /// What its file's name begins with.
    pub stem: String,
    /// Each blow: its source, what was simulated, and what came of it.
    pub blows: Vec<(String, Scenario, Arc<Answer>)>,
    /// What repeats the page, if anything does.
    pub command: Option<String>,
}

impl TaskQuestion for WritePage {
    type Answer = String;

    fn answer(&self, watch: Watch) -> Result<String, Refusal> {
        let entry = |(source, scenario, answer): &(String, Scenario, Arc<Answer>)| {
            let found = Found::Answer((**answer).clone());
            Entry { found, ..Entry::new(source, scenario) }
        };
        let entries: Vec<_> = self.blows.iter().map(entry).collect();
        let page = html::page(&entries, self.command.as_deref(), watch);
        page.continue_value().ok_or(Refusal::Cancelled)
    }
}

/// How far a page is, while one is being written.
pub fn writing(task: &Task<WritePage>) -> Option<String> {
    let job = task.job.as_ref()?;
    Some(match job.question.blows.len() {
        1 => "writing a page".to_owned(),
        count => format!(
            "writing a page: blow {} of {count}",
            1 + (job.pace.unwrap_or_default().share * count as f64).round() as usize
        ),
    })
}
