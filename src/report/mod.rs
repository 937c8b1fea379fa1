//! Results for people and for programs. It only prints what it is given.

pub mod accuracy;
pub mod bone;
pub mod claims;
pub mod command;
pub mod compare;
pub mod ensemble;
pub mod experiments;
pub mod figure;
pub mod first_page;
pub mod format;
pub mod hard_cases;
pub mod json;
pub mod ladder;
pub mod look_for;
pub mod outcome_fit;
#[cfg(test)]
mod outcomes;
pub mod pace;
pub mod page;
pub mod picture;
pub mod risks;
pub mod sentence;
pub mod sweep;
pub mod text;
pub mod threshold;
pub mod tissue_fit;

/// The commit that was built, where whoever built it said so.
pub fn commit() -> Option<&'static str> {
    said(option_env!("CONTRECOUP_COMMIT"))
}

/// The program that answered, which every JSON object names.
pub(crate) fn program() -> serde_json::Value {
    serde_json::json!({ "version": env!("CARGO_PKG_VERSION"), "commit": commit() })
}

fn said(commit: Option<&str>) -> Option<&str> {
    commit.filter(|commit| !commit.is_empty())
}

#[cfg(test)]
mod tests {
    use super::said;

    #[test]
    fn a_commit_of_no_letters_is_none() {
        assert_eq!(["", "1a2b3c4"].map(|commit| said(Some(commit))), [None, Some("1a2b3c4")]);
    }
}
