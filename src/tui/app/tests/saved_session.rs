//! That a session is found again as it was.

use super::*;
use crate::tui::saved_session::SavedSession;

#[test]
fn what_is_written_reads_back_with_its_changes() {
    let mut app = opened();
    assert_eq!(SavedSession::of(&app).changed, None);
    app.model.work.scenario = find("squash-ball").unwrap().scenario().unwrap();
    app.screen = 2;
    let saved = SavedSession::of(&app);
    assert_eq!((saved.screen, saved.source.as_str()), (2, "paper-300n"));
    assert_eq!(saved.changed.as_ref(), Some(&app.model.work.scenario));
    assert_eq!(SavedSession::read(&saved.text().unwrap()), Ok(saved));
}

#[test]
fn a_damaged_file_is_explained() {
    let whole = SavedSession::of(&opened()).text().unwrap();
    for damaged in
        ["", "(", &whole[..whole.len() / 2], &whole.replace("None", "Some(\"(name: 1)\")")]
    {
        assert!(SavedSession::read(damaged).is_err(), "{damaged}");
    }
    // A screen that is no more is no reason to lose the work.
    let other = whole.replace("main", "mean");
    assert_eq!(SavedSession::read(&other).unwrap().screen, 0);
}
