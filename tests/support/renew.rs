//! Which figures and pictures are to be made again: `FIGURES=all`, or names with commas between
//! them.

/// Whether `name` is.
pub fn is_asked(name: &str) -> bool {
    let asked = std::env::var("FIGURES").unwrap_or_default();
    asked.split(',').any(|one| one == "all" || one == name)
}
