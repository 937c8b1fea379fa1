//! Recordings as CSV, units in the header.

use super::{Frame, Traces};
use crate::eye::{Eye, Monitor};
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
            "frame", "time_ms", "node", "region", "x_mm", "y_mm", "force_n",
        ])?;
        Ok(Self { csv, written: 0 })
    }

    /// Writes the next frame of `eye`; gives how many there are now.
    ///
    /// # Errors
    /// Whatever `out` reports.
    pub fn write(&mut self, eye: &Eye, frame: &Frame) -> csv::Result<usize> {
        for (node, place) in frame.positions.iter().enumerate() {
            self.csv.write_record(&[
                self.written.to_string(),
                format!("{:.6}", frame.time * 1e3),
                node.to_string(),
                eye.nodes[node].region.name().to_owned(),
                format!("{:.7}", place.x * 1e3),
                format!("{:.7}", place.y * 1e3),
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

/// Writes one row a step.
///
/// # Errors
/// Whatever `out` reports.
pub fn write_traces(traces: &Traces, out: impl Write) -> csv::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    let forces = Monitor::ALL.map(|m| format!("force_{}_n", m.name()));
    let mut header = vec!["time_ms", "load_n"];
    header.extend(forces.iter().map(String::as_str));
    header.extend([
        "apex_mm",
        "scleral_growth_percent",
        "meridian_growth_percent",
        "kinetic_j",
        "elastic_j",
        "dissipated_j",
        "work_j",
    ]);
    if !traces.pressure.is_empty() {
        header.extend(["pressure_mpa", "vitreous_area_ratio"]);
    }
    if !traces.contact_force.is_empty() {
        header.extend(["contact_force_n", "projectile_x_mm", "projectile_y_mm"]);
        header.extend(["projectile_vx_m_s", "projectile_vy_m_s"]);
    }
    csv.write_record(&header)?;
    for i in 0..traces.time.len() {
        let mut row = vec![
            format!("{:.9}", traces.time[i] * 1e3),
            format!("{:.6e}", traces.load[i]),
        ];
        row.extend(traces.force.iter().map(|f| format!("{:.9e}", f[i])));
        row.push(format!("{:.9e}", traces.apex[i] * 1e3));
        row.push(format!("{:.9e}", traces.shell_growth[i] * 1e2));
        row.push(format!("{:.9e}", traces.meridian_growth[i] * 1e2));
        for energy in [
            &traces.kinetic,
            &traces.elastic,
            &traces.dissipated,
            &traces.work,
        ] {
            row.push(format!("{:.9e}", energy[i]));
        }
        if let (Some(pressure), Some(ratio)) = (traces.pressure.get(i), traces.area_ratio.get(i)) {
            row.push(format!("{:.9e}", pressure * 1e-6));
            row.push(format!("{ratio:.12}"));
        }
        if let Some(force) = traces.contact_force.get(i) {
            let (place, velocity) = (traces.projectile[i], traces.projectile_velocity[i]);
            row.push(format!("{force:.9e}"));
            row.extend([place.x, place.y].map(|m| format!("{:.9e}", m * 1e3)));
            row.extend([velocity.x, velocity.y].map(|v| format!("{v:.9e}")));
        }
        csv.write_record(&row)?;
    }
    csv.flush()?;
    Ok(())
}
