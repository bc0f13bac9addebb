//! Moving the objects of a prepared scene: only what depends on their transforms is computed anew.
//!
//! Frames share the geometry of the scene that they were made from. So a scene whose objects move
//! keeps two geometries and alternates between them: the last frame may still show one, while the
//! other changes.

use super::PreparedScene;
use super::prepare::{ModelNormals, NormalMap, bits_of_normals, reverse_corners};
use crate::frame::{FrameError, FrameItem, Geometry, PlacedModel, guard};
use crate::scene::Object;
use crate::sync::Arc;
use alloc::vec::Vec;
use core::ops::Range;
use glam::DAffine3;

/// The objects of a prepared scene, and what is needed to move them.
#[derive(Clone, Debug, Default)]
pub(super) struct Moving {
    /// The objects as they stand now.
    pub objects: Vec<Object>,
    /// The normals of each object in model space, once the object was moved.
    normals: Vec<Option<Arc<ModelNormals>>>,
    /// The geometry that was in use before the present one.
    spare: Option<Posed>,
}

/// A geometry, and the transforms that its objects have in it.
#[derive(Clone, Debug)]
struct Posed {
    geometry: Arc<Geometry>,
    transforms: Vec<DAffine3>,
}

/// Where an object's vertices, corners and polygons are in the geometry of its scene.
struct Place {
    vertices: Range<usize>,
    corners: Range<usize>,
    polygons: Range<usize>,
}

impl PreparedScene {
    /// Moves an object: sets its [`Object::transform`]. Objects count from 0, in the order of
    /// [`Scene::objects`](crate::scene::Scene).
    ///
    /// The time is proportional to this object's size, however large the others are. The next frame
    /// equals the frame of the scene prepared anew, bit for bit. The first call for an object costs
    /// as much as preparing it. Earlier frames do not change, so the first call also copies the
    /// geometry. From then on there are two, and frames that are made again and again
    /// ([`PreparedScene::frame_into`]) use them in turn.
    ///
    /// ```
    /// use fastphong::glam::{DAffine3, DVec3};
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    ///
    /// let mut scene = Scene::of_mesh(builtin("sphere").unwrap());
    /// scene.objects.push(scene.objects[0].clone());
    /// scene.objects[1].mesh = builtin("torus").unwrap().into();
    /// let mut prepared = scene.prepare().unwrap();
    /// let mut frame = prepared.frame().unwrap();
    /// for step in 0..3 {
    ///     scene.objects[1].transform = DAffine3::from_rotation_y(0.1 * f64::from(step));
    ///     prepared.set_transform(1, scene.objects[1].transform).unwrap();
    ///     prepared.frame_into(&mut frame).unwrap();
    ///     assert_eq!(frame.polygons(), scene.frame().unwrap().polygons());
    /// }
    /// ```
    ///
    /// # Errors
    /// [`FrameError`] as [`Scene::frame`](crate::scene::Scene::frame) would return it for the
    /// object: a transform that flattens it, a place out of range, or a vertex where a light
    /// stands. Also if there is no such object. The object then stays where it was.
    pub fn set_transform(&mut self, object: usize, transform: DAffine3) -> Result<(), FrameError> {
        self.check_transform(object, transform)?;
        let (object, index) = (&self.moving.objects[object], object);
        let normals = &mut self.moving.normals;
        normals.resize(self.moving.objects.len(), None);
        normals[index].get_or_insert_with(|| Arc::new(ModelNormals::new(object)));
        self.own_geometry();
        self.moving.objects[index].transform = transform;
        if let Some(geometry) = Arc::get_mut(&mut self.geometry) {
            let place = self.moving.place(index, geometry);
            // The words at both ends may hold bits of other objects, which come out as before.
            let words = place.polygons.start / 64..place.polygons.end.div_ceil(64);
            self.moving.pose(index, &self.table.turned, geometry, place);
            for word in words {
                self.table.has_normal[word] = bits_of_normals(&geometry.faces, word);
            }
        }
        Ok(())
    }

    /// Checks the arguments of [`PreparedScene::set_transform`].
    fn check_transform(&self, index: usize, transform: DAffine3) -> Result<(), FrameError> {
        let Some(object) = self.moving.objects.get(index) else {
            return Err(FrameError::Value {
                item: FrameItem::Scene,
                name: "the index of the object to move",
                value: index as f64,
                expected: "the index of an object, from 0",
            });
        };
        let moved = Object {
            transform,
            ..object.clone()
        };
        guard::object(index, &moved)?;
        let model = PlacedModel {
            transform: moved.positions_to_world(),
            ..self.geometry.models.objects[index]
        };
        guard::positions(index, &moved, &model)?;
        guard::lights_off_vertices(&self.settings, core::slice::from_ref(&moved))
    }

