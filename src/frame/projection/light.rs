//! The light on a frame's materials.

use crate::mesh::Material;
use crate::scene::{Light, Lighting, Place, Scene};
use alloc::vec::Vec;
use glam::DVec3;

impl Scene {
    /// Returns the lights, with positions relative to the eye as [`Frame::position`] gives those of vertices.
    fn lights_from_eye(&self) -> Vec<Light> {
        let from_eye = |light: &Light| match light.place {
            Place::Infinite(_) => *light,
            Place::Local(p) => Light {
                place: Place::Local(p - self.camera.eye),
                ..*light
            },
        };
        self.lights.iter().map(from_eye).collect()
    }

    /// Computes the light on each of `materials`.
    pub(super) fn light(&self, materials: &[Material], lightings: &mut Vec<Lighting>) {
        let (lights, view) = (self.lights_from_eye(), self.camera.view());
        lightings.clear();
        lightings.extend(
            materials
                .iter()
                .map(|material| self.lighting(material, &lights, view)),
        );
    }

    /// Returns the light on `material`; `lights` as [`Scene::lights_from_eye`] gives them.
    fn lighting(&self, material: &Material, lights: &[Light], view: DVec3) -> Lighting {
        let far = Lighting::new(material, self.ambient, lights, view);
        Lighting {
            shininess: self.specular.exponent(far.shininess, self.shininess_for),
            specular: self.specular,
            gate: self.gate,
            view: if self.local_viewer {
                Place::Local([0.0; 3])
            } else {
                far.view
            },
            ..far
        }
    }
}
