//! From a scene to a frame: transformed, projected, culled, clipped and snapped.

mod light;
mod ndc_cube;
mod side;

use crate::clip::{Corner, Cut, Plane, clip};
use crate::frame::{ClipCorner, Frame, FrameBuilder, FrameError, FrameStats, SubPixel, Vertex};
use crate::lighting::Material;
use crate::mesh::PolygonMesh;
use crate::mesh::newell::{polygon_normal, unit_normal};
use crate::mesh::vertex_normals::{VertexNormals, vertex_normals};
use crate::scene::{Clipping, Culling, DepthBuffer, DepthSource, HiddenSurfaces, Interpolation, Object, Scene};
use alloc::vec;
use alloc::vec::Vec;
use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};
use side::{Side, eye_side};

impl Scene {
    /// The scene as its camera sees it: projected polygons and the light on them.
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    ///
    /// let scene = Scene::of_mesh(builtin("sphere?rings=16&segments=32").unwrap());
    /// let frame = scene.frame().unwrap();
    /// assert!(frame.polygons().len() > 100 && frame.stats().culled > 100);
    /// ```
    ///
    /// # Errors
    /// [`FrameError`] when the picture's size, the camera or the number of lights is outside its range.
    pub fn frame(&self) -> Result<Frame, FrameError> {
        let mut projection = Projection::new(self)?;
        for object in &self.objects {
            projection.object(object)?;
        }
        projection.finish()
    }
}

const NO_VERTEX: u32 = u32::MAX;

/// A position in clip space and on the picture, and the planes that it is beyond.
#[derive(Clone, Copy)]
struct Place {
    clip: DVec4,
    /// Column and row; means nothing beyond a plane.
    snapped: [SubPixel; 2],
    /// One bit a side of the view: left, right, bottom, top, near, far.
    beyond_view: u8,
    /// One bit a plane of [`Projection::planes`].
    beyond_planes: u8,
}

struct Projection<'a> {
    scene: &'a Scene,
    /// Samples a row, and rows of them: what coordinates count.
    width: u32,
    height: u32,
    clip_matrix: DMat4,
    /// Near and far, then the four sides of the guard band.
    planes: [Plane; 6],
    builder: FrameBuilder,
    stats: FrameStats,
    vertex_count: u32,
    polygon_count: u32,
    /// Whether anything is to be interpolated with 1/w.
    needs_inv_w: bool,
}

/// One object's mesh in clip space, and the frame's vertices that were made of it.
struct Projected<'a> {
    mesh: &'a PolygonMesh,
    normals: VertexNormals,
    places: Vec<Place>,
    transform: DAffine3,
    normal_matrix: DMat3,
    mirrored: bool,
    /// Material of the frame by material of the mesh; the last is for polygons without one.
    materials: Vec<u32>,
    /// The first frame vertex at each position, and for each frame vertex of this object (its normal, its side, the next
    /// one).
    first_vertex: Vec<u32>,
    vertices: Vec<(u32, Side, u32)>,
    base: u32,
}

