//! The light on a frame's materials.

use crate::mesh::Material;
use crate::scene::direction::as_unit;
use crate::scene::{Light, Lighting, Place, Scene};
use alloc::vec::Vec;
use glam::DVec3;

impl Scene {
    /// Returns the lights with unit vectors as directions. Positions are relative to `origin`, as
    /// in [`Frame::position`].
    fn lights_from(&self, origin: DVec3) -> Vec<Light> {
        let from_origin = |light: &Light| Light {
            place: match light.place {
                Place::Infinite(to) => Place::Infinite(as_unit(to)),
                Place::Local(p) => Place::Local(p - origin),
            },
            ..*light
        };
        self.lights.iter().map(from_origin).collect()
    }

    /// Computes the light on each of `materials`, with positions relative to `origin`.
    pub(super) fn light(
        &self,
        materials: &[Material],
        origin: DVec3,
        lightings: &mut Vec<Lighting>,
    ) {
        let lights = self.lights_from(origin);
        let view = if self.local_viewer {
            Place::Local(self.camera.eye - origin)
        } else {
            Place::Infinite(self.camera.view())
        };
        lightings.clear();
        lightings.extend(
            materials
                .iter()
                .map(|material| self.lighting(material, &lights, view)),
        );
    }

    /// Returns the light on `material`. `lights` come from [`Scene::lights_from`].
    fn lighting(&self, material: &Material, lights: &[Light], view: Place<DVec3>) -> Lighting {
        let far = Lighting::new(material, self.ambient, lights, self.camera.view());
        Lighting {
            shininess: self.specular.exponent(far.shininess, self.shininess_for),
            specular: self.specular,
            gate: self.gate,
            view: view.map(|v| v.as_vec3().to_array()),
            ..far
        }
    }
}
