//! Where a point of the eye lies on the screen.

use crate::tui::view::raster::Raster;

/// From metres to dots.
pub(super) struct Projection {
    pub(super) centre: (f64, f64),
    pub(super) scale: (f64, f64),
    across: f64,
}

impl Projection {
    /// Half of the width and of the height that must be seen, in m.
    pub(super) fn new(raster: &Raster, (wide, high): (f64, f64)) -> Self {
        let (width, height) = raster.size();
        let (width, height) = (f64::from(width), f64::from(height));
        let aspect = raster.aspect();
        let across = ((width - 1.0) / 2.0 / wide).min((height - 1.0) * aspect / 2.0 / high);
        Self { centre: (width / 2.0, height / 2.0), scale: (across, across / aspect), across: wide }
    }

    /// In whole parts of a dot: what lies on the axis, between two rows of dots, stays in one of
    /// them whatever the round-off of its place, from frame to frame and from machine to machine.
    pub(super) fn dot(&self, x: f64, y: f64) -> (f64, f64) {
        const PARTS: f64 = 256.0;
        let whole = |dots: f64| (dots * PARTS).round() / PARTS;
        (whole(self.centre.0 + x * self.scale.0), whole(self.centre.1 - y * self.scale.1))
    }

    /// Whether cold fat would only blur the picture.
    pub(super) fn is_small(&self) -> bool {
        self.scale.0 * self.across < 32.0
    }
}