impl<'a> Projection<'a> {
    fn new(scene: &'a Scene) -> Result<Self, FrameError> {
        let sides = 1..=Scene::MAX_SIDE;
        if !sides.contains(&scene.width) || !sides.contains(&scene.height) {
            return Err(FrameError::Size { width: scene.width, height: scene.height });
        }
        let samples = scene.samples;
        let [width, height] = [scene.width, scene.height].map(|side| side.saturating_mul(samples));
        if ![1, 2, 4, 8].contains(&samples) || !sides.contains(&width) || !sides.contains(&height) {
            return Err(FrameError::Samples { samples });
        }
        let clip_matrix = scene.camera.clip_matrix(f64::from(scene.width) / f64::from(scene.height));
        let ordered = scene.camera.near < scene.camera.far;
        if !clip_matrix.is_finite() || !scene.camera.view().is_finite() || !ordered {
            return Err(FrameError::Camera);
        }
        let mut builder = FrameBuilder::new(width, height);
        builder
            .samples(samples)
            .background(scene.background)
            .eye(scene.camera.eye.to_array())
            .interpolation(scene.interpolation)
            .hidden_surfaces(scene.hidden_surfaces)
            .clipping(scene.clipping)
            .depth_range(scene.camera.near_to_far())
            .encoding(scene.encoding);
        // On the picture the guard band reaches one longest side beyond its edges: x/w within ±reach.
        let reach = |side: u32| 1.0 + 2.0 * f64::from(Scene::MAX_SIDE) / f64::from(side);
        let (x, y) = (DVec4::X, DVec4::Y);
        let (w_x, w_y) = (DVec4::W * reach(width), DVec4::W * reach(height));
        let guard = |normal| Plane { normal, in_front: true };
        let planes = [
            Plane { normal: DVec4::Z, in_front: false },
            guard(DVec4::W - DVec4::Z),
            guard(w_x + x),
            guard(w_x - x),
            guard(w_y + y),
            guard(w_y - y),
        ];
        let stats = FrameStats::default();
        let per_sample = |buffer: DepthBuffer| buffer.source == DepthSource::PerSample;
        let needs_inv_w = scene.interpolation == Interpolation::Perspective
            || matches!(scene.hidden_surfaces, HiddenSurfaces::ZBuffer(buffer) if per_sample(buffer));
        Ok(Projection {
            scene,
            width,
            height,
            clip_matrix,
            planes,
            builder,
            stats,
            vertex_count: 0,
            polygon_count: 0,
            needs_inv_w,
        })
    }

    fn finish(mut self) -> Result<Frame, FrameError> {
        self.builder.stats(self.stats);
        self.builder.finish()
    }

    fn object(&mut self, object: &Object) -> Result<(), FrameError> {
        let mut projected = self.project(object);
        if let Some(index) = projected.places.iter().position(|p| !p.clip.is_finite()) {
            return Err(FrameError::Vertex { index });
        }
        let mut corners = Vec::new();
        for polygon in 0..projected.mesh.polygon_count() {
            corners.clear();
            corners.extend(projected.mesh.corner_range(polygon));
            if projected.mirrored {
                corners.reverse();
            }
            self.polygon(&mut projected, polygon, &corners);
            self.polygon_count += 1;
        }
        Ok(())
    }

