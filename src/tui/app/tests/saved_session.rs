//! That a session is found again as it was.

use super::*;
use crate::tui::saved_session::SavedSession;

#[test]
fn what_is_written_reads_back_with_its_changes() {
    let mut app = opened();
    let read = |app: &App| SavedSession::read(&SavedSession::of(app).text().unwrap()).unwrap();
    assert_eq!(read(&app).1, None);
    app.model.work.scenario = find("squash-ball").unwrap().scenario().unwrap();
    app.screen = 2;
    let (saved, changed) = read(&app);
    assert_eq!((saved.screen(), saved.source.as_str()), (2, "paper-300n"));
    assert_eq!(changed.as_ref(), Some(&app.model.work.scenario));
    assert_eq!(saved, SavedSession::of(&app));
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
    assert_eq!(SavedSession::read(&other).unwrap().0.screen(), 0);
}