    /// Makes sure that no frame shares the geometry, and that all objects are in it where they
    /// stand now.
    fn own_geometry(&mut self) {
        if Arc::get_mut(&mut self.geometry).is_some() {
            return;
        }
        let moving = &mut self.moving;
        let transforms: Vec<DAffine3> = moving
            .objects
            .iter()
            .map(|object| object.transform)
            .collect();
        let spare = moving.spare.take();
        let unshared = spare.and_then(|mut spare| {
            Arc::get_mut(&mut spare.geometry)?;
            Some(spare)
        });
        let geometry = match unshared {
            Some(mut spare) => {
                if let Some(geometry) = Arc::get_mut(&mut spare.geometry) {
                    moving.catch_up(&spare.transforms, &self.table.turned, geometry);
                }
                spare.geometry
            }
            None => Arc::new(Geometry::clone(&self.geometry)),
        };
        let shared = core::mem::replace(&mut self.geometry, geometry);
        moving.spare = Some(Posed {
            geometry: shared,
            transforms,
        });
    }
}

impl Moving {
    pub fn new(objects: Vec<Object>) -> Self {
        Moving {
            objects,
            ..Moving::default()
        }
    }

    /// Moves the objects of a geometry that have moved since it was last in use.
    fn catch_up(&self, transforms: &[DAffine3], turned: &[u32], geometry: &mut Geometry) {
        let bits = |transform: &DAffine3| transform.to_cols_array().map(f64::to_bits);
        for (index, (object, before)) in self.objects.iter().zip(transforms).enumerate() {
            if bits(&object.transform) != bits(before) {
                let place = self.place(index, geometry);
                self.pose(index, turned, geometry, place);
            }
        }
    }

    /// Returns where an object is in the geometry.
    fn place(&self, index: usize, geometry: &Geometry) -> Place {
        let before = self.objects[..index].iter().map(|object| &object.mesh);
        let (corner, polygon) = before.fold((0, 0), |(corner, polygon), mesh| {
            (
                corner + mesh.corners().len(),
                polygon + mesh.polygon_count(),
            )
        });
        let mesh = &self.objects[index].mesh;
        let models = &geometry.models.objects;
        Place {
            vertices: index.checked_sub(1).map_or(0, |last| models[last].end)..models[index].end,
            corners: corner..corner + mesh.corners().len(),
            polygons: polygon..polygon + mesh.polygon_count(),
        }
    }

    /// Updates an object of a geometry to its transform: its normals, and the winding of its
    /// corners.
    fn pose(&self, index: usize, turned: &[u32], geometry: &mut Geometry, place: Place) {
        let (object, normals) = (&self.objects[index], &self.normals[index]);
        let Some(normals) = normals else {
            debug_assert!(false, "an object that moves has its normals");
            return;
        };
        let model = &mut geometry.models.objects[index];
        let was_mirrored = NormalMap::new(&model.transform).mirrored;
        model.transform = object.positions_to_world();
        let map = NormalMap::new(&object.transform);
        if map.mirrored != was_mirrored {
            let half = if geometry.two_sided {
                geometry.corners.len() / 2
            } else {
                geometry.corners.len()
            };
            // Without corners `half` is 0, and chunks must not be empty.
            for side in geometry.corners.chunks_exact_mut(half.max(1)) {
                reverse_corners(&object.mesh, &mut side[place.corners.clone()]);
            }
        }
        normals.vertices(&map, &mut geometry.normals[place.vertices]);
        let polygons = place.polygons.clone();
        map_faces(&map, normals, turned, &mut geometry.faces, polygons);
    }
}

/// Writes the normals of an object's polygons. Negates those of polygons whose corners have normals
/// on the other side.
fn map_faces(
    map: &NormalMap,
    normals: &ModelNormals,
    turned: &[u32],
    faces: &mut [[f32; 3]],
    polygons: Range<usize>,
) {
    map.polygons(&normals.polygons, &mut faces[polygons.clone()]);
    let first = turned.partition_point(|&p| (p as usize) < polygons.start);
    let here = turned[first..].iter().map(|&p| p as usize);
    for polygon in here.take_while(|&p| p < polygons.end) {
        faces[polygon] = faces[polygon].map(|n| -n);
    }
}
