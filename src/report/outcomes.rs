//! What was counted, as a page of the guide: by object, a row an injury.

use crate::injury::clinic::Setting;
use crate::injury::{Injury, KINDS, Outcome, outcomes};
use crate::report::format::{WIDTH, capital, wrapped};

/// Where it was counted, in words.
fn setting(of: &Outcome) -> &'static str {
    match of.setting {
        Setting::WalkIn => "all who came",
        Setting::Referred => "referred or admitted",
        Setting::Laboratory => "laboratory",
    }
}

fn rows(rows: &[&Outcome], text: &mut String) {
    for row in rows {
        let injury = row.injury().map_or("any of the retina", Injury::name);
        let fit = match row.fit.as_str() {
            "" => "",
            "more" => "; fitted",
            _ => "; fitted, of the first",
        };
        let (count, setting) = (row.count(), setting(row));
        let (counted, gathered, source) = (&row.counted, &row.gathered, &row.source);
        let line = format!("- {injury}: {count}, {setting} ({counted}{fit}). {source}. {gathered}");
        let mut lines = wrapped(&line, WIDTH - 2).into_iter();
        text.extend(lines.next().map(|line| line + "\n"));
        text.extend(lines.map(|line| format!("  {line}\n")));
    }
}

/// The page.
pub fn page() -> String {
    let about = "The points of 50 % of all risks are fitted to these counts (`contrecoup verify \
                 fit`). A count that is `derived` was not written but follows. Rows without \
                 `fitted` are for the reader: mixed objects, bounds, series of the same eyes.";
    let about = wrapped(about, WIDTH).join("\n");
    let mut text = format!("# Outcomes: what clinics and laboratories counted\n\n{about}\n");
    let all = outcomes();
    for (k, kind) in KINDS.iter().enumerate() {
        let own: Vec<&Outcome> = all.iter().filter(|row| row.kinds() == [k]).collect();
        text.extend(["\n## ", &capital(kind.name), "\n\n"]);
        rows(&own, &mut text);
    }
    let mut objects: Vec<&str> = Vec::new();
    for row in all.iter().filter(|row| row.kinds().len() != 1) {
        if !objects.contains(&row.object.as_str()) {
            objects.push(&row.object);
        }
    }
    for object in objects {
        text.extend(["\n## ", &capital(object), "\n\n"]);
        let own = |row: &&Outcome| row.kinds().len() != 1 && row.object == object;
        rows(&all.iter().filter(own).collect::<Vec<_>>(), &mut text);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_of_the_guide_is_the_table() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/guide/outcomes.md");
        if std::env::var_os("FIGURES").is_some() {
            std::fs::write(path, page()).unwrap();
        }
        assert_eq!(std::fs::read_to_string(path).unwrap(), page());
    }
}
