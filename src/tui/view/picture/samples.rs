//! Shapes as labels of a fine grid of samples, and what most of the samples of a point show.

use crate::report::picture::{Part, Shape};
use crate::tui::view::picture::window::Window;

/// A grid over an area of cells.
pub(super) struct Samples {
    /// Samples across and down a point.
    fine: usize,
    width: usize,
    height: usize,
    labels: Vec<Part>,
}

impl Samples {
    /// The layers as points, so many across and down all and a cell.
    pub fn new(layers: &[Shape], window: &Window, [all, cell]: [(usize, usize); 2]) -> Self {
        // Of a large picture fewer samples tell as much.
        let fine = if all.0 * all.1 > 12_000 { 2 } else { 4 };
        let (width, height) = (all.0 * fine, all.1 * fine);
        let mut grid = Self { fine, width, height, labels: vec![Part::Sky; width * height] };
        for shape in layers {
            grid.fill(shape, window, cell);
        }
        grid
    }

    /// Fills what the rings of a shape go round, whichever way.
    fn fill(&mut self, shape: &Shape, window: &Window, (across, down): (usize, usize)) {
        let (across, down) = (across as f64, down as f64);
        let fine = self.fine as f64;
        let mut crossings: Vec<Vec<(f64, i32)>> = vec![Vec::new(); self.height];
        for ring in &shape.rings {
            let at = |i: usize| {
                let (x, y) = window.cell(ring[i % ring.len()]);
                (x * across * fine, y * down * fine)
            };
            for i in 0..ring.len() {
                let (a, b) = (at(i), at(i + 1));
                let (turn, low, high) = if a.1 < b.1 { (1, a, b) } else { (-1, b, a) };
                let row = |y: f64| (y - 0.5).ceil().clamp(0.0, self.height as f64) as usize;
                for (y, row) in crossings.iter_mut().enumerate().take(row(high.1)).skip(row(low.1))
                {
                    let share = (y as f64 + 0.5 - low.1) / (high.1 - low.1);
                    row.push((low.0 + share * (high.0 - low.0), turn));
                }
            }
        }
        for (y, row) in crossings.iter_mut().enumerate() {
            row.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut turns = 0;
            for ends in row.windows(2) {
                turns += ends[0].1;
                if turns != 0 {
                    let column = |x: f64| (x - 0.5).ceil().clamp(0.0, self.width as f64) as usize;
                    let (from, to) = (column(ends[0].0), column(ends[1].0));
                    let start = y * self.width;
                    let labels = &mut self.labels[start..start + self.width];
                    if shape.part == Part::Veil {
                        let veiled = |x: &usize| (x / self.fine + y / self.fine).is_multiple_of(2);
                        (from..to).filter(veiled).for_each(|x| labels[x] = Part::Object);
                    } else {
                        labels[from..to].fill(shape.part);
                    }
                }
            }
        }
    }

    /// What a point shows: most of its samples, where a thin part counts for more.
    pub fn point(&self, x: usize, y: usize) -> Part {
        let mut found: Vec<(Part, f64)> = Vec::new();
        for row in y * self.fine..(y + 1) * self.fine {
            let start = row * self.width + x * self.fine;
            for &part in &self.labels[start..start + self.fine] {
                let weight = match part {
                    Part::Retina => 1.25,
                    part if part.is_line() => 1.5,
                    _ => 1.0,
                };
                match found.iter_mut().find(|(known, _)| *known == part) {
                    Some((_, sum)) => *sum += weight,
                    None => found.push((part, weight)),
                }
            }
        }
        found.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(Part::Sky, |(part, _)| *part)
    }
}
