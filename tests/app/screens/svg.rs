//! A screen as a picture: the cells of a buffer as SVG.
//!
//! Braille, bars and lines are drawn as dots and strokes, so that they stand in their cells
//! whatever font a reader has; everything else is text, stretched to its cells.
//!
//! Left out: italics, blinking and wide characters, of which the app has none.

use std::collections::BTreeMap;
use std::fmt::Write;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};

/// Width and height of a cell in pixels.
const CELL: (f64, f64) = (8.0, 17.0);
const INK: &str = "#d0d0d0";
const PAPER: &str = "#16181d";
/// How much of its colour a dim cell keeps.
const DIM: f64 = 0.6;

/// The colours of the first sixteen numbers.
const SIXTEEN: [&str; 16] = [
    "#16181d", "#e06c75", "#98c379", "#d19a66", "#61afef", "#c678dd", "#56b6c2", "#d0d0d0",
    "#7f848e", "#ff7b86", "#b5e890", "#ffd580", "#82c8ff", "#e29bf2", "#7fe0ec", "#ffffff",
];

/// The colour of a number as xterm has it: sixteen, a cube of 6 x 6 x 6, and greys.
fn indexed(number: u8) -> String {
    let step = |level: u8| if level == 0 { 0 } else { 55 + 40 * level };
    match number {
        0..16 => SIXTEEN[usize::from(number)].to_owned(),
        16..232 => {
            let cube = number - 16;
            let [r, g, b] = [cube / 36, cube / 6 % 6, cube % 6].map(step);
            format!("#{r:02x}{g:02x}{b:02x}")
        }
        _ => {
            let grey = 8 + 10 * (number - 232);
            format!("#{grey:02x}{grey:02x}{grey:02x}")
        }
    }
}

fn hex(color: Color, default: &str) -> String {
    let named = |number: usize| SIXTEEN[number].to_owned();
    match color {
        Color::Reset => default.to_owned(),
        Color::Indexed(number) => indexed(number),
        Color::Rgb(r, g, b) => format!("#{r:02x}{g:02x}{b:02x}"),
        Color::Black => named(0),
        Color::Red => named(1),
        Color::Green => named(2),
        Color::Yellow => named(3),
        Color::Blue => named(4),
        Color::Magenta => named(5),
        Color::Cyan => named(6),
        Color::Gray => named(7),
        Color::DarkGray => named(8),
        Color::LightRed => named(9),
        Color::LightGreen => named(10),
        Color::LightYellow => named(11),
        Color::LightBlue => named(12),
        Color::LightMagenta => named(13),
        Color::LightCyan => named(14),
        Color::White => named(15),
    }
}

/// How a cell looks: ink, paper, bold.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Look {
    ink: String,
    paper: String,
    bold: bool,
    dim: bool,
}

fn look(cell: &Cell) -> Look {
    let (mut ink, mut paper) = (hex(cell.fg, INK), hex(cell.bg, PAPER));
    if cell.modifier.contains(Modifier::REVERSED) {
        std::mem::swap(&mut ink, &mut paper);
    }
    Look {
        ink,
        paper,
        bold: cell.modifier.contains(Modifier::BOLD),
        dim: cell.modifier.contains(Modifier::DIM),
    }
}

/// The dots of a braille character, as columns and rows of 2 x 4.
fn dots(symbol: char) -> Option<Vec<(u16, u16)>> {
    // The order of the bits: down the left, down the right, then the lowest of both.
    const PLACES: [(u16, u16); 8] =
        [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3)];
    let bits = u32::from(symbol).checked_sub(0x2800).filter(|bits| *bits < 256)?;
    let set = (0..8).filter(|bit| bits >> bit & 1 == 1);
    Some(set.map(|bit| PLACES[bit]).collect())
}

/// Where the strokes of a line or of a bar go within a cell, and how thick they are, in shares of
/// its height.
fn strokes(symbol: char) -> Option<(&'static [[f64; 4]], f64)> {
    const ACROSS: [f64; 4] = [0.0, 0.5, 1.0, 0.5];
    const HALF: [f64; 4] = [0.0, 0.5, 0.5, 0.5];
    const DOWN: [f64; 4] = [0.5, 0.0, 0.5, 1.0];
    match symbol {
        '─' => Some((&[ACROSS], 0.06)),
        '│' => Some((&[DOWN], 0.06)),
        '█' => Some((&[ACROSS], 0.8)),
        '░' => Some((&[ACROSS], 0.2)),
        '━' => Some((&[ACROSS], 0.12)),
        '╸' => Some((&[HALF], 0.12)),
        _ => None,
    }
}

/// The quarters of a block that are filled, as columns and rows of 2 x 2.
fn quarters(symbol: char) -> Option<Vec<(u16, u16)>> {
    const SIGNS: [char; 15] =
        [' ', '▘', '▝', '▀', '▖', '▌', '▞', '▛', '▗', '▚', '▐', '▜', '▄', '▙', '▟'];
    let mask = SIGNS[1..].iter().position(|sign| *sign == symbol)? + 1;
    let set = (0..4).filter(|bit| mask >> bit & 1 == 1);
    Some(set.map(|bit: u16| (bit % 2, bit / 2)).collect())
}

