//! Frames as CSV, units in the header.

use crate::run::{kept::Frame, places::Region};
use std::io::Write;

/// Writes frames, one row a node.
pub struct FrameWriter<W: Write> {
    csv: csv::Writer<W>,
    written: usize,
}

impl<W: Write> FrameWriter<W> {
    /// Writes the heading.
    ///
    /// # Errors
    /// Whatever `out` reports.
    pub fn new(out: W) -> csv::Result<Self> {
        let mut csv = csv::Writer::from_writer(out);
        csv.write_record([
            "frame", "time_ms", "node", "region", "x_mm", "y_mm", "z_mm", "force_n",
        ])?;
        Ok(Self { csv, written: 0 })
    }

    /// Writes the next frame of an eye with nodes in these regions; gives how many there are now.
    ///
    /// # Errors
    /// Whatever `out` reports.
    pub fn write(&mut self, regions: &[Region], frame: &Frame) -> csv::Result<usize> {
        for (node, place) in frame.positions.iter().enumerate() {
            self.csv.write_record(&[
                self.written.to_string(),
                format!("{:.6}", frame.time * 1e3),
                node.to_string(),
                regions[node].name().to_owned(),
                format!("{:.7}", place.x * 1e3),
                format!("{:.7}", place.y * 1e3),
                format!("{:.7}", frame.aside.get(node).unwrap_or(&0.0) * 1e3),
                format!("{:.6e}", frame.forces[node]),
            ])?;
        }
        self.written += 1;
        Ok(self.written)
    }

    /// Hands on what is still held back.
    ///
    /// # Errors
    /// Whatever `out` reports.
    pub fn finish(mut self) -> csv::Result<()> {
        Ok(self.csv.flush()?)
    }
}
