//! Curves on axes, as SVG inside a page.

use std::ops::Range;

use plotters::prelude::*;

use crate::answer::solve::Answer;
use crate::many::comparison::Entry;
use crate::plain_text::printable;
use crate::report::format::trimmed;
use crate::run::trace::{OtherTrace, TRACES, Trace};
use crate::run::{quantity::Quantity, result_trace::Group};

const SIZE: (u32, u32) = (460, 210);
/// Points of a curve, beyond which each stands for the extremes of several.
const MOST_POINTS: usize = 300;
/// Colours that people tell apart whatever their sight (Okabe and Ito).
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

/// What a curve is called, and its points.
type Curve = (String, Vec<(f64, f64)>);

#[derive(Default)]
pub struct PageChart {
    pub across: &'static str,
    pub up: String,
    curves: Vec<Curve>,
    /// Points that stand out, each in the colour of its curve.
    marks: Vec<(usize, (f64, f64))>,
}

/// The range of numbers, 0 among them, with some room above.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let finite = values.filter(|value| value.is_finite());
    let (low, high) = finite.fold((0.0_f64, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
    let span = if high > low { high - low } else { 1.0 };
    let low = if low < 0.0 { low - 0.04 * span } else { 0.0 };
    low..high.max(low + span) + 0.04 * span
}

impl PageChart {
    fn over_time(up: &str, curves: Vec<Curve>) -> Self {
        Self { across: "ms", up: up.to_owned(), curves, marks: Vec::new() }
    }

    /// Draws it; nothing if there is nothing to draw.
    pub fn svg(&self) -> Option<String> {
        self.curves.iter().find(|(_, points)| !points.is_empty())?;
        let mut text = String::new();
        // A string takes whatever is drawn.
        self.draw(&mut text).ok()?;
        // Within a page the width is that of its column.
        let (width, height) = SIZE;
        let fixed = format!("<svg width=\"{width}\" height=\"{height}\"");
        Some(text.replacen(&fixed, "<svg", 1))
    }

    /// The names of its curves with their colours, to stand beside it; none of a single curve.
    pub fn names(&self) -> Vec<(&str, String)> {
        let css = |RGBColor(r, g, b): &RGBColor| format!("color:rgb({r},{g},{b})");
        let coloured = self.curves.iter().zip(COLOURS.iter().cycle());
        let named = coloured.map(|((name, _), colour)| (name.as_str(), css(colour)));
        named.filter(|_| self.curves.len() > 1).collect()
    }

    fn draw(&self, text: &mut String) -> Result<(), Box<dyn std::error::Error + '_>> {
        let points = || self.curves.iter().flat_map(|(_, points)| points);
        let marks = || self.marks.iter().map(|(_, point)| point);
        let across = points().chain(marks()).map(|(x, _)| *x);
        let across = across.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        let up = range(points().chain(marks()).map(|(_, y)| *y));
        let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
        let mut chart = ChartBuilder::on(&root)
            .margin(6)
            .x_label_area_size(32)
            .y_label_area_size(52)
            .build_cartesian_2d(across.0..across.1, up)?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12))
            .x_desc(self.across)
            .y_desc(&self.up)
            .x_labels(8)
            .y_labels(5)
            .x_label_formatter(&|x| short(*x))
            .y_label_formatter(&|y| short(*y))
            .draw()?;
        for ((_, points), colour) in self.curves.iter().zip(COLOURS.iter().cycle()) {
            let points = points.iter().copied();
            chart.draw_series(LineSeries::new(points, colour.stroke_width(2)))?;
        }
        let dot = |&(curve, point): &(usize, _)| Circle::new(point, 4, COLOURS[curve].filled());
        chart.draw_series(self.marks.iter().map(dot))?;
        root.present()?;
        Ok(())
    }
}

fn short(value: f64) -> String {
    if value.abs() < 1e-12 { "0".to_owned() } else { trimmed(value) }
}

