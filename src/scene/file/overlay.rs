//! One scene file over another: what flags say wins over what the file says.

use super::{CameraSection, SceneFile};

impl SceneFile {
    /// Replaces what `over` gives, key by key; lights and objects as whole lists.
    ///
    /// In the camera, what excludes each other replaces each other: see [`CameraSection::overlay`]. Meshes of `over` that
    /// came from a flag stay relative to the current directory.
    pub fn overlay(&mut self, over: SceneFile) {
        let below = std::mem::take(self);
        *self = SceneFile {
            title: over.title.or(below.title),
            description: over.description.or(below.description),
            ambient: over.ambient.or(below.ambient),
            interpolation: over.interpolation.or(below.interpolation),
            viewer: over.viewer.or(below.viewer),
            specular: over.specular.or(below.specular),
            shininess_for: over.shininess_for.or(below.shininess_for),
            specular_gate: over.specular_gate.or(below.specular_gate),
            cull: over.cull.or(below.cull),
            visibility: over.visibility.or(below.visibility),
            depth_bits: over.depth_bits.or(below.depth_bits),
            depth: over.depth.or(below.depth),
            clipping: over.clipping.or(below.clipping),
            two_sided: over.two_sided.or(below.two_sided),
            painter_key: over.painter_key.or(below.painter_key),
            image: over.image.or(&below.image),
            camera: below.camera.overlay(over.camera),
            material: over.material.or(&below.material),
            light: over.light.or(below.light),
            object: if over.object.is_empty() {
                below.object
            } else {
                over.object
            },
            source: below.source,
        };
    }
}

impl CameraSection {
    /// The camera with what `over` gives instead.
    ///
    /// A projection (`half_height` or `fovy`) replaces the other one; `half_height` replaces `fit` and the reverse; a place
    /// (`eye`) replaces `fit` and a direction, and a direction replaces a place. Near and far planes that were meant for
    /// the camera below are dropped when its place changes.
    pub fn overlay(self, over: CameraSection) -> CameraSection {
        let mut below = self;
        if over.half_height.is_some() || over.fovy.is_some() {
            below.half_height = None;
            below.fovy = None;
        }
        if over.half_height.is_some() {
            below.keep_direction_only();
        }
        if over.fit.is_some() {
            below.half_height = None;
        }
        let turns = over.direction.is_some() || over.azimuth.is_some() || over.elevation.is_some();
        if turns {
            below.eye = None;
            below.target = None;
            below.direction = None;
        }
        if over.direction.is_some() {
            below.azimuth = None;
            below.elevation = None;
        }
        if over.eye.is_some() {
            below.direction = None;
            below.azimuth = None;
            below.elevation = None;
            below.fit = None;
        }
        let moves = turns
            || over.eye.is_some()
            || over.target.is_some()
            || over.fit.is_some()
            || over.fovy.is_some();
        if moves {
            below.near = None;
            below.far = None;
        }
        over.or(&below)
    }

    /// Gives up `fit`; where an eye was given only for its direction, that direction is all that stays of it.
    fn keep_direction_only(&mut self) {
        if self.fit.take().is_none() {
            return;
        }
        if let Some(eye) = self.eye.take() {
            let target = self.target.take().map_or([0.0; 3], |target| target.value);
            let [x, y, z] = eye.value;
            self.direction = Some(super::value::Located {
                value: [x - target[0], y - target[1], z - target[2]],
                origin: eye.origin,
            });
        }
    }
}
