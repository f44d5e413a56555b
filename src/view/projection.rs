//! Metres to dots: one scale for both axes of both views, and a common x axis.

use glam::DVec3;
use ratatui::layout::Rect;

use super::{screen::ViewSettings, side::Side};
use crate::snapshot::Stage;

/// Dots kept free around the scene's view box at zoom 1, so that its walls are seen and the views do not touch.
const MARGIN: f64 = 2.0;

/// Dots of a cell from its left to its right. A cell is twice as high as wide, so that with 4 dots down a dot is square.
pub(super) const ACROSS: u16 = 2;
/// Dots of a cell from its top to its bottom.
pub(super) const DOWN: u16 = 4;

/// Where one looks, and how closely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Camera {
    /// World point in the middle of each view, m.
    pub(super) center: DVec3,
    /// Dots per metre.
    pub(super) scale: f64,
}

impl Camera {
    /// The camera for views of these sizes (cells); `followed` is the centre of the followed sphere, m.
    pub(super) fn new(settings: &ViewSettings, stage: &Stage, followed: Option<DVec3>, sizes: Sizes) -> Camera {
        let (min, max) = (stage.view.min, stage.view.max);
        let home = min + (max - min) * 0.5 + settings.pan;
        let center = followed.filter(|x| x.is_finite()).unwrap_or(home);
        let center = if center.is_finite() { center } else { DVec3::ZERO };
        Camera { center, scale: fit(max - min, sizes) * sane_zoom(settings.zoom) }
    }

    /// Where a world point falls in a view of the size of `canvas`, in dots: dot (i, j) has its centre at (i, j).
    pub(super) fn project(&self, side: Side, point: DVec3, canvas: Rect) -> (f64, f64) {
        let (width, height) = dots(canvas);
        let d = (point - self.center) * self.scale;
        let down = match side {
            Side::Side => -d.y,
            Side::Top => d.z,
        };
        ((width - 1.0) * 0.5 + d.x, (height - 1.0) * 0.5 + down)
    }

    /// What a view of the size of `canvas` shows, m: width along x, height along y, height along z.
    pub(super) fn span(&self, canvas: Rect) -> DVec3 {
        let (width, height) = dots(canvas);
        DVec3::new(width, height, height) / self.scale
    }
}

/// The view's size in dots.
pub(super) fn dots(canvas: Rect) -> (f64, f64) {
    (f64::from(canvas.width) * f64::from(ACROSS), f64::from(canvas.height) * f64::from(DOWN))
}

/// A zoom that can be multiplied with: finite, positive, within what f64 dots can still tell apart.
pub(super) fn sane_zoom(zoom: f64) -> f64 {
    if zoom.is_finite() && zoom > 0.0 { zoom.clamp(1e-9, 1e12) } else { 1.0 }
}

/// The sizes of the two views, cells: of equal width, so that they share the x axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sizes {
    /// The side view, x and y.
    pub(super) side: Rect,
    /// The top-down view, x and z.
    pub(super) top: Rect,
}

/// Dots per metre at zoom 1: the largest scale at which the box of this extent (m) fits both views, whether or not both are
/// shown, so that switching views does not change it.
pub(super) fn fit(extent: DVec3, sizes: Sizes) -> f64 {
    let inner = |size: f64| (size - 1.0 - 2.0 * MARGIN).max(1.0);
    let ((width, side), (_, top)) = (dots(sizes.side), dots(sizes.top));
    let scale = (inner(width) / extent.x).min(inner(side) / extent.y).min(inner(top) / extent.z);
    if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
}
