//! The stage: a scene, and everything that its recipes share at any pixels.

use super::geometry::DrawnFrame;
use super::recipe::{Geometry, Normals};
use super::surface::Surface;
use alloc::rc::Rc;
use alloc::vec::Vec;
use fastphong::frame::PreparedScene;
use fastphong::scene::Scene;
use glam::DVec3;
use std::cell::RefCell;
use std::collections::HashMap;

/// A scene that is drawn with mistakes, and everything that does not depend on pixels.
pub struct Stage<'a> {
    pub scene: &'a Scene,
    pub prepared: &'a PreparedScene,
    pub surface: &'a Surface<'a>,
    /// The lengths of light directions in the scene file; 1 for lights without an entry.
    pub light_lengths: &'a [f64],
    /// Frames that differ only in the cut of polygons serve many recipes.
    frames: RefCell<HashMap<Geometry, Option<Rc<DrawnFrame>>>>,
    normals: RefCell<HashMap<Normals, Rc<Vec<DVec3>>>>,
}

impl<'a> Stage<'a> {
    /// Makes the stage of a scene with one sample per pixel.
    pub fn new(
        scene: &'a Scene,
        prepared: &'a PreparedScene,
        surface: &'a Surface<'a>,
        light_lengths: &'a [f64],
    ) -> Stage<'a> {
        Stage {
            scene,
            prepared,
            surface,
            light_lengths,
            frames: RefCell::default(),
            normals: RefCell::default(),
        }
    }

    /// Returns the frame of a geometry, or `None` if it cannot be drawn.
    pub fn frame(&self, geometry: Geometry) -> Option<Rc<DrawnFrame>> {
        let plain = Geometry {
            cut: geometry.cut,
            ..Geometry::default()
        };
        if geometry != plain {
            return geometry.frame(self.prepared).map(Rc::new);
        }
        let mut frames = self.frames.borrow_mut();
        let known = frames.entry(geometry);
        known
            .or_insert_with(|| geometry.frame(self.prepared).map(Rc::new))
            .clone()
    }

    /// Returns the vertex normals that are computed in one of the ways.
    pub fn normals(&self, normals: Normals) -> Rc<Vec<DVec3>> {
        let mut all = self.normals.borrow_mut();
        let known = all.entry(normals);
        known
            .or_insert_with(|| Rc::new(self.surface.normals(normals)))
            .clone()
    }
}
