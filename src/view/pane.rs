//! One view under way: what walls, spheres and overlays are drawn on.

use glam::DVec3;
use ratatui::layout::Rect;

use super::{canvas::Canvas, projection::Camera, screen::Screen, shapes, side::Side};

/// A view and what is needed to draw on it.
pub(super) struct View<'a> {
    /// Which projection.
    pub(super) side: Side,
    /// The view's place on the screen, cells.
    pub(super) area: Rect,
    /// The map from metres to dots.
    pub(super) camera: Camera,
    /// The dots drawn so far.
    pub(super) canvas: Canvas,
    /// What is shown.
    pub(super) screen: &'a Screen<'a>,
}

impl View<'_> {
    /// Where a world point falls, dots.
    pub(super) fn project(&self, point: DVec3) -> shapes::Dots {
        self.camera.project(self.side, point, self.area)
    }
}