/// Draws a buffer.
pub fn svg(buffer: &Buffer, title: &str) -> String {
    let area = buffer.area;
    let size = (f64::from(area.width) * CELL.0, f64::from(area.height) * CELL.1);
    let mut paths: BTreeMap<(String, String, bool), String> = BTreeMap::new();
    let (mut papers, mut blocks): (BTreeMap<String, String>, BTreeMap<String, String>) =
        Default::default();
    let mut texts = String::new();
    for y in 0..area.height {
        let top = f64::from(y) * CELL.1;
        let mut x = 0;
        while x < area.width {
            let begin = x;
            let own = look(&buffer[(x, y)]);
            let mut run = String::new();
            while x < area.width && look(&buffer[(x, y)]) == own {
                let symbol = buffer[(x, y)].symbol().chars().next().unwrap_or(' ');
                let left = f64::from(x) * CELL.0;
                if let Some(dots) = dots(symbol) {
                    let path =
                        paths.entry((own.ink.clone(), "2.1".to_owned(), own.dim)).or_default();
                    for (column, row) in dots {
                        let at = (
                            left + (0.5 + f64::from(column)) * CELL.0 / 2.0,
                            top + (0.5 + f64::from(row)) * CELL.1 / 4.0,
                        );
                        let _ = write!(path, "M{:.0} {:.1}h0", at.0, at.1);
                    }
                    run.push(' ');
                } else if let Some(quarters) = quarters(symbol) {
                    let path = blocks.entry(own.ink.clone()).or_default();
                    for (column, row) in quarters {
                        let (wide, high) = (CELL.0 / 2.0, CELL.1 / 2.0);
                        let at = (left + f64::from(column) * wide, top + f64::from(row) * high);
                        let _ = write!(path, "M{} {}h{wide}v{high}h-{wide}z", at.0, at.1);
                    }
                    run.push(' ');
                } else if let Some((lines, thick)) = strokes(symbol) {
                    let key = (own.ink.clone(), format!("{:.1}", thick * CELL.1), own.dim);
                    let path = paths.entry(key).or_default();
                    for [x0, y0, x1, y1] in lines {
                        let point = |x: f64, y: f64| {
                            format!("{:.0} {:.1}", left + x * CELL.0, top + y * CELL.1)
                        };
                        let _ = write!(path, "M{}L{}", point(*x0, *y0), point(*x1, *y1));
                    }
                    run.push(' ');
                } else {
                    run.push(symbol);
                }
                x += 1;
            }
            let (left, width) = (f64::from(begin) * CELL.0, f64::from(x - begin) * CELL.0);
            if own.paper != PAPER {
                let path = papers.entry(own.paper.clone()).or_default();
                let _ = write!(path, "M{left} {top}h{width}v{}h-{width}z", CELL.1);
            }
            texts += &words(&run, &own, left, top);
        }
    }
    let filled = |(colour, path)| format!("<path fill=\"{colour}\" d=\"{path}\"/>\n");
    let filled: String = papers.into_iter().chain(blocks).map(filled).collect();
    let mut drawn = String::new();
    for ((ink, thick, dim), path) in paths {
        // Bars and lines meet their neighbours; dots are round.
        let cap = if path.contains('h') { "round" } else { "butt" };
        let faint = if dim { format!(r#" opacity="{DIM}""#) } else { String::new() };
        let _ = writeln!(
            drawn,
            r#"<path fill="none" stroke="{ink}" stroke-width="{thick}" stroke-linecap="{cap}"{faint} d="{path}"/>"#
        );
    }
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-8 -8 {} {}" role="img">
<title>{title}</title>
<rect x="-8" y="-8" width="{}" height="{}" rx="6" fill="{PAPER}"/>
<g shape-rendering="crispEdges">
{filled}</g>
{drawn}<g font-family="ui-monospace, Menlo, Consolas, 'DejaVu Sans Mono', monospace" font-size="13" xml:space="preserve">
{texts}</g>
</svg>
"#,
        size.0 + 16.0,
        size.1 + 16.0,
        size.0 + 16.0,
        size.1 + 16.0
    )
}

/// The words of a run of one look, each stretched to its cells.
fn words(run: &str, look: &Look, left: f64, top: f64) -> String {
    let mut text = String::new();
    let cells: Vec<char> = run.chars().collect();
    let mut at = 0;
    while at < cells.len() {
        if cells[at] == ' ' {
            at += 1;
            continue;
        }
        // Single spaces stay within; wider gaps part.
        let mut end = at + 1;
        while end < cells.len()
            && !(cells[end] == ' ' && cells.get(end + 1).is_none_or(|next| *next == ' '))
        {
            end += 1;
        }
        let word: String = cells[at..end].iter().collect();
        let word = word.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        let place = (left + at as f64 * CELL.0, top + 0.75 * CELL.1, (end - at) as f64 * CELL.0);
        let bold = if look.bold { r#" font-weight="bold""# } else { "" };
        let faint = if look.dim { format!(r#" opacity="{DIM}""#) } else { String::new() };
        let _ = writeln!(
            text,
            r#"<text x="{}" y="{:.1}" textLength="{}" lengthAdjust="spacingAndGlyphs" fill="{}"{bold}{faint}>{word}</text>"#,
            place.0, place.1, place.2, look.ink
        );
        at = end;
    }
    text
}