/// The course of something in an answer, in ms and its unit, thinned without losing a peak.
fn curve(answer: &Answer, course: Trace) -> Option<Curve> {
    let traces = answer.run.traces.as_ref()?;
    let (row, values) = (course.row(), course.values(traces));
    values.iter().find(|value| **value != 0.0)?;
    let all: Vec<(f64, f64)> =
        traces.time.iter().zip(values).map(|(t, value)| (t * 1e3, value * row.factor)).collect();
    let each = (2 * all.len()).div_ceil(MOST_POINTS).max(1);
    let mut points = Vec::new();
    for part in all.chunks(each) {
        let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let mut ends: Vec<_> = part.iter().min_by(by).into_iter().collect();
        ends.extend(part.iter().max_by(by));
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        ends.dedup();
        points.extend(ends.into_iter().copied());
    }
    Some((course.label(traces).to_owned(), points))
}

/// What drives the eye, and forces of nodes, which would be flat lines beside that of an object.
pub fn forces(answer: &Answer) -> PageChart {
    let hit = answer.result(Quantity::Contact).is_some();
    let nodes = TRACES.iter().copied();
    let nodes = nodes.filter(|course| !hit && course.row().place.0 == Group::NodeForces);
    let courses = [Trace::Other(OtherTrace::Drive)].into_iter().chain(nodes);
    let curves = courses.filter_map(|course| curve(answer, course)).collect();
    PageChart::over_time("force, N", curves)
}

/// The pressure where the eye has one, else how far the apex moved.
pub fn motion(answer: &Answer) -> PageChart {
    let of = |of: &Quantity| Some((of.row(), curve(answer, Trace::Of(*of))?));
    let found = [Quantity::Pressure, Quantity::Apex].iter().find_map(of);
    let up = found.as_ref().map(|(row, _)| format!("{}, {}", row.label, row.unit));
    let curves = found.into_iter().map(|(_, curve)| curve).collect();
    PageChart::over_time(&up.unwrap_or_default(), curves)
}

/// What drives the eye in each of several answers.
pub fn drives(entries: &[Entry]) -> PageChart {
    let one = |entry: &Entry| {
        let (_, points) = curve(entry.answer()?, Trace::Other(OtherTrace::Drive))?;
        Some((printable(&entry.name).into_owned(), points))
    };
    PageChart::over_time("force on the eye, N", entries.iter().filter_map(one).collect())
}

/// The curve of each injury, and the blow, which lies beside it where published energies count.
pub fn injuries(answer: &Answer) -> PageChart {
    let (mut curves, mut marks) = (Vec::new(), Vec::new());
    // The gravest first, and no more than can be told apart.
    let Some(blow) = &answer.case.blow else { return PageChart::default() };
    for (i, risk) in answer.risks().iter().take(COLOURS.len()).enumerate() {
        let point = |k: u32| {
            let share = 0.02 * f64::from(k);
            (share, 100.0 * blow.point(risk.injury).share(share))
        };
        curves.push((risk.injury.name().to_owned(), (0..=100).map(point).collect()));
        marks.push((i, (risk.of_half.min(2.0), 100.0 * risk.hit.told)));
    }
    let across = "what the tissue felt, as a share of what hurts half of all eyes";
    PageChart { across, up: "risk, %".to_owned(), curves, marks }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chart_is_drawn_with_its_names_and_nothing_is_drawn_of_nothing() {
        let chart = |points: Vec<(f64, f64)>| {
            let (curves, marks) = (vec![("a < b".to_owned(), points)], vec![(0, (1.0, 2.0))]);
            PageChart { across: "ms", up: "force, N".to_owned(), curves, marks }
        };
        let svg = chart(vec![(0.0, 0.0), (1.0, 2.0)]).svg().unwrap();
        assert!(svg.starts_with("<svg viewBox=") && svg.contains("force, N"));
        assert!(!svg.contains("a &lt; b"), "a name over the curves hides them: {svg}");
        assert!(chart(Vec::new()).svg().is_none());
    }
}