    fn project<'m>(&mut self, object: &'m Object) -> Projected<'m> {
        let mesh: &PolygonMesh = &object.mesh;
        let matrix = self.clip_matrix * DMat4::from(object.transform);
        let places = mesh.positions().iter().map(|p| self.place(matrix * p.as_dvec3().extend(1.0))).collect();
        let linear = object.transform.matrix3;
        let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
        let determinant = x.dot(y.cross(z));
        // The inverse transpose is the cofactor matrix over the determinant: its sign is enough, normals are
        // normalised, and a singular matrix still has cofactors.
        let sign = if determinant < 0.0 { -1.0 } else { 1.0 };
        let normal_matrix = DMat3::from_cols(y.cross(z) * sign, z.cross(x) * sign, x.cross(y) * sign);
        let own = object.material.as_ref();
        let view = self.scene.camera.view();
        let lights = self.scene.lights_from_eye();
        let default = Material::default();
        let materials = mesh.materials().iter().chain([&default]).map(|material| {
            let material = own.unwrap_or(material);
            self.builder.lighting(self.scene.lighting(material, &lights, view))
        });
        Projected {
            materials: materials.collect(),
            normals: vertex_normals(mesh, object.normals),
            places,
            transform: object.transform,
            normal_matrix,
            mirrored: determinant < 0.0,
            first_vertex: vec![NO_VERTEX; mesh.positions().len()],
            vertices: Vec::new(),
            base: self.vertex_count,
            mesh,
        }
    }

    /// Adds one polygon, given by the places of its corners in the mesh's list of corners.
    fn polygon(&mut self, projected: &mut Projected<'_>, polygon: usize, corners: &[usize]) {
        self.stats.polygons += 1;
        let mesh = projected.mesh;
        let place = |&corner: &usize| &projected.places[mesh.corners()[corner] as usize];
        if corners.iter().map(place).fold(u8::MAX, |all, place| all & place.beyond_view) != 0 {
            self.stats.outside += 1;
            return;
        }
        // Newell's sum is one of cross products, which the cofactor matrix carries to world space.
        let Some(face) = unit_normal(projected.normal_matrix * polygon_normal(mesh, polygon)) else {
            self.stats.zero_area += 1;
            return;
        };
        let cut = corners.iter().map(place).any(|place| place.beyond_planes != 0);
        if cut && self.scene.clipping == Clipping::NdcCube {
            self.stats.unprojected += 1;
            return;
        }
        let material = projected.materials[mesh.polygon_material(polygon).unwrap_or(mesh.materials().len())];
        if cut {
            self.stats.clipped += 1;
            let side = self.side(eye_side(corners.iter().map(|corner| place(corner).clip)) < 0.0);
            self.clipped(projected, corners, material, side, side.face(face));
            return;
        }
        let area = doubled_area(corners.iter().map(|corner| place(corner).snapped));
        if !self.is_drawn(area) {
            return;
        }
        // y points downward on the picture: what runs clockwise there has an area over 0.
        let side = self.side(area > 0);
        let vertices: Vec<u32> = corners.iter().map(|&corner| self.vertex(projected, corner, material, side)).collect();
        self.builder.polygon(&vertices, side.face(face), self.polygon_count);
    }

    fn place(&self, clip: DVec4) -> Place {
        if self.scene.clipping == Clipping::NdcCube {
            return self.place_unclipped(clip);
        }
        let bits = |beyond: &[bool]| beyond.iter().rev().fold(0, |bits, &b| bits << 1 | u8::from(b));
        let DVec4 { x, y, z, w } = clip;
        let beyond_view = bits(&[x < -w, x > w, y < -w, y > w, z < 0.0, z > w]);
        let beyond_planes = bits(&self.planes.map(|plane| plane.normal.dot(clip) < 0.0));
        let snapped = if beyond_planes == 0 { self.snap(clip) } else { [SubPixel::ZERO; 2] };
        Place { clip, snapped, beyond_view, beyond_planes }
    }

    /// The side by which a polygon is lit.
    fn side(&self, seen_from_behind: bool) -> Side {
        if self.scene.two_sided && seen_from_behind { Side::Back } else { Side::Front }
    }

    /// Whether a polygon of this signed area on the picture is drawn; counts it if not.
    fn is_drawn(&mut self, area: i128) -> bool {
        let culled = match self.scene.culling {
            Culling::Back => area > 0,
            Culling::Front => area < 0,
            Culling::None => false,
        };
        self.stats.culled += usize::from(culled);
        self.stats.zero_area += usize::from(area == 0);
        !culled && area != 0
    }

    /// The frame's vertex for a corner of the mesh: one for each position, normal, material and side.
    fn vertex(&mut self, projected: &mut Projected<'_>, corner: usize, material: u32, side: Side) -> u32 {
        let position = projected.mesh.corners()[corner] as usize;
        let normal = projected.normals.corners[corner];
        let mut candidate = projected.first_vertex[position];
        while candidate != NO_VERTEX {
            let (its_normal, its_side, next) = projected.vertices[candidate as usize];
            let number = projected.base + candidate;
            if (its_normal, its_side) == (normal, side) && self.builder.vertex_at(number).material == material {
                return number;
            }
            candidate = next;
        }
        let clip = projected.places[position].clip;
        let direction = projected.normal_matrix * projected.normals.values[normal as usize].as_dvec3();
        let vertex = self.projected_vertex(clip, side.turn(direction.normalize_or(DVec3::Z)), material);
        let number = self.add(projected, vertex, (normal, side, projected.first_vertex[position]));
        let in_world = projected.transform.transform_point3(projected.mesh.positions()[position].as_dvec3());
        self.builder.position(number, (in_world - self.scene.camera.eye).as_vec3().to_array());
        if let Some(colour) = projected.mesh.colours().get(position) {
            self.builder.colour(number, colour.to_array());
        }
        projected.first_vertex[position] = number - projected.base;
        number
    }

    fn add(&mut self, projected: &mut Projected<'_>, vertex: Vertex, entry: (u32, Side, u32)) -> u32 {
        self.vertex_count += 1;
        projected.vertices.push(entry);
        self.builder.vertex(vertex)
    }

    /// A vertex from clip space. Behind the eye, where only its attributes matter, it stands in the first corner.
    fn projected_vertex(&self, clip: DVec4, normal: DVec3, material: u32) -> Vertex {
        let normal = normal.as_vec3().to_array();
        let on_picture = self.planes.iter().all(|plane| plane.normal.dot(clip) >= -1e-9 * clip.abs().max_element());
        let clipped = self.scene.clipping == Clipping::Planes;
        if clipped && (!on_picture || clip.w <= 0.0) {
            return Vertex { x: SubPixel::ZERO, y: SubPixel::ZERO, depth: 0.0, inv_w: 1.0, normal, material };
        }
        let [x, y] = self.snap(clip);
        let inv_w = if self.needs_inv_w { self.weight(clip.w) } else { 1.0 };
        Vertex { x, y, depth: (clip.z / clip.w) as f32, inv_w, normal, material }
    }

    /// 1/w, scaled to 1 at the near plane.
    fn weight(&self, w: f64) -> f32 {
        match self.scene.camera.projection {
            crate::camera::Projection::Orthographic { .. } => 1.0,
            crate::camera::Projection::Perspective { .. } => (self.scene.camera.near / w) as f32,
        }
    }

    /// Column and row, to the nearest 1/256 pixel.
    fn snap(&self, clip: DVec4) -> [SubPixel; 2] {
        let column = (clip.x / clip.w * 0.5 + 0.5) * f64::from(self.width);
        let row = (0.5 - clip.y / clip.w * 0.5) * f64::from(self.height);
        // To the nearest, halves to even; positions inside the guard band are far from the ends of the type.
        let nearest = |pixels: f64| SubPixel::from_bits(libm::rint(pixels * 256.0) as i32);
        [nearest(column), nearest(row)]
    }

    /// Adds what of a polygon is inside all planes.
    fn clipped(&mut self, projected: &mut Projected<'_>, corners: &[usize], material: u32, side: Side, face: [f32; 3]) {
        let corners = corners.iter().map(|&corner| {
            let vertex = self.vertex(projected, corner, material, side);
            Corner { position: projected.places[projected.mesh.corners()[corner] as usize].clip, vertex }
        });
        let mut pieces = vec![corners.collect::<Vec<_>>()];
        let whole: Vec<u32> = pieces[0].iter().map(|c| c.vertex).collect();
        for plane in self.planes {
            let mut inside = Vec::new();
            for piece in &pieces {
                let new_corner = |cut: &Cut| self.cut_vertex(projected, cut, &plane, material, face);
                clip(piece, &plane, new_corner, |part| inside.push(part.to_vec()));
            }
            pieces = inside;
        }
        for piece in pieces {
            let area = doubled_area(piece.iter().map(|c| self.snap(c.position)));
            if self.is_drawn(area) {
                let vertices: Vec<u32> = piece.iter().map(|c| c.vertex).collect();
                self.builder.mean_of(&whole);
                self.builder.polygon(&vertices, face, self.polygon_count);
            }
        }
    }

    /// The vertex where a plane cuts an edge: its attributes lie between those of the edge's ends.
    fn cut_vertex(
        &mut self,
        projected: &mut Projected<'_>,
        cut: &Cut,
        plane: &Plane,
        material: u32,
        face: [f32; 3],
    ) -> u32 {
        let vertex = self.projected_vertex(cut.position, DVec3::Z, material);
        let number = self.add(projected, vertex, (u32::MAX, Side::Front, NO_VERTEX));
        // Attributes that are linear on the screen are divided there, where both ends have a place on it.
        let on_screen = self.scene.interpolation == Interpolation::Screen && plane.in_front;
        let t = if on_screen { cut.t_on_screen() } else { cut.t };
        let (a, b) = (cut.a.vertex, cut.b.vertex);
        self.builder.clip_corner(ClipCorner { vertex: number, a, b, t: t as f32, face });
        number
    }
}

/// Twice the signed area on the picture in sub-pixels: y points downward, so counter-clockwise polygons have a negative
/// one. Products have at most 2⁴⁷; 2²⁷ corners of them need more than 64 bits.
fn doubled_area(corners: impl Iterator<Item = [SubPixel; 2]> + Clone) -> i128 {
    let following = corners.clone().skip(1).chain(corners.clone().take(1));
    let bits = |c: SubPixel| i64::from(c.to_bits());
    corners.zip(following).map(|([x0, y0], [x1, y1])| i128::from(bits(x0) * bits(y1) - bits(x1) * bits(y0))).sum()
}
